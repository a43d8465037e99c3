// How the paths of a pixel begin: which pixel an invocation works on, what it shows, and whether that reflects light.
// For every pass that traces or finishes paths of pixels, with lib/store_light.glsl.
#ifndef FB_LIB_PIXEL_START
#define FB_LIB_PIXEL_START
#include "lib/first_vertex.glsl"
#include "lib/path_state.glsl"
#include "lib/water_texel.glsl"

struct PathPixel {
  uvec2 block;  // of which one pixel is lit in this frame
  uvec2 pixel;  // that one
  uint at;      // its index in the frame's arrays
  uint number;  // of its first path
};

// Of a block of surfaces' light or, in shaders of paths that begin in a medium, of the medium's.
PathPixel path_pixel(uvec2 block) {
  PathPixel p;
  p.block = block;
  p.pixel = IN_MEDIUM ? medium_pixel(block) : light_pixel(block);
  p.at = p.pixel.y * frame.width + p.pixel.x;
  p.number = (block.y * (IN_MEDIUM ? frame.medium_width : frame.light_width) + block.x) * frame.spp;
  return p;
}

// At the picture's edge the pixel of a block may lie beyond it.
bool within_picture(PathPixel p) { return p.pixel.x < frame.width && p.pixel.y < frame.height; }

// There is a surface, which is not black, and paths may reflect.
bool reflects_light(GBufferTexel g) {
  bool black = g.albedo_roughness.rgb == vec3(0.0) && g.emission_specular.w == 0.0;
  return g.position_t.w != 0.0 && !black && frame.bounces != 0u;
}

// A path that begins anywhere, as at a probe, and may have so many reflections. The step `begin` has not been asked.
Path path_from(uvec2 pixel, uint number, uint most) {
  Path path;
  path.pixel = pixel;
  path.number = number;
  path.depth = 0u;
  path.most = most;
  path.last = path.second = false;
  path.factor = vec3(1.0);
  return path;
}

// Path i of a pixel.
Path path_of(PathPixel p, uint i) {
  Path path = path_from(p.pixel, p.number + i, most_reflections());
  begin_path(path, p.block, i);
  return path;
}

// The same at its first vertex, with its random numbers. `v`: what the texel itself shows; where water shows two
// surfaces it becomes one of them.
Path start_path(PathPixel p, GBufferTexel g, uint i, inout Vertex v, out uint rng) {
  rng = rng_seed(p.at, frame.frame, i, frame.seed);
  bool second = false;
  float factor =
      shows_two() ? choose_surface(v, p.at, FEATURE_WATER && (g.material_metalness & kTexelLiquid) != 0u, rng, second)
                  : 1.0;
  Path path = path_of(p, i);
  path.second = second;
  path.factor = vec3(factor);
  return path;
}
#endif
