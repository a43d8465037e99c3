// Cells of an adaptive hash grid (shared/hash_grid.h) in a table of slots: found by position and orientation at a level
// that the distance to the camera chooses, in two slots, then in two of a coarser cell. A cell that has none may claim
// a slot that is empty, or whose cell was not used for long. Before it the includer defines how a slot says what it
// holds:
//
//   uint cell_check(uint slot)   GridKey::check of its cell; 0: it is empty
//   uint cell_age(uint slot)     frames since it was used
//
// Who keeps a second table beside another's includes it once more, with names of its own: FIND_CELL, CELL_CHECK and
// CELL_AGE.
#ifndef FB_LIB_CELLS
#define FB_LIB_CELLS
#include "lib/frame_bindings.glsl"
#include "shared/hash_grid.h"
#include "shared/scene_gpu.h"

const uint kCellTries = 4u;  // two slots for a cell, then two for a coarser one

struct CellPlace {
  uint slot;   // that holds the cell, or kNoIndex
  uint claim;  // that it could have, or kNoIndex
  uint check;  // for the claim
};
#endif

#ifndef FIND_CELL
#define FIND_CELL find_cell
#define CELL_CHECK cell_check
#define CELL_AGE cell_age
#endif

// Of the cell about a point, one of the eight corners' at random, so that no border shows. `kind`: tells users of one
// table apart (kCacheTag); `angle`: tangent of the angle that a cell subtends; `slots`: a power of two; `stale`:
// frames. Lanes that share `rng` choose alike, so that they share memory.
CellPlace FIND_CELL(vec3 p, vec3 axis, uint kind, float angle, uint slots, uint stale, inout uint rng) {
  CellPlace cell = CellPlace(kNoIndex, kNoIndex, 0u);
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  uint level = grid_level(distance(p, frame.camera_position.xyz), angle, rng_uniform(rng));
  uint i = 0u;
  do {
    uint at = min(level + (i >> 1u), kGridLevels - 1u);
    GridKey key = grid_vertex(p, exp2(float(at)), kind + adaptive_tag(at, axis), u);
    uint slot = (key.hash & (slots - 1u)) ^ (i & 1u);
    uint check = CELL_CHECK(slot);
    if (check == key.check) {
      cell.slot = slot;
      break;
    }
    if (cell.claim == kNoIndex && (check == 0u || CELL_AGE(slot) > stale)) {
      cell.claim = slot;
      cell.check = key.check;
    }
  } while (++i < kCellTries);
  return cell;
}

#undef FIND_CELL
#undef CELL_CHECK
#undef CELL_AGE
