// The path loop that every estimator shares. An estimator is a policy: it defines
//   vec3 sample_direction(PathVertex v, bool first, bool last, inout uint rng, out vec3 direction);
// before including this file, which returns f cos / pdf (zero ends the path; first, last: vertices of the path). One that
// learns defines ESTIMATOR_LEARNS and
//   void look_at_next(Surface s, inout uint rng);  finds what is known of the next vertex
//   vec3 reflected_there(Surface s);               light that it reflects, as far as it is known
//   bool is_new_here();                            little is known at the vertex yet
//   bool is_discovery();                           an emitter met now would be new
//   void path_wasted();                            the direction was of no use: weight zero
//   void path_hit(PathVertex v, vec3 direction, vec3 weight, vec3 emission, vec3 reflected, vec3 hit_position,
//                 vec3 velocity, bool trains, uint proposal, inout uint rng);
//   bool ends_at_next();                           the path may take reflected_there() for all that is beyond
// Only a share of the paths trains where much is known, to save time; an emitter that is new is never passed by.
// One that defines ESTIMATOR_SAMPLES_LIGHTS as 1 also looks for lights at every vertex (lib/lights.glsl); what its directions
// meet by chance then counts by the balance heuristic. If it learns, too, it defines
//   void found_lights(vec3 irradiance, inout uint rng);  irradiance / pi at the vertex by those that were looked for
// All transport is here: emission met on the way, at most frame.bounces further vertices. Where the estimator is biased and
// says so (PATH_TAIL), what is known of the last vertex stands for everything beyond it.
#ifndef FB_LIB_PATH
#define FB_LIB_PATH
#include "lib/path_vertex.glsl"
#if ESTIMATOR_SAMPLES_LIGHTS
#include "lib/lights.glsl"
#endif

#if ESTIMATOR_LEARNS
const float kFarTarget = 32768.0;  // as far as a map reaches: where light from beyond is thought to be

vec3 hit_velocity(Hit hit, vec3 position) {
  if (hit.instance == kNoIndex || (instances[hit.instance].flags & kInstanceMoves) == 0u) return vec3(0.0);
  return (position - previous_position(hit)) / max(frame.time - frame.prev_time, 1e-4);
}
#else
const bool PATH_TAIL = false;
#endif

// Radiance that reaches the first vertex's viewer by reflection: paths of 1 to frame.bounces further vertices. `path`
// numbers this frame's paths; `goes_on`: to its last vertex, known light or not.
vec3 trace_path(PathVertex v, uint path, bool trains, bool goes_on, inout uint rng) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  for (uint bounce = 0u; bounce < frame.bounces; ++bounce) {
    bool end = bounce + 1u == frame.bounces;
    bool last = end && !PATH_TAIL;  // emission alone counts there
    vec3 direction;
    vec3 weight = sample_direction(v, bounce == 0u, last, rng, direction);
    vec3 origin = offset_origin(v.position, v.normal);
#if ESTIMATOR_SAMPLES_LIGHTS
    vec3 irradiance;
    sum += throughput * look_for_lights(v, origin, irradiance, rng);
#if ESTIMATOR_LEARNS
    if (trains || is_new_here()) found_lights(irradiance, rng);
#endif
#endif
    if (weight == vec3(0.0)) {
#if ESTIMATOR_LEARNS
      if (trains || is_new_here()) path_wasted();
#endif
      break;
    }
    Hit hit = trace(origin, direction, 0.0, kRayEnd, kMaskIndirect, rng);
    bool missed = hit.instance == kNoIndex;
    bool dark = missed && frame.sky_beyond == 0u;
#if ESTIMATOR_LEARNS
    Surface s;
    s.emission = vec3(0.0);
    if (!dark) s = load_surface(hit, direction, false, last);
#if ESTIMATOR_SAMPLES_LIGHTS
    s.emission *= chance_share(v, hit, direction, s.emission);
#endif
    bool more = !missed && !last;
    vec3 reflected = vec3(0.0);
    if (more) {
      look_at_next(s, rng);
      reflected = reflected_there(s);
    }
    bool learns = trains || is_new_here();
    if (learns || (is_discovery() && s.emission != vec3(0.0))) {
      vec3 position = origin + direction * min(hit.t, kFarTarget);
      path_hit(v, direction, weight, s.emission, reflected, position, hit_velocity(hit, position), learns,
               path * frame.bounces + bounce, rng);
    }
    if (dark) break;
#else
    if (dark) break;
    Surface s = load_surface(hit, direction, false, last);
#if ESTIMATOR_SAMPLES_LIGHTS
    s.emission *= chance_share(v, hit, direction, s.emission);
#endif
#endif
    throughput *= weight;
    sum += throughput * s.emission;
#if ESTIMATOR_LEARNS
    if (PATH_TAIL && !missed && (end || (!goes_on && ends_at_next()))) {
      sum += throughput * reflected;
      break;
    }
#endif
    if (missed || end) break;
    v = make_path_vertex(s, -direction);
  }
  return sum;
}
#endif
