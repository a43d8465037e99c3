// The main function of every estimator: each pixel's radiance is its emission, and the mean of frame.spp paths from its
// surface. The includer defines the estimator's policy (lib/path.glsl) before.
#include "lib/pixel.glsl"
#include "lib/path.glsl"

// Where what a texel shows was in the former frame; its position itself unless it moved perceptibly.
vec3 previous_world(GBufferTexel g, vec2 point) {
  if (g.motion.w <= 0.0) return g.position_t.xyz;
  vec2 s = (point + g.motion.xy) / vec2(frame.width, frame.height) * 2.0 - 1.0;
  vec3 ray = frame.prev_camera_forward.xyz + s.x * frame.prev_camera_right.xyz - s.y * frame.prev_camera_up.xyz;
  vec3 before = frame.prev_camera_position.xyz + ray * g.motion.w;
  return distance(before, g.position_t.xyz) > 0.25 + 1e-3 * g.position_t.w ? before : g.position_t.xyz;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  GBufferTexel g = gbuffer[at];
  vec3 emission = g.emission_specular.rgb;
#if ESTIMATOR_LEARNS
  if (SHOW_GUIDE) ldr[at] = packUnorm4x8(vec4(0.0, 0.0, 0.0, 1.0));
#endif
  if (g.position_t.w == 0.0 || g.albedo_roughness.rgb == vec3(0.0) && g.emission_specular.w == 0.0) {
    radiance[at] = vec4(emission, 0.0);
    return;
  }
  PathVertex v;
  v.position = g.position_t.xyz;
  v.previous = v.position;
#if ESTIMATOR_LEARNS
  v.previous = previous_world(g, vec2(pixel) + 0.5 + vec2(frame.jitter_x, frame.jitter_y));
#endif
  v.normal = unpack_direction(g.normal);
  v.shading_normal = unpack_direction(g.shading_normal);
  v.view = normalize(frame.camera_position.xyz - v.position);
  v.bsdf = Bsdf(g.albedo_roughness.rgb, max(g.albedo_roughness.w * g.albedo_roughness.w, kMinAlpha),
                g.emission_specular.w, float(g.material_metalness >> 24u) / 255.0);

#if ESTIMATOR_LEARNS
  if (SHOW_GUIDE) {
    guide_rng = rng_seed(at, frame.frame, 1u, frame.seed);
    ldr[at] = packUnorm4x8(vec4(guide_debug_color(v, rng_seed(at, frame.frame, 0u, frame.seed)), 1.0));
  }
#endif
  vec3 sum = vec3(0.0);
  float lost = 0.0;
  for (uint i = 0u; i < frame.spp; ++i) {
    uint rng = rng_seed(at, frame.frame, i, frame.seed);
    bool trains = false, goes_on = false;
#if ESTIMATOR_LEARNS
    // Lanes that run together (4x2 pixels) look into the same cells, train together, and go on together.
    guide_rng = rng_seed((pixel.y >> 1u) * frame.width + (pixel.x >> 2u), frame.frame, i, frame.seed ^ 0x5bd1e995u);
    goes_on = PATH_TAIL && rng_next(guide_rng) % frame.tail_every == 0u;
    trains = rng_next(guide_rng) % frame.train_every == 0u || goes_on;
#endif
    vec3 estimate = trace_path(v, at * frame.spp + i, trains, goes_on, rng);
    if (any(isnan(estimate)) || any(isinf(estimate))) {
      atomicAdd(counters[kCounterNan], 1u);
      lost += 1.0;
      estimate = vec3(0.0);
    }
    sum += estimate;
  }
  radiance[at] = vec4(emission + sum / float(frame.spp), lost);
}
