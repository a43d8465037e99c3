// Light that the medium scatters to the camera before the surface that a pixel shows: paths whose first vertex is in the medium,
// at a distance that is sampled by transmittance or about a point that may glow (equi-angular, Kulla and Fajardo 2012). That point is
// drawn before and apart from all else, so that each path's density is of it alone.
#ifndef FB_LIB_MEDIUM_PATH
#define FB_LIB_MEDIUM_PATH
#include "lib/first_vertex.glsl"
#include "lib/path.glsl"
#include "shared/color.h"

// Where the ray of a pixel ends: at its surface.
float medium_reach(GBufferTexel g) { return g.position_t.w > 0.0 ? g.position_t.w : kRayEnd; }

// Into the second half of `radiance`; w: the mean distance of what was scattered, by luminance.
void light_in_medium(uint at, uvec2 block, uint number, uvec2 pixel) {
  vec3 direction = normalize(camera_direction(vec2(pixel) + 0.5 + vec2(frame.jitter_x, frame.jitter_y)));
  float reach = medium_reach(gbuffer_at(at)), weights = 0.0, places = 0.0;
  vec3 sum = vec3(0.0);
  uint i = 0u;
  do {
    uint rng = rng_seed(at, frame.frame, uint(frame.spp) + i, frame.seed);
    vec3 place;
    bool about = point_of_light(rng, place);
    DistanceMix distances = distance_mix(frame.medium.w, reach, about ? frame.fog_about : 0.0, place - frame.camera_position.xyz, direction);
    float distance = sample_distance(distances, rng_uniform(rng));
    Vertex v = medium_vertex(frame.camera_position.xyz + direction * distance, -direction);
    vec3 estimate = trace_path(v, begin_path(block, number + i, i), rng);
    if (any(isnan(estimate)) || any(isinf(estimate))) {
      atomicAdd(counters.at[kCounterNan], 1u);
      estimate = vec3(0.0);
    }
    estimate *= frame.medium.w * transmittance(frame.medium.w, distance) / max(pdf_distance(distances, distance), 1e-30);
    sum += estimate;
    float weight = luminance(estimate) + 1e-12;
    weights += weight;
    places += weight * distance;
  } while (++i < frame.spp);
  radiance.at[frame.width * frame.height + at] = vec4(frame.medium.rgb * sum / float(frame.spp), places / weights);
}
#endif
