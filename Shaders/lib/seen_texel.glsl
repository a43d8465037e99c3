// What the camera sees at the end of a straight ray, as the G-buffer has it.
#ifndef FB_LIB_SEEN_TEXEL
#define FB_LIB_SEEN_TEXEL
#include "lib/gbuffer_texel.glsl"
#include "lib/pixel.glsl"
#include "lib/segment.glsl"

const GBufferTexel kNothingSeen = GBufferTexel(vec4(0.0), vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), 0u, 0u, 0u, 0u, vec4(0.0));

// The sky is beyond the medium, however near the face that shows it.
float seen_through_medium(Surface s, float distance) {
  if (!FEATURE_MEDIUM) return 1.0;
  return s.sky ? frame.medium_phase.z : transmittance(frame.camera_fog, distance);
}

// Even light that the medium scatters on the way: as much from every point, so without noise.
vec3 scattered_even_light(Surface s, float distance) {
  if (!FEATURE_MEDIUM) return vec3(0.0);
  return frame.medium.rgb * frame.ambient.rgb * (opacity(frame.camera_fog, distance) * (s.sky ? frame.ambient.w : 1.0));
}

void fill_texel(inout GBufferTexel texel, Surface s, Hit hit, vec2 point, float depth) {
  vec3 before = previous_pixel(previous_position(hit));
  texel.position_t = vec4(s.position, hit.t);
  texel.albedo_roughness = vec4(s.bsdf.albedo, sqrt(s.bsdf.alpha));
  // Even light is reflected here and nowhere else: no path brings it, so that it is the same in every estimator.
  texel.emission_specular = vec4((s.emission + s.bsdf.albedo * frame.ambient.rgb) * seen_through_medium(s, hit.t) + scattered_even_light(s, hit.t),
                                s.bsdf.specular);
  texel.normal = pack_direction(s.normal);
  texel.shading_normal = pack_direction(s.shading_normal);
  texel.id = instance_at(hit.instance).id;
  bool liquid = has_feature(kFeatureWarp) && (material_at(s.material).flags & kMaterialLiquid) != 0u;
  uint glows = s.emission != vec3(0.0) ? kTexelGlows : 0u;
  texel.material_metalness = s.material | glows | (liquid ? kTexelLiquid : 0u) | (uint(s.bsdf.metalness * 255.0 + 0.5) << 24u);
  texel.motion = vec4(before.xy - point, depth, before.z);
}

vec4 sky_seen(Surface s) { return vec4(s.emission * seen_through_medium(s, kRayEnd) + scattered_even_light(s, kRayEnd), 0.0); }

// Where in the picture a pixel is seen through.
vec2 point_of(uvec2 pixel) { return vec2(pixel) + 0.5 + jitter_of(pixel); }
// Of the ray of a pixel.
uint seen_rng(uint at) { return rng_seed(at, frame.frame, 0xffffffffu, frame.seed); }
#endif
