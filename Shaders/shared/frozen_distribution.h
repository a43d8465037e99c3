// Distributions of directions that are learnt in one frame or iteration and then frozen: while paths draw from one it
// does not change, and the density of any direction is a function of its data alone. That is what MIS between vertices,
// pixels and iterations asks for, and what a guide whose lobes are chosen at random cannot give. A kind of distribution
// is a header with
//
//   FrozenSample frozen_draw(d, vec2 u)         a direction from two uniform numbers, with its density
//   float        frozen_pdf(d, vec3 direction)  the density of any direction, per steradian, above zero everywhere
//
// This kind is constant over each cell of a square of side x side cells that maps to the sphere with equal areas (the
// shared/equal_area.h). A cell's probability is a whole number of 65536ths, the same when it is drawn and
// when it is divided by. It takes 2 bytes a cell: 128 for 8 x 8.
//
// Where its words are says the includer: in C++ an argument, in GLSL FB_FROZEN_WORD(at), defined before this header,
// and for build_frozen FB_FROZEN_STORE(at, word) and FB_FROZEN_WEIGHT(cell), the weight that was learnt.
#ifndef FB_SHARED_FROZEN_DISTRIBUTION_H
#define FB_SHARED_FROZEN_DISTRIBUTION_H
#include "shared/equal_area.h"
FB_NAMESPACE_BEGIN

#ifdef __cplusplus
#define FB_FROZEN_WORDS const uint *words,
#define FB_FROZEN_PASS words,
#define FB_FROZEN_WORD(at) words[at]
#define FB_FROZEN_BUILDS const float *weights, uint *words,
#define FB_FROZEN_STORE(at, word) words[at] = (word)
#define FB_FROZEN_WEIGHT(cell) weights[cell]
#else
#define FB_FROZEN_WORDS
#define FB_FROZEN_PASS
#define FB_FROZEN_BUILDS
#endif

// --- the distribution ---
FB_CONST uint kFrozenParts = 65536u;
FB_CONST uint kMostFrozenSide = 64u;

struct FrozenMap {
  uint first;  // word of the first cells; cells / 2 words
  uint side;   // even, 2 to kMostFrozenSide
};
FB_FN uint frozen_cells(FrozenMap d) { return d.side * d.side; }

// Row by row; every direction has one, whatever rounding does at the edges.
FB_FN uint frozen_cell(FrozenMap d, vec3 direction) {
  vec2 p = equal_area_from_direction(direction);
  float scale = 0.5f * float(d.side), most = float(d.side - 1u);
  return uint(clamp((p.y + 1.0f) * scale, 0.0f, most)) * d.side + uint(clamp((p.x + 1.0f) * scale, 0.0f, most));
}
// `place` in [0, 1)^2 of the cell.
FB_FN vec3 frozen_direction(FrozenMap d, uint cell, vec2 place) {
  float width = 2.0f / float(d.side);
  return direction_from_equal_area(
      vec2((float(cell % d.side) + place.x) * width - 1.0f, (float(cell / d.side) + place.y) * width - 1.0f));
}

// 65536ths of all cells before this one; `cell` up to their number.
FB_FN uint frozen_before(FB_FROZEN_WORDS FrozenMap d, uint cell) {
  if (cell >= frozen_cells(d)) return kFrozenParts;
  uint two = FB_FROZEN_WORD(d.first + (cell >> 1u));
  return (cell & 1u) != 0u ? two >> 16u : two & 0xffffu;
}
FB_FN float frozen_density(FrozenMap d, uint parts) {
  return float(parts * frozen_cells(d)) * (0.25f / (kSpherePi * float(kFrozenParts)));
}

struct FrozenSample {
  vec3 direction;  // unit
  float pdf;       // per steradian
  uint cell;
};

// Of density frozen_pdf. u in [0, 1)^2; of 24 bits of u.x a cell of p 65536ths leaves 8 + log2(p) to the place in it.
// At the very edge of a cell rounding may put the direction into its neighbour: the pdf stays that of the cell that was
// drawn, with which it was as frequent.
FB_FN FrozenSample frozen_draw(FB_FROZEN_WORDS FrozenMap d, vec2 u) {
  float parts = u.x * float(kFrozenParts);
  uint low = 0u, high = frozen_cells(d), whole = uint(parts);
  while (high - low > 1u) {
    uint middle = (low + high) >> 1u;
    if (frozen_before(FB_FROZEN_PASS d, middle) <= whole)
      low = middle;
    else
      high = middle;
  }
  uint before = frozen_before(FB_FROZEN_PASS d, low), count = frozen_before(FB_FROZEN_PASS d, low + 1u) - before;
  FrozenSample s;
  s.cell = low;
  s.pdf = frozen_density(d, count);
  s.direction = frozen_direction(d, low, vec2((parts - float(before)) / float(count), u.y));
  return s;
}

FB_FN float frozen_pdf(FB_FROZEN_WORDS FrozenMap d, vec3 direction) {
  uint cell = frozen_cell(d, direction);
  return frozen_density(d, frozen_before(FB_FROZEN_PASS d, cell + 1u) - frozen_before(FB_FROZEN_PASS d, cell));
}

// --- build ---
// A weight is 0 to 1e30; all else counts as 0.
FB_FN float frozen_weight(float weight) { return weight > 0.0f && weight <= 1e30f ? weight : 0.0f; }

// 65536ths before a cell from the sum of weights before it and that of all. Every cell has the `least` share of an even
// one, 0 to 1, and no fewer than one part, so that no direction is left out; rounding changes a probability by at most
// 1/65536. All zero: uniform.
FB_FN uint frozen_parts_before(FrozenMap d, uint cell, float sum_before, float sum, float least) {
  uint cells = frozen_cells(d), even = kFrozenParts / cells;
  uint floor_parts = uint(clamp(least * float(even) + 0.5f, 1.0f, float(even)));
  float share = sum > 0.0f ? min(sum_before / sum, 1.0f) : float(cell) / float(cells);
  return cell * floor_parts + uint(share * float(kFrozenParts - cells * floor_parts) + 0.5f);
}

// All words of one distribution, by one thread: two walks over its weights.
#if defined(__cplusplus) || defined(FB_FROZEN_STORE)
FB_FN void build_frozen(FB_FROZEN_BUILDS FrozenMap d, float least) {
  float sum = 0.0f, before = 0.0f;
  for (uint i = 0u; i < frozen_cells(d); ++i) sum += frozen_weight(FB_FROZEN_WEIGHT(i));
  for (uint i = 0u; i < frozen_cells(d); i += 2u) {
    uint word = frozen_parts_before(d, i, before, sum, least);
    before += frozen_weight(FB_FROZEN_WEIGHT(i));
    word |= frozen_parts_before(d, i + 1u, before, sum, least) << 16u;
    before += frozen_weight(FB_FROZEN_WEIGHT(i + 1u));
    FB_FROZEN_STORE(d.first + (i >> 1u), word);
  }
}
#endif

FB_NAMESPACE_END
#endif
