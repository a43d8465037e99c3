// Step `begin`: which lobe a path samples, and what the pixel's chain will hear of it.
#ifndef FB_SSMM_BEGIN
#define FB_SSMM_BEGIN
#include "estimators/ssmm/steps/states.glsl"

struct PathOwn {
  uint path;         // of its pixel
  uint element;      // whose lobe its first vertex samples; kNoIndex: none
  bool scattered;    // its first direction is the vertex's own scattering
  vec3 origin, hit;  // of its first ray
  float score;       // of what that met; 0: nothing
  vec3 looked_for;   // light that its first vertex found by a ray more
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  Tile t = tile_at(block, i);
  path.own.path = i;
  path.own.element = element_of_lane(t, sampled_lane(t, i));
  path.own.scattered = true;
  path.own.origin = path.own.hit = path.own.looked_for = vec3(0.0);
  path.own.score = 0.0;
}
#endif
