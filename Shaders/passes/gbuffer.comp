// G-buffer: what the camera sees through each pixel: position, normals, colour, emission, motion, ids.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/gbuffer_texel.glsl"
#include "lib/pixel.glsl"
#include "lib/interaction.glsl"

// The sky is beyond the medium, however near the face that shows it.
float seen_through_medium(Surface s, float distance) {
  if (!FEATURE_MEDIUM) return 1.0;
  return s.sky ? frame.medium_phase.z : transmittance(frame.medium.w, distance);
}

// Even light that the medium scatters on the way: as much from every point, so without noise.
vec3 scattered_even_light(float distance) {
  return FEATURE_MEDIUM ? frame.medium.rgb * frame.ambient.rgb * opacity(frame.medium.w, distance) : vec3(0.0);
}

void fill_texel(inout GBufferTexel texel, Surface s, Hit hit, vec2 point, float depth) {
  vec3 before = previous_pixel(previous_position(hit));
  texel.position_t = vec4(s.position, hit.t);
  texel.albedo_roughness = vec4(s.bsdf.albedo, sqrt(s.bsdf.alpha));
  // Even light is reflected here and nowhere else: no path brings it, so that it is the same in every estimator.
  texel.emission_specular = vec4((s.emission + s.bsdf.albedo * frame.ambient.rgb) * seen_through_medium(s, hit.t) + scattered_even_light(hit.t),
                                s.bsdf.specular);
  texel.normal = pack_direction(s.normal);
  texel.shading_normal = pack_direction(s.shading_normal);
  texel.id = instance_at(hit.instance).id;
  bool liquid = has_feature(kFeatureWarp) && (material_at(s.material).flags & kMaterialLiquid) != 0u;
  texel.material_metalness = s.material | (liquid ? kTexelLiquid : 0u) | (uint(s.bsdf.metalness * 255.0 + 0.5) << 24u);
  texel.motion = vec4(before.xy - point, depth, before.z);
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  uint rng = rng_seed(at, frame.frame, 0xffffffffu, frame.seed);

  vec2 point = vec2(pixel) + 0.5 + vec2(frame.jitter_x, frame.jitter_y);
  vec3 ray = camera_direction(point);
  vec3 direction = normalize(ray);
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);

  bool missed = hit.instance == kNoIndex;
  GBufferTexel texel = GBufferTexel(vec4(0.0), vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), 0u, 0u, 0u, 0u, vec4(0.0));
  if (!missed || frame.sky_beyond != 0u) {
    Surface s = load_surface(hit, direction, uint(frame.texture_filter), missed);
    texel.emission_specular = vec4(s.emission * seen_through_medium(s, kRayEnd) + scattered_even_light(kRayEnd), 0.0);
    if (!missed) fill_texel(texel, s, hit, point, hit.t / length(ray));
  }
  store_gbuffer(at, texel);
}
