// What the camera sees at the end of a straight ray, as the G-buffer has it.
#ifndef FB_LIB_SEEN_TEXEL
#define FB_LIB_SEEN_TEXEL
#include "lib/gbuffer_texel.glsl"
#include "lib/pixel.glsl"
#include "lib/segment.glsl"
#include "shared/denoise.h"
#include "shared/gain_field.h"

const GBufferTexel kNothingSeen =
    GBufferTexel(vec4(0.0), vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), 0u, 0u, 0u, 0u, vec4(0.0));

// A surface as the camera sees it: one may glow for the eye alone, or more than it lights its room.
Surface load_seen_surface(Hit hit, vec3 direction, bool missed) {
  Surface s = load_surface(hit, direction, uint(frame.texture_filter), missed, true);
  if (s.sky)
    s.emission -= frame.sky_even.rgb * (hit.instance != kNoIndex ? material_at(s.material).emission.rgb : vec3(1.0));
  if (s.sky && hit.instance != kNoIndex) s.emission *= seen_emission(material_at(s.material));
  return s;
}

// The sky is beyond the medium, however near the face that shows it.
float seen_through_medium(Surface s, float distance) {
  if (!FEATURE_MEDIUM) return 1.0;
  return s.sky ? frame.medium_phase.z : haze_left(camera_haze(), distance);
}

// Light of the fog itself, even light that it scatters: as much from every point, so without noise. Quake's covers the
// sky evenly, however near the face that shows it.
vec3 light_of_fog(Surface s, float distance) {
  if (!FEATURE_MEDIUM) return vec3(0.0);
  float covers = s.sky && frame.camera_fog_square > 0.0 ? 1.0 : haze_covers(camera_haze(), distance);
  return frame.fog_glow.rgb * (covers * (s.sky ? frame.fog_glow.w : 1.0));
}

// What a map's baked light asks of all light that a point reflects; 1 where nothing is known.
vec3 authored_gain(vec3 position, vec3 normal) {
  if (frame.gain_image == kNoIndex) return vec3(1.0);
  uint first = image_at(frame.gain_image).first;
  uvec3 size = uvec3(frame.gain_width, frame.gain_depth, frame.gain_height);
  vec3 at = clamp((position - frame.gain_origin.xyz) * frame.gain_origin.w - 0.5, vec3(0.0), vec3(size) - 1.001);
  uvec3 corner = uvec3(at);
  vec3 f = at - vec3(corner), sum = vec3(0.0);
  float known = 0.0;
  uint i = 0u;
  do {
    uint way = i >> 3u;
    uvec3 step = uvec3(i, i >> 1u, i >> 2u) & 1u;
    vec3 shares = mix(1.0 - f, f, vec3(step));
    float weight = gain_weight(normal, way) * shares.x * shares.y * shares.z;
    uvec3 cell = min(corner + step, size - 1u);
    uint word = weight > 0.0 ? texels.at[first + ((way * size.z + cell.z) * size.y + cell.y) * size.x + cell.x] : 0u;
    if (word == 0u) continue;
    sum += weight * log(unpack_rgb9e5(word));
    known += weight;
  } while (++i < 8u * kGainWays);
  return known > 0.0 ? exp(sum / known) : vec3(1.0);
}

void fill_texel(inout GBufferTexel texel, Surface s, Hit hit, vec2 point, float depth) {
  vec3 before = previous_pixel(previous_position(hit));
  s.bsdf.albedo *= authored_gain(s.position, s.normal);
  texel.position_t = vec4(s.position, hit.t);
  texel.albedo_roughness = vec4(s.bsdf.albedo, sqrt(s.bsdf.alpha));
  bool colored = (instance_at(hit.instance).flags & kInstanceHasColor) != 0u;
  vec3 even = frame.ambient.rgb + (colored ? vec3(0.0) : instance_at(hit.instance).emission.rgb);
  // Even light is reflected here and nowhere else: no path brings it, so that it is the same in every estimator.
  texel.emission_specular = vec4(
      (s.emission + s.bsdf.albedo * even) * seen_through_medium(s, hit.t) + light_of_fog(s, hit.t), s.bsdf.specular);
  texel.normal = pack_direction(s.normal);
  texel.shading_normal = pack_direction(s.shading_normal);
  texel.id = instance_at(hit.instance).id;
  bool liquid = has_feature(kFeatureWarp) && (material_at(s.material).flags & kMaterialLiquid) != 0u;
  uint glows = s.emission != vec3(0.0) ? kTexelGlows : 0u;
  texel.material_metalness =
      s.material | glows | (liquid ? kTexelLiquid : 0u) | (uint(s.bsdf.metalness * 255.0 + 0.5) << 24u);
  texel.motion = vec4(before.xy - point, depth, before.z);
}

vec4 sky_seen(Surface s) { return vec4(s.emission * seen_through_medium(s, kRayEnd) + light_of_fog(s, kRayEnd), 0.0); }

// Where in the picture a pixel is seen through.
vec2 point_of(uvec2 pixel) { return vec2(pixel) + 0.5 + jitter_of(pixel); }
// Of the ray of a pixel.
uint seen_rng(uint at) { return rng_seed(at, frame.frame, 0xffffffffu, frame.seed); }
#endif
