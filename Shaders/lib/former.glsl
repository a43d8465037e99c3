// What the former frame saw: the texel of its G-buffer where a point was, with its whole BSDF, which pixels were lit in
// it, and lights as they were. For techniques that use the former frame's samples
// (TechniqueInfo::wants_previous_gbuffer).
#ifndef FB_LIB_FORMER
#define FB_LIB_FORMER
#include "lib/gbuffer_texel.glsl"
#include "lib/lights.glsl"
#include "lib/pixel.glsl"

struct FormerTexel {
  bool known;    // it shows the same surface
  uvec2 pixel;   // the former frame's; within the picture, known or not
  uint element;  // of the former half of an array of the pixels at which light is sampled: of former_lit_texel
  GBufferTexel texel;
};

// Both are one surface: of one instance, at the depth where the point was.
bool is_same_surface(GBufferTexel now, GBufferTexel former) {
  return former.id == now.id && abs(former.motion.z - now.motion.w) < 0.05 * now.motion.w;
}

bool former_is_inside(vec2 point) {
  return all(greaterThanEqual(point, vec2(0.0))) && all(lessThan(point, vec2(frame.width, frame.height)));
}
FormerTexel former_texel_at(GBufferTexel now, uvec2 pixel, bool inside) {
  FormerTexel f;
  f.pixel = inside ? pixel : uvec2(0u);
  f.element = 0u;
  f.texel = previous_gbuffer_at(f.pixel.y * frame.width + f.pixel.x);
  f.known = inside && frame.previous_gbuffer != 0u && is_same_surface(now, f.texel);
  return f;
}

// Where an instance of the former frame's table is in this one's; kNoIndex: it is gone, or another mesh. Known where
// the list of lights is wanted.
uint instance_now(uint former) {
  if (former >= frame.former_instances) return kNoIndex;
  return texelFetch(light_texels, int(frame.former_first + (former >> 2u)))[former & 3u];
}

// Where what a texel shows was. Nothing is known where frame.previous_gbuffer says so.
FormerTexel former_texel(GBufferTexel now, uvec2 pixel) {
  vec2 point = vec2(pixel) + 0.5 + now.motion.xy;
  bool inside = former_is_inside(point);
  return former_texel_at(now, uvec2(inside ? point : vec2(0.0)), inside);
}

// Of the block in which that was the pixel that was lit in the former frame, a few pixels off, `offset` blocks further
// on. At the picture's edge it may lie beyond it, and is not known.
FormerTexel former_lit_texel(GBufferTexel now, uvec2 pixel, ivec2 offset) {
  uint block = max(frame.former_light_block, 1u);
  vec2 point = vec2(pixel) + 0.5 + now.motion.xy + vec2(offset) * float(block);
  bool inside = former_is_inside(point);
  uvec2 of_block = uvec2(inside ? point : vec2(0.0)) / block;
  uvec2 lit = of_block * block + uvec2(frame.former_light_x, frame.former_light_y);
  FormerTexel f = former_texel_at(now, lit, inside && former_is_inside(vec2(lit)));
  f.element = of_block.y * ((frame.width + block - 1u) / block) + of_block.x;
  return f;
}
#endif
