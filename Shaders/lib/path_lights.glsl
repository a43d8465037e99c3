// The path loop of estimators that look for lights (next-event estimation): from every vertex a ray to a light of the
// list, one to a sun, and one by the BSDF, on which the path goes on. The three estimate the same emission and share it
// by the balance heuristic.
#ifndef FB_LIB_PATH_LIGHTS
#define FB_LIB_PATH_LIGHTS
#include "lib/lights.glsl"

const uint kToLight = 0u, kToSun = 1u, kOnward = 2u;

// Radiance that reaches the first vertex's viewer by reflection: paths of 1 to frame.bounces further vertices.
vec3 trace_path(PathVertex v, uint path, bool trains, bool goes_on, inout uint rng) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  float candidates = float(frame.light_candidates);
  for (uint bounce = 0u; bounce < frame.bounces; ++bounce) {
    bool end = bounce + 1u == frame.bounces, ended = true;
    vec3 origin = offset_origin(v.position, v.normal);
    PathVertex next = v;
    for (uint way = has_lights() ? kToLight : kToSun; way <= kOnward; ++way) {
      if (way == kToSun && frame.sun_count == 0u) continue;
      Aim aim;
      float density = 0.0;  // of the suns and the BSDF, as far as they are known
      if (way == kToLight) {
        aim = aim_at_light(v, origin, rng);
      } else if (way == kToSun) {
        aim = aim_at_sun(v, rng, density);
      } else {
        aim = Aim(vec3(0.0), vec3(0.0), kRayEnd, kNoIndex, kNoIndex);
        aim.weight = sample_vertex_bsdf(v, rng, aim.direction);
      }
      if (aim.weight == vec3(0.0)) continue;
      Hit hit = trace(origin, aim.direction, 0.0, aim.reach * 1.001 + 0.01, kMaskIndirect, rng);
      if (way == kToLight && (hit.instance != aim.instance || hit.triangle != aim.triangle)) continue;
      if (hit.instance == kNoIndex && frame.sky_beyond == 0u) continue;
      bool sky = is_sky(hit);
      if (way == kToSun && !sky) continue;
      Surface s = load_surface(hit, aim.direction, false, end || way != kOnward);
      vec3 weight = throughput * aim.weight;
      if (way == kOnward) {
        throughput = weight;
        ended = end || hit.instance == kNoIndex;
        if (!ended) next = make_path_vertex(s, -aim.direction);
      }
      if (s.emission == vec3(0.0)) continue;
      if (way != kToLight) {
        float others = candidates * hit_light_pdf(hit, aim.direction);
        if (way == kOnward) {
          vertex_bsdf(v, aim.direction, density);
          if (sky) others += sun_pdf(aim.direction);
          weight *= density / (density + others);
        } else {
          weight /= density + others;
        }
      }
      sum += weight * s.emission;
    }
    if (ended) break;
    v = next;
  }
  return sum;
}
#endif
