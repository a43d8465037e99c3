// The main function of every technique: a pixel's radiance is its emission, and the mean of frame.spp paths from its
// surface. The includer chooses the technique's steps (lib/path.glsl) before.
#include "lib/first_vertex.glsl"
#include "lib/medium_path.glsl"
#include "lib/path.glsl"
#include "lib/water_texel.glsl"

// The technique writes the picture itself: a debug view of its own. A constant, since lavapipe runs both sides of a branch.
layout(constant_id = kSpecShowView) const bool SHOW_VIEW = false;

// A technique that learns traces a frame's paths in parts, each every so many rows of workgroups (render/techniques/technique.h).
layout(push_constant) uniform Part {
  uint row_step, first_row;
};

uvec2 block_of_part() {
  uint row = gl_WorkGroupID.y;
  return invocation_pixel() + uvec2(0u, 8u * (row * row_step + first_row - row));
}

void main() {
  uvec2 block = kLearns && !IN_MEDIUM ? block_of_part() : invocation_pixel(), pixel = IN_MEDIUM ? medium_pixel(block) : light_pixel(block);
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, number = (block.y * (IN_MEDIUM ? frame.medium_width : frame.light_width) + block.x) * frame.spp;
  if (IN_MEDIUM) {
    light_in_medium(at, block, number, pixel);
    return;
  }
  GBufferTexel g = gbuffer_at(at);
  vec3 emission = g.emission_specular.rgb;
  if (SHOW_VIEW) ldr.at[at] = packUnorm4x8(vec4(view_of_directions(block, number, pixel), 1.0));
  bool black = g.albedo_roughness.rgb == vec3(0.0) && g.emission_specular.w == 0.0;
  if (g.position_t.w == 0.0 || black || frame.bounces == 0u) {
    radiance.at[at] = vec4(SHOW_VIEW && measures_moments() ? vec3(0.0) : emission, 0.0);
    if (FEATURE_WATER) radiance.at[second_radiance_at(at)] = vec4(0.0);
    return;
  }
  Vertex v = first_vertex(g, pixel);
  if (SHOW_VIEW && !shows_directions()) {
    Path path = begin_path(block, number, 0u);
    path.group_rng = rng_seed(at, frame.frame, 1u, frame.seed);  // each pixel looks for itself
    ldr.at[at] = packUnorm4x8(vec4(view_color(v, path, rng_seed(at, frame.frame, 0u, frame.seed)), 1.0));
  }
  vec3 sum = vec3(0.0);
  vec4 sum_second = vec4(0.0);
  float lost = 0.0;
  uint i = 0u;
  do {
    uint rng = rng_seed(at, frame.frame, i, frame.seed);
    Vertex first = v;
    bool second = false;
    float factor = FEATURE_WATER ? choose_surface(first, at, (g.material_metalness & kTexelLiquid) != 0u, rng, second) : 1.0;
    vec3 estimate = trace_path(first, begin_path(block, number + i, i), rng);
    if (FEATURE_WATER) estimate *= factor;
    if (any(isnan(estimate)) || any(isinf(estimate))) {
      atomicAdd(counters.at[kCounterNan], 1u);
      lost += 1.0;
      estimate = vec3(0.0);
    }
    sum += estimate;
    if (FEATURE_WATER) sum_second += second ? vec4(estimate, 1.0) : vec4(0.0);
  } while (++i < frame.spp);
  float left = FEATURE_MEDIUM ? transmittance(frame.camera_fog, g.position_t.w) : 1.0;
  if (FEATURE_MEDIUM) sum *= left;
  if (FEATURE_WATER) radiance.at[second_radiance_at(at)] = vec4(sum_second.rgb * left, sum_second.w) / float(frame.spp);
  radiance.at[at] = vec4(emission + sum / float(frame.spp), lost);
  if (SHOW_VIEW && measures_moments()) radiance.at[at] = vec4(view_of_moments(v, begin_path(block, number, 0u), rng_seed(at, frame.frame, frame.spp, frame.seed)), lost);
}
