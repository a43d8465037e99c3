// The main function of every technique: a pixel's radiance is its emission, and the mean of frame.spp paths from its
// surface. The includer chooses the technique's steps (lib/path.glsl) before.
#include "lib/gbuffer_texel.glsl"
#include "lib/pixel.glsl"
#include "lib/path.glsl"

// The technique writes the picture itself: a debug view of its own. A constant, since lavapipe runs both sides of a branch.
layout(constant_id = kSpecShowView) const bool SHOW_VIEW = false;

// Where what a texel shows was in the former frame; its position itself unless it moved perceptibly.
vec3 previous_world(GBufferTexel g, vec2 point) {
  if (g.motion.w <= 0.0) return g.position_t.xyz;
  vec2 s = (point + g.motion.xy) / vec2(frame.width, frame.height) * 2.0 - 1.0;
  vec3 ray = frame.prev_camera_forward.xyz + s.x * frame.prev_camera_right.xyz - s.y * frame.prev_camera_up.xyz;
  vec3 before = frame.prev_camera_position.xyz + ray * g.motion.w;
  return distance(before, g.position_t.xyz) > 0.25 + 1e-3 * g.position_t.w ? before : g.position_t.xyz;
}

void main() {
  uvec2 block = invocation_pixel(), pixel = light_pixel(block);
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, number = (block.y * frame.light_width + block.x) * frame.spp;
  GBufferTexel g = gbuffer_at(at);
  vec3 emission = g.emission_specular.rgb;
  if (SHOW_VIEW) ldr.at[at] = packUnorm4x8(vec4(0.0, 0.0, 0.0, 1.0));
  bool black = g.albedo_roughness.rgb == vec3(0.0) && g.emission_specular.w == 0.0;
  if (g.position_t.w == 0.0 || black || frame.bounces == 0u) {
    radiance.at[at] = vec4(emission, 0.0);
    return;
  }
  Vertex v;
  v.position = g.position_t.xyz;
  v.previous = v.position;
  if (kFollowsMotion) v.previous = previous_world(g, vec2(pixel) + 0.5 + vec2(frame.jitter_x, frame.jitter_y));
  v.view = normalize(frame.camera_position.xyz - v.position);
  v.scatter.normal = unpack_direction(g.normal);
  v.scatter.shading_normal = unpack_direction(g.shading_normal);
  v.scatter.bsdf = Bsdf(g.albedo_roughness.rgb, max(g.albedo_roughness.w * g.albedo_roughness.w, kMinAlpha),
                        g.emission_specular.w, float(g.material_metalness >> 24u) / 255.0);

  if (SHOW_VIEW) {
    Path path = begin_path(block, number, 0u);
    path.group_rng = rng_seed(at, frame.frame, 1u, frame.seed);  // each pixel looks for itself
    ldr.at[at] = packUnorm4x8(vec4(view_color(v, path, rng_seed(at, frame.frame, 0u, frame.seed)), 1.0));
  }
  vec3 sum = vec3(0.0);
  float lost = 0.0;
  uint i = 0u;
  do {
    uint rng = rng_seed(at, frame.frame, i, frame.seed);
    vec3 estimate = trace_path(v, begin_path(block, number + i, i), rng);
    if (any(isnan(estimate)) || any(isinf(estimate))) {
      atomicAdd(counters.at[kCounterNan], 1u);
      lost += 1.0;
      estimate = vec3(0.0);
    }
    sum += estimate;
  } while (++i < frame.spp);
  radiance.at[at] = vec4(emission + sum / float(frame.spp), lost);
}
