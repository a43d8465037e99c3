// Where light is sampled at one pixel of a block (r_light_scale): the sample without its surface's reflectance, with
// what tells whose it is, for the pixels about it (passes/denoise_temporal.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/denoise.glsl"

void main() {
  uvec2 block = invocation_pixel(), pixel = light_pixel(block);
  if (block.x >= frame.light_width || pixel.y / frame.light_block * frame.light_block >= frame.height) return;
  uint to = section(kSectionLight) + block.y * frame.light_width + block.x;
  bool inside = pixel.x < frame.width && pixel.y < frame.height;
  uint at = inside ? pixel.y * frame.width + pixel.x : 0u;
  uvec4 words = gbuffer_quad(at, 3u);
  vec3 ray = camera_direction(vec2(pixel) + 0.5), geometric = unpack_direction(words.x);
  float depth = uintBitsToFloat(gbuffer_quad(at, 4u).z);
  Reflector r = reflector(at, words, ray);
  bool lit = inside && depth > 0.0 && max(r.factor.x, max(r.factor.y, r.factor.z)) > 0.0;
  Found found = found_at(at, r, ray);
  uint surface = pack_surface(at_middle(1.0 / max(depth, 1e-3), plane_slope(geometric, ray)), geometric);
  history.at[to] =
      lit ? uvec4(packHalf2x16(found.own.rg), packHalf2x16(vec2(found.own.b, 0.0)) | (surface_name(words) << 16u),
                  surface, found.of_own ? 0u : 1u)
          : uvec4(0u);
}
