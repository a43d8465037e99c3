// Dynamic diffuse global illumination (DDGI: Majercik 2019, 2021; its extension and resampling: Majercik 2022): probes
// in a grid that keep the light about them and the distances around. What its techniques keep, what can be set, what
// they show, and the arithmetic of grids and probes, for C++ too. Equations are numbered as in Majercik 2022.
#ifndef FB_DDGI_H
#define FB_DDGI_H
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/packing.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kDdgiMostX = 16u, kDdgiMostY = 16u, kDdgiMostZ = 8u;  // probes along each axis, at most
FB_CONST uint kDdgiMostProbes = kDdgiMostX * kDdgiMostY * kDdgiMostZ;
FB_CONST int kDdgiLightSide = 8, kDdgiDepthSide = 16;  // texels of a probe's octahedral maps
FB_CONST uint kDdgiLightTexels = 64u, kDdgiDepthTexels = 256u;

// A probe's record, uvec4[2]:
//   0: offset from its place in the grid, units (3 floats); ddgi_cell_key of the cell that it stands for, 0: of none
//   1: updates that its memory is worth, kDdgiMoves times how often it has moved, and kDdgiAsleep; the frame of its
//      last turn, 0: it had none; the frame in which a path last asked it, 0: none; the mean luminance around it
FB_CONST uint kDdgiUpdates = 0xffffu, kDdgiMoves = 0x10000u, kDdgiMostMoves = 8u, kDdgiAsleep = 0x80000000u;

// Arrays: X(constant, binding, what there is one element of, bytes of one, two halves, name). Light: radiance averaged
// over directions in proportion to the cosine about a texel's, irradiance over pi, pack_rgb9e5; where ddgi_keeps_sent
// says so, after all of these as many texels of each probe of the mean radiance within the texel that is reflected to
// it, not emitted. Distances: mean and
// mean square about a texel's direction, of the largest that is told apart, packUnorm2x16. Rays, vec4[2]: direction,
// and distance, negative at a back face; the light that it stands for, and what of it is reflected, pack_rgb9e5. Turns:
// the probe that has each, then how urgent probes are. The table is written by the host
// (render/techniques/probe_table.h), DdgiConstants says where each part of it begins: of each probe uvec4, where it
// stands off its place in the grid (3 floats) and kDdgiNowhere, else the two doors nearest to it, kDdgiDoor each, from
// 1; uvec4[2] a door, its box; uvec4[2] a node of the map's tree, its plane, and where its two sides go on: a node, or
// ~leaf, open leafs being numbered from 1; of each cube between eight probes the node that has all of it; of each probe
// a row of bits, of the leafs that may ask it.
#define FB_DDGI_ARRAYS(X)                                                            \
  X(kDdgiProbes, 0u, kProbe, 32u, false, "probes")                                   \
  X(kDdgiLight, 1u, kProbe, 4u * kDdgiLightTexels, false, "light of probes")         \
  X(kDdgiDepth, 2u, kProbe, 4u * kDdgiDepthTexels, false, "distances around probes") \
  X(kDdgiTurns, 6u, kProbe, 8u, false, "turns of probes")                            \
  X(kDdgiTable, 7u, kTable, 16u, false, "where probes stand and who may ask them")   \
  X(kDdgiRays, 8u, kTable, 32u, false, "a frame's rays of probes")
FB_DDGI_ARRAYS(FB_ARRAY_CONSTANT)
// Of ddgi_restir besides (steps/resampled.glsl): reservoirs of all light, the former frame's kept; those of this frame
// before neighbours are asked; light that is not theirs.
#define FB_DDGI_RESERVOIR_ARRAYS(X)                                                   \
  X(kDdgiReservoirs, 3u, kPixel, 32u, true, "reservoirs of all light")                \
  X(kDdgiMerged, 4u, kPixel, 32u, false, "reservoirs of all light before neighbours") \
  X(kDdgiRest, 5u, kPixel, 16u, false, "light that no reservoir has")
FB_DDGI_RESERVOIR_ARRAYS(FB_ARRAY_CONSTANT)

FB_CONST uint kDdgiNoProbe = 0xffffffffu;
FB_CONST uint kDdgiNowhere = 0x80000000u, kDdgiDoor = 0xffu;  // kDdgiDoor doors at most

// Specialisation constants of the passes over probes.
FB_CONST uint kSpecDdgiPlus = kSpecTechnique;   // light of Eq. 5, else of Eq. 4
FB_CONST uint kSpecDdgiRanks = kSpecTechnique;  // of the pass `turns`: its second step

// clang-format off
#define FB_DDGI_SETTINGS(X) \
  X(float, ddgi_spacing, "r_ddgi_spacing", 80, 0, 4096, "ddgi: distance between probes at most, units; a scene for which 16 x 16 x 8 of them do not suffice has them about the camera; 0: they stand evenly in the whole scene, however far apart") \
  X(int, ddgi_rays, "r_ddgi_rays", 16384, 64, 524288, "ddgi: rays of probes a frame, which take turns") \
  X(int, ddgi_probe_rays, "r_ddgi_probe_rays", 256, 16, 1024, "ddgi: rays of a probe in its turn") \
  X(float, ddgi_hysteresis, "r_ddgi_hysteresis", 0.9f, 0, 0.999f, "ddgi: share of what a probe knows that a turn leaves, once it has had 1 / (1 - r_ddgi_hysteresis) turns; before that all turns count alike") \
  X(float, ddgi_change, "r_ddgi_change", 6, 0, 1000, "ddgi: standard errors by which the light of a turn must differ from what is known for that to be dropped; 0: never") \
  X(int, ddgi_relocate, "r_ddgi_relocate", 1, 0, 1, "ddgi: probes move out of walls and off them") \
  X(int, ddgi_sleep, "r_ddgi_sleep", 1, 0, 1, "ddgi: probes sleep that are in walls or far from all surfaces: their turns come seldom, and nobody asks them") \
  X(int, ddgi_leaves, "r_ddgi_leaves", 1, 0, 1, "ddgi: a point asks probes only to which a way leads through the openings of the map's leafs and past closed doors; none stands in what is solid") \
  X(int, ddgi_visibility, "r_ddgi_visibility", 1, 0, 1, "ddgi: 1 probes count by whether they see a point (Chebyshev's bound), 0 whether they do or not: light leaks through walls") \
  X(float, ddgi_bias, "r_ddgi_bias", 0.2f, 0, 1, "ddgi: how far off a surface probes are asked, of their least spacing") \
  X(int, ddgi_view_bias, "r_ddgi_view_bias", 1, 0, 1, "ddgi_plus, ddgi_restir: 1 that is back along the path's ray, 0 along normal and ray, as in ddgi") \
  X(int, ddgi_vertex, "r_ddgi_vertex", 2, 1, 2, "ddgi_plus: the vertex of a path whose light is that of probes") \
  X(float, ddgi_attenuation, "r_ddgi_attenuation", 0, 0, 4, "ddgi_plus, ddgi_restir: factor on the distance from a probe to the surface behind it, by which light of lamps that it sees falls off further: 1 as in the paper, for small lamps; 0 not at all") \
  X(float, ddgi_looking, "r_ddgi_looking", 0.25f, 0, 0.75f, "ddgi_plus, ddgi_restir: share of a probe's rays that look for lights") \
  X(float, ddgi_footprint, "r_ddgi_footprint", 0.2f, 0, 1000, "ddgi_plus: ratio of a path's footprint to the pixel's from which on probes stand for what is mirrored, too (c)") \
  X(float, ddgi_geometry, "r_ddgi_geometry", 0.000645f, 0, 1e6f, "ddgi_restir: largest geometry term of light that reservoirs have, per square unit; what is beyond scattered rays bring; 0: there is no bound. The paper's 1 is per square metre") \
  X(int, ddgi_control, "r_ddgi_control", 0, 0, 1, "ddgi_plus: 1 what a probe near the first vertex knows to be reflected from each direction is a control variate there: the same mean, by another noise") \
  X(float, ddgi_guide, "r_ddgi_guide", 0, 0, 0.95f, "ddgi_plus: share of the first vertex's directions that are drawn by what a probe near it knows to be reflected from each; the others are of its own scattering") \
  X(int, ddgi_form, "r_ddgi_form", 0, 0, 1, "ddgi_plus, ddgi_restir, for tests: 1 what is mirrored is divided by 2 pi as Eq. 6 is printed: half as bright as it should be")
// clang-format on

FB_CONST uint kViewOfDdgi = kViewOfTechniques + 4u;
// clang-format off
#define FB_DDGI_VIEWS(X) \
  X(kViewDdgiLight, 42u, kViewOfDdgi, "ddgi_light", "ddgi: light that probes say falls on surfaces, over pi; magenta: nothing is known") \
  X(kViewDdgiProbes, 43u, kViewOfDdgi, "ddgi_probes", "ddgi: probes as balls that show their light; red: asleep, magenta: not yet known") \
  X(kViewDdgiDistances, 44u, kViewOfDdgi, "ddgi_distances", "ddgi: probes as balls that show the distance of what is around them, white: far")
// clang-format on
FB_DDGI_VIEWS(FB_VIEW_CONSTANT)

struct DdgiConstants {
  vec4 origin;   // of the grid: the corner of cell 0, 0, 0; w: the largest distance that is told apart
  vec4 spacing;  // of probes, units; w: the least of the three
  FB_DDGI_SETTINGS(FB_UNIFORM_FIELD)
  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)
  int first_x, first_y, first_z;  // the first cell that has a probe, and how many there are along each axis
  int count_x, count_y, count_z;
  uint probes;                                              // their product
  uint table_doors, table_nodes, table_starts, table_rows;  // parts of the table: elements, and words of the last two
  uint doors;                                               // 0: there are none; without a table, too
  uint row_words;                                           // of a probe's row of leafs; 0: nothing is known of leafs
  uint leaf_steps;                                          // from a cube's node down to a leaf at most
  uint stands;                                              // 0: there is no table, probes stand in the grid
  uint turns, rays;                                         // probes that have a turn in this frame, and rays of each;
  uint looking;                                             // of which so many look for lights
  uint frame_number;                                        // frames since it forgot, from 1
  uint seen_stride;  // of this many shadow rays one is remembered; a power of two
  uint seen_ways;    // the table of ways that is read, 0 or 1
  // Of ddgi_restir, as ReSTIR's settings have it:
  float restir_history, restir_radius;
  int restir_neighbors;
  uint reservoirs_now, reservoirs_former;  // halves, elements; former kNoIndex: there are none
};

// --- Octahedral maps ---
// The texel at x, y of a map of side x side, as an index; beyond an edge, by one, the neighbour across it: maps fold
// over their edges, which takes the place of borders.
FB_FN uint ddgi_texel(int x, int y, int side) {
  if (x < 0 || x >= side) {
    x = x < 0 ? -1 - x : 2 * side - 1 - x;
    y = side - 1 - y;
  }
  if (y < 0 || y >= side) {
    y = y < 0 ? -1 - y : 2 * side - 1 - y;
    x = side - 1 - x;
  }
  return uint(y * side + x);
}
// The direction of a texel's middle.
FB_FN vec3 ddgi_direction(uint texel, int side) {
  float x = float(int(texel) % side), y = float(int(texel) / side), scale = 2.0f / float(side);
  return direction_from_octahedral(vec2((x + 0.5f) * scale - 1.0f, (y + 0.5f) * scale - 1.0f));
}
// The four texels about a direction, and their weights.
struct DdgiTaps {
  uvec4 texel;
  vec4 weight;
};
FB_FN DdgiTaps ddgi_taps(vec3 d, int side) {
  vec2 p = octahedral_from_direction(d);
  float px = (p.x * 0.5f + 0.5f) * float(side) - 0.5f, py = (p.y * 0.5f + 0.5f) * float(side) - 0.5f;
  int x = int(floor(px)), y = int(floor(py));
  float u = px - float(x), v = py - float(y);
  DdgiTaps t;
  t.texel = uvec4(ddgi_texel(x, y, side), ddgi_texel(x + 1, y, side), ddgi_texel(x, y + 1, side),
                  ddgi_texel(x + 1, y + 1, side));
  t.weight = vec4((1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v);
  return t;
}

// The texel that a direction lies in, and its solid angle, by the mean of 16 points.
FB_FN uint ddgi_texel_about(vec3 d, int side) {
  vec2 p = (octahedral_from_direction(d) * 0.5f + 0.5f) * float(side);
  return uint(clamp(int(p.y), 0, side - 1) * side + clamp(int(p.x), 0, side - 1));
}
FB_FN float ddgi_texel_angle(uint texel, int side) {
  int fine = 4 * side, x = 4 * (int(texel) % side), y = 4 * (int(texel) / side);
  float mean = 0.0f;
  for (int i = 0; i < 16; ++i) {
    vec3 d = ddgi_direction(uint((y + i / 4) * fine + x + i % 4), fine);
    float sum = abs(d.x) + abs(d.y) + abs(d.z);  // 1 / the length of the octahedron's point there
    mean += sum * sum * sum / 16.0f;
  }
  return 4.0f * mean / float(side * side);
}

// --- Cells of a hemisphere that have the same share of the cosine (for Section 5.1) ---
// What is even within each of them has the mean over cells as its mean over the cosine, exactly. They are those of the
// unit square that sample_cosine_hemisphere makes a hemisphere of.
FB_CONST uint kDdgiRings = 4u, kDdgiSectors = 8u, kDdgiCells = 32u;
FB_FN uint ddgi_cosine_cell(vec3 local) {
  float ring = (local.x * local.x + local.y * local.y) * float(kDdgiRings);
  // An octant begins where a coordinate is zero or both are alike.
  uint quarter = local.y >= 0.0f ? (local.x >= 0.0f ? 0u : 1u) : (local.x < 0.0f ? 2u : 3u);
  bool steep = abs(local.y) > abs(local.x), second = (quarter & 1u) == 0u ? steep : !steep;
  return min(uint(ring), kDdgiRings - 1u) * kDdgiSectors + 2u * quarter + (second ? 1u : 0u);
}
// A point of the unit square in a cell's part of it, for `u` in [0, 1)^2.
FB_FN vec2 ddgi_cell_place(uint cell, vec2 u) {
  return vec2((float(cell / kDdgiSectors) + u.x) / float(kDdgiRings),
              (float(cell % kDdgiSectors) + u.y) / float(kDdgiSectors));
}
FB_FN bool ddgi_keeps_sent(int control, float guide) { return control != 0 || guide > 0.0f; }

// --- The grid ---
// A probe keeps its cell while the volume moves on: its place in the arrays is its cell modulo the volume's size.
FB_FN int ddgi_modulo(int cell, int count) {
  int m = cell % count;
  return m < 0 ? m + count : m;
}
// The cell from `first` on whose place is `place`.
FB_FN int ddgi_cell_of(int place, int first, int count) { return first + ddgi_modulo(place - first, count); }
FB_FN uint ddgi_cell_key(int x, int y, int z) {
  return 0x40000000u | (uint(x) & 0x3ffu) | (uint(y) & 0x3ffu) << 10u | (uint(z) & 0x3ffu) << 20u;
}

// The part of a way from 0 to 1, along one axis, that lies between two planes by more than kDdgiDoorSkin.
FB_CONST float kDdgiDoorSkin = 0.25f;  // units
FB_FN vec2 ddgi_between(float from, float to, float low, float high) {
  float way = to - from;
  way = way >= 0.0f ? max(way, 1e-6f) : min(way, -1e-6f);
  float a = (low + kDdgiDoorSkin - from) / way, b = (high - kDdgiDoorSkin - from) / way;
  return vec2(min(a, b), max(a, b));
}
// Whether the straight way from a point to another leads through a box.
FB_FN bool ddgi_is_shut(vec3 from, vec3 to, vec3 low, vec3 high) {
  vec2 x = ddgi_between(from.x, to.x, low.x, high.x), y = ddgi_between(from.y, to.y, low.y, high.y);
  vec2 z = ddgi_between(from.z, to.z, low.z, high.z);
  return max(max(x.x, y.x), max(z.x, 0.0f)) < min(min(x.y, y.y), min(z.y, 1.0f));
}

// --- Weights of probes (Majercik 2019 and 2021) ---
// One-sided form of Chebyshev's inequality: the most that the share of distances beyond `distance` can be, sharpened,
// and never nothing.
FB_CONST float kDdgiLeastVisible = 0.05f;
FB_FN float ddgi_visibility(float distance, float mean, float mean_square) {
  if (distance <= mean) return 1.0f;
  float off = distance - mean, variance = max(mean_square - mean * mean, 1e-6f);
  float bound = variance / (variance + off * off);
  return max(bound * bound * bound, kDdgiLeastVisible);
}
// Of a probe whose direction from the surface has this cosine to the normal.
FB_FN float ddgi_facing(float cosine) {
  float half_way = 0.5f * (cosine + 1.0f);
  return half_way * half_way + 0.2f;
}
// Small weights count for less than they are.
FB_CONST float kDdgiSmallWeight = 0.2f;
FB_FN float ddgi_crushed(float weight) {
  return weight < kDdgiSmallWeight ? weight * weight * weight / (kDdgiSmallWeight * kDdgiSmallWeight) : weight;
}
// What eight probes' weights add up to where none sees the point: then nothing is known.
FB_CONST float kDdgiLeastKnown = 0.005f;

// --- Directions of a probe's rays ---
// Point i of n of a spherical Fibonacci lattice (Keinert 2015).
FB_FN vec3 ddgi_sphere_point(uint i, uint n) {
  float turn = float(i) * 0.61803398875f;
  float phi = 6.2831853071796f * (turn - floor(turn)), z = 1.0f - (2.0f * float(i) + 1.0f) / float(n);
  float r = sqrt(max(0.0f, 1.0f - z * z));
  return vec3(r * cos(phi), r * sin(phi), z);
}
// A vector turned by a rotation that is uniform for u in [0, 1)^3 (Shoemake 1992).
FB_FN vec3 ddgi_turned(vec3 v, vec3 u) {
  float a = sqrt(1.0f - u.x), b = sqrt(u.x), s = 6.2831853071796f * u.y, t = 6.2831853071796f * u.z;
  vec3 q = vec3(a * sin(s), a * cos(s), b * sin(t));
  float w = b * cos(t);
  vec3 c = cross(q, v) * 2.0f;
  return v + c * w + cross(q, c);
}

// --- Paths' ends (Eq. 7 and 8, after Bekaert 2003) ---
// What a way of this length adds to the root of a path's footprint: from where its direction had a density, to where it
// meets a surface at this cosine.
FB_FN float ddgi_spread(float distance, float pdf, float cosine) {
  return pdf > 0.0f ? distance / sqrt(pdf * max(cosine, 1e-3f)) : 0.0f;
}
FB_FN float ddgi_seen_area(float distance, float cosine) {
  return 12.566370614f * distance * distance / max(cosine, 1e-3f);
}

// Light of a lamp at a distance from a probe, for a surface so far behind it: the factor by which it falls off further.
FB_FN float ddgi_attenuation(float distance, float behind) {
  float share = distance / max(distance + behind, 1e-6f);
  return share * share;
}

FB_NAMESPACE_END
#endif
