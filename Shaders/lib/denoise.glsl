// The history buffer as the denoiser's passes read them: four words at once, through a texel buffer,
// which is faster on lavapipe.
#ifndef FB_LIB_DENOISE
#define FB_LIB_DENOISE
#include "lib/gbuffer_texel.glsl"
#include "lib/haze.glsl"
#include "lib/second_surface.glsl"
#include "lib/pixel.glsl"
#include "shared/denoise.h"
#include "shared/packing.h"
#include "shared/rng.h"

FB_FRAME_ARRAY(kBindHistory, 16, , HistoryArray, uvec4, history)
FB_FRAME_ARRAY(kBindHistory, 4, , HistoryWordArray, uint, history_words)
// Specialised as paths are (lib/interaction.glsl), but for a medium that scatters in this frame.
layout(constant_id = kSpecWater) const bool WITH_SECOND_SURFACES = false;
layout(constant_id = kSpecMedium) const bool WITH_MEDIUM = false;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsHistory) uniform usamplerBuffer history_texels;

uint section(uint index) { return index * frame.width * frame.height; }
uvec4 history_quad(uint at) { return texelFetch(history_texels, int(at)); }
// A pixel's PictureTexel.
uvec2 picture_texel(uint at) {
  uvec4 two = history_quad(section(kSectionPicture) + (at >> 1u));
  return (at & 1u) != 0u ? two.zw : two.xy;
}
vec3 picture_color(uvec2 texel) { return vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y).x); }
// Word of an anti-aliased picture.
uint shown_word(uint parity, uint at) {
  return history_shown(frame.width * frame.height, frame.smooth_width * frame.smooth_height, parity) + at;
}

// Eight bits that tell instances apart, and a liquid from the ground about it: what it mirrors is not the light that
// falls there, though both may lie in one plane. `words`: the texel's fourth quad.
bool is_liquid(uvec4 words) { return (words.w & kTexelLiquid) != 0u; }
uint surface_name(uvec4 words) { return hash_u32(words.z ^ (is_liquid(words) ? 0x80000000u : 0u)) >> 24u; }

// Not finite: counted, and as good as black.
vec3 checked_irradiance(vec3 x) {
  if (any(isnan(x)) || any(isinf(x))) {
    atomicAdd(counters.at[kCounterHistory], 1u);
    return vec3(0.0);
  }
  return clamp(x, vec3(-kMaxIrradiance), vec3(kMaxIrradiance));
}

float luminance_of(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// What is shown of the surface at a pixel: its emission, and the factor on irradiance; zero: it reflects nothing.
struct Reflector {
  vec3 emission, factor;
};

// 1 / depth of a plane at its pixel's middle, from that where the jittered ray met it.
float at_middle(float inverse_depth, vec2 slope) {
  return inverse_depth / max(1.0 + dot(slope, vec2(frame.jitter_x, frame.jitter_y)), 0.1);
}

// What the medium leaves of a surface's light; exactly 1 where there is none. `ray`: to the pixel, 1 along the view.
float left_by_medium(uint at, vec3 ray) {
  Haze haze = camera_haze();
  return haze.linear + haze.square > 0.0 ? haze_left(haze, uintBitsToFloat(gbuffer_quad(at, 4u).z) * length(ray)) : 1.0;
}

// `words`: the texel's fourth quad. The coat is taken at the geometric normal's angle: Schlick's weight of a normal map
// at grazing angles differs from pixel to pixel by more than what is reflected, and neighbours that share their
// irradiance would be too bright by that.
Reflector reflector(uint at, uvec4 words, vec3 ray) {
  vec4 a = uintBitsToFloat(gbuffer_quad(at, 1u)), e = uintBitsToFloat(gbuffer_quad(at, 2u));
  if (WITH_SECOND_SURFACES) a.rgb = max(a.rgb - second_at(at).albedo, vec3(0.0));
  float cos_view = abs(dot(unpack_direction(words.x), ray)) * inversesqrt(dot(ray, ray));
  return Reflector(
      e.rgb, demodulation_factor(a.rgb, a.w, e.w, float(words.w >> 24u) / 255.0, cos_view) * left_by_medium(at, ray));
}

// Irradiance that this frame's paths found at a pixel: on its own surface, and on the second one where there are two. A
// path begins at one of them, so that one may have no sample; what the other has is then a guess at its light.
struct Found {
  vec3 own, second;
  bool of_own, of_second;  // sampled
};
vec3 second_factor(uint at, vec3 ray) { return factor_or_nothing(second_at(at).albedo) * left_by_medium(at, ray); }
Found found_at(uint at, Reflector own, vec3 ray) {
  vec3 found = radiance.at[at].rgb - own.emission;
  if (!WITH_SECOND_SURFACES) return Found(checked_irradiance(demodulate(found, own.factor)), vec3(0.0), true, false);
  vec4 other = radiance.at[second_radiance_at(at)];
  vec3 factor = second_factor(at, ray);
  float chance = chance_of_second(own.factor, factor);
  // The mean of the paths that began there, each without the factor for its choice.
  vec3 of_own = (found - other.rgb) * ((1.0 - chance) / max(1.0 - other.w, 1e-6)),
       of_second = other.rgb * (chance / max(other.w, 1e-6));
  Found f = Found(checked_irradiance(demodulate(of_own, own.factor)), checked_irradiance(demodulate(of_second, factor)),
                  other.w<1.0, other.w> 0.0);
  if (!f.of_own) f.own = f.second;
  if (!f.of_second) f.second = f.own;
  return f;
}

// How 1 / depth changes from pixel to pixel on the plane with this normal, relative to its value here: 1 / depth is
// linear over the image of a plane.
vec2 plane_slope(vec3 normal, vec3 ray) {
  float facing = dot(normal, ray);
  float scale = 2.0 / (abs(facing) > 1e-4 ? facing : -1e-4);
  return vec2(dot(normal, frame.camera_right.xyz) / float(frame.width),
              -dot(normal, frame.camera_up.xyz) / float(frame.height)) *
         scale;
}
#endif
