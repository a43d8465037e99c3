// `mir` and `mir_nee`: multiple importance reweighting for path guiding (Fan 2025), without and with light that is
// looked for: what they keep, and what can be set.
#ifndef FB_MIR_H
#define FB_MIR_H
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

// A frame's paths, one a pixel, in r_bounces vertices each, pixel by pixel. Vertex i of a path:
//   places      position; density of its direction by the vertex's own scattering
//   directions  its direction; density by that and the distribution together
//   links       what left vertex i - 1 towards the viewer for radiance that comes to vertex i: the weight f cos / pdf
//   at i, times
//               what is left of light on the way to it; 1 where a distribution may have its share in the density
//   lights      radiance that was met, as it arrives at the vertex; density with which it is looked for there
// and where light is looked for, two more elements of `lights`:
//               what the vertex reflects of what it found, as it arrives at the vertex before; density of looking there
//               its direction; density of that by the vertex's own scattering
// A last vertex that does either by one ray (turns) has that in the first of these, with densities of 0.
// Ends: how many vertices a path has; the factor on its light (what fog leaves, how its first vertex was chosen).
// Totals: the frame's radiance of a pixel, all of it. Arrays: X(constant, binding, what there is one element of, bytes
// of one, two halves, name).
#define FB_MIR_ARRAYS(X)                                            \
  X(kMirPlaces, 0u, kTable, 16u, false, "vertices' places")         \
  X(kMirDirections, 1u, kTable, 16u, false, "vertices' directions") \
  X(kMirLinks, 2u, kTable, 16u, false, "vertices' weights")         \
  X(kMirLights, 3u, kTable, 16u, false, "light that vertices met")  \
  X(kMirEnds, 4u, kTable, 16u, false, "ends of paths")              \
  X(kMirTotals, 5u, kTable, 16u, false, "a frame's radiance")
FB_MIR_ARRAYS(FB_ARRAY_CONSTANT)
// What the host writes: this iteration's distributions (guiding_tree.h), and the picture of all iterations.
FB_CONST uint kMirTree = 6u;     // uint[]: the spatial tree, then each leaf's first node
FB_CONST uint kMirNodes = 7u;    // uvec4[]
FB_CONST uint kMirPicture = 8u;  // vec4[pixels]
FB_CONST uint kMirLightsOfOne = 1u,
              kMirLightsLooked = 3u;  // elements of `lights` of a vertex, where light is looked for

// clang-format off
#define FB_MIR_SETTINGS(X) \
  X(int, mir_weights, "r_mir_weights", 0, 0, 6, "mir: how iterations are combined: 0 each path by the balance heuristic over all iterations' densities (Fan 2025, Eq. 6), 1 with variance awareness (Eq. 7), 2 all samples alike, 3 the last iteration alone, 4 iterations by inverse variance of the picture, 5 of each pixel, 6 each vertex's direction by itself, in the place of the path's; all but 2 and 3 are biased") \
  X(float, mir_outliers, "r_mir_outliers", 0, 0, 1000, "mir: outlier removal after all other weights (Zirr 2018): samples count in full where so many about their pixel are as bright, and less where there are fewer; 0 all do; biased") \
  X(int, mir_decorrelated, "r_mir_decorrelated", 0, 0, 1, "mir: 1 the first half of each iteration's samples teaches and is not seen, and the other half is seen and teaches nothing: then Eq. 6 is unbiased") \
  X(int, mir_storage, "r_mir_storage", 500, 0, 65536, "mir: MB for stored paths; the least important are let go of beyond it") \
  X(int, mir_partial, "r_mir_partial", 1, 0, 1, "mir: paths that are let go of are weighed by the iterations so far (Eq. 8); 0 they are not weighed") \
  X(float, mir_split, "r_mir_split", 4000, 10, 1000000, "mir: vertices at which a leaf of the spatial tree is split, times the root of an iteration's samples") \
  X(float, mir_share, "r_mir_share", 0.01f, 0.0001f, 1, "mir: share of a leaf's light at which a part of the sphere is split in four") \
  X(int, mir_filter, "r_mir_filter", 1, 0, 1, "mir: 1 samples are spread over a leaf's width in space and direction as they are learnt") \
  X(float, mir_defence, "r_mir_defence", 0.5f, 0.01f, 1, "mir: share of directions by the vertex's own scattering")
// clang-format on

struct MirConstants {
  vec3 cube_low;  // GuidingCube
  float cube_inverse_width;
  FB_MIR_SETTINGS(FB_UNIFORM_FIELD)
  int nee_candidates;
  uint stored;       // vertices that a path stores at most; 0: nothing is stored
  uint paths;        // pixels whose paths are stored, from the first on
  uint taught;       // 1: there are distributions
  uint levels;       // of the spatial tree's deepest leaf
  uint node_levels;  // of nodes, of the deepest directional tree
  uint leaves;       // where leaves' first nodes begin in the tree's words
};

FB_NAMESPACE_END
#endif
