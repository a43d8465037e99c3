// Step `begin` of paths that know a field of light. The includer says whether paths may end in it (kEndsInField), and
// whether it may stand for a part of a vertex's light (kPredicts); both are biased.
#ifndef FB_PSTF_BEGIN
#define FB_PSTF_BEGIN
#include "estimators/pstf/steps/cells.glsl"

// Where paths end in the field, so many go on: else no one would teach what only second vertices see.
const float kLeastGamma = 1.0 / 8.0;

// Of paths whose first vertex's light is predicted.
struct FirstVertex {
  CellPlace place;
  float crowd;
  vec3 normal, reflectance;
  float scale;  // on what its direction brings
  vec3 tail;    // light of the path without prediction
  uint region;  // of the world
};

struct PathOwn {
  uint group_rng;   // random numbers that lanes that run together (4x2 pixels) share
  bool teaches;     // cells that have been taught much, too; alike in such lanes
  bool goes_on;     // where paths end in the field: this one does not; alike, too
  bool scattered;   // it has left a vertex,
  vec3 from;        // this one
  vec3 looked_for;  // light that this vertex found by a ray more, as it reflects it
  FirstVertex first;
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  uint group = (block.y >> 1u) * frame.width + (block.x >> 2u);
  path.own.group_rng = rng_seed(group, frame.frame, i, frame.seed ^ (IN_MEDIUM ? 0x3c6ef372u : 0x1f83d9abu));
  path.own.teaches = rng_next(path.own.group_rng) % uint(pstf.pstf_train) == 0u;
  path.own.goes_on = kEndsInField && rng_uniform(path.own.group_rng) < max(pstf.pstf_gamma, kLeastGamma);
  path.own.scattered = false;
  path.own.first = FirstVertex(CellPlace(kNoIndex, kNoIndex, 0u), 0.0, vec3(0.0), vec3(0.0), 1.0, vec3(0.0), 0u);
  path.own.from = path.own.looked_for = vec3(0.0);
}
#endif
