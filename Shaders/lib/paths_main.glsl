// The main function of every estimator: each pixel's radiance is its emission, and the mean of frame.spp paths from its
// surface. The includer defines the estimator's policy (lib/path.glsl) before.
#include "lib/pixel.glsl"
#include "lib/path.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  GBufferTexel g = gbuffer[at];
  vec3 emission = g.emission_specular.rgb;
  if (g.position_t.w == 0.0 || g.albedo_roughness.rgb == vec3(0.0) && g.emission_specular.w == 0.0) {
    radiance[at] = vec4(emission, 0.0);
    return;
  }
  PathVertex v;
  v.position = g.position_t.xyz;
  v.normal = unpack_direction(g.normal);
  v.shading_normal = unpack_direction(g.shading_normal);
  v.view = normalize(frame.camera_position.xyz - v.position);
  v.bsdf = Bsdf(g.albedo_roughness.rgb, max(g.albedo_roughness.w * g.albedo_roughness.w, kMinAlpha),
                g.emission_specular.w, float(g.material_metalness >> 24u) / 255.0);

  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < frame.spp; ++i) {
    uint rng = rng_seed(at, frame.frame, i, frame.seed);
    vec3 estimate = trace_path(v, rng);
    if (any(isnan(estimate)) || any(isinf(estimate))) {
      atomicAdd(counters[kCounterNan], 1u);
      estimate = vec3(0.0);
    }
    sum += estimate;
  }
  radiance[at] = vec4(emission + sum / float(frame.spp), 0.0);
}
