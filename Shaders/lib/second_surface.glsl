// The second surface of a pixel that shows two by way of water (lib/water_texel.glsl), as paths choose it and the
// denoiser parts it from the texel's own.
#ifndef FB_LIB_SECOND_SURFACE
#define FB_LIB_SECOND_SURFACE
#include "lib/gbuffer_texel.glsl"
#include "shared/color.h"
#include "shared/packing.h"

// Where a texel has one. Its albedo has its share in it, as the texel's has; black: there is no second surface.
struct SecondTexel {
  vec3 albedo;
  float depth;  // along the view, as it looks
  vec2 motion;  // previous minus current position in pixels
};
const SecondTexel kNoSecond = SecondTexel(vec3(0.0), 0.0, vec2(0.0));
// Halves, all but the fourth word.
uvec3 pack_second(SecondTexel s) {
  return uvec3(packHalf2x16(s.albedo.rg), packHalf2x16(vec2(s.albedo.b, min(s.depth, 60000.0))),
               packHalf2x16(clamp(s.motion, -60000.0, 60000.0)));
}
SecondTexel second_texel(uvec4 words) {
  vec2 rest = unpackHalf2x16(words.y);
  return SecondTexel(vec3(unpackHalf2x16(words.x), rest.x), rest.y, unpackHalf2x16(words.z));
}
SecondTexel second_at(uint at) { return second_texel(gbuffer_quad(at, kFirstWaterPlane)); }
// Geometric; stored where there is a second surface alone.
vec3 second_normal(uint at) { return unpack_direction(gbuffer_quad(at, kFirstWaterPlane + 2u).x); }

// Probability with which a path starts there: by how much each of both can reflect.
float chance_of_second(vec3 own_albedo, vec3 second_albedo) {
  float own = luminance(own_albedo), second = luminance(second_albedo);
  return second > 0.0 ? own > 1e-6 * second ? clamp(second / (own + second), 0.05, 0.95) : 1.0 : 0.0;
}

// What paths from second surfaces brought stands behind all else of the frame's radiance: rgb: as much as the pixel has
// of them; w: how many of its paths they were, of 1.
uint second_radiance_at(uint at) { return frame.second_radiance + at; }
#endif
