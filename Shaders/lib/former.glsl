// What the former frame saw: the texel of its G-buffer where a point was, with its whole BSDF, which pixels were lit in it, and
// lights as they were. For techniques that use the former frame's samples (TechniqueInfo::wants_previous_gbuffer).
#ifndef FB_LIB_FORMER
#define FB_LIB_FORMER
#include "lib/gbuffer_texel.glsl"
#include "lib/pixel.glsl"

struct FormerTexel {
  bool known;      // it shows the same surface
  uvec2 pixel;     // the former frame's; within the picture, known or not
  GBufferTexel texel;
};

// Both are one surface: of one instance, at the depth where the point was.
bool is_same_surface(GBufferTexel now, GBufferTexel former) {
  return former.id == now.id && abs(former.motion.z - now.motion.w) < 0.05 * now.motion.w;
}

// Where what a texel shows was. Nothing is known where frame.previous_gbuffer says so.
FormerTexel former_texel(GBufferTexel now, uvec2 pixel) {
  FormerTexel f;
  vec2 point = vec2(pixel) + 0.5 + now.motion.xy;
  bool inside = all(greaterThanEqual(point, vec2(0.0))) && all(lessThan(point, vec2(frame.width, frame.height)));
  f.pixel = inside ? uvec2(point) : uvec2(0u);
  f.texel = previous_gbuffer_at(f.pixel.y * frame.width + f.pixel.x);
  f.known = inside && frame.previous_gbuffer != 0u && is_same_surface(now, f.texel);
  return f;
}

// The pixel that was lit in the former frame of the block that a pixel lies in; at the picture's edge perhaps beyond it.
uvec2 former_lit_pixel(uvec2 pixel) {
  uint block = max(frame.former_light_block, 1u);
  return pixel / block * block + uvec2(frame.former_light_x, frame.former_light_y);
}
#endif
