// Step `trees` of techniques whose cells have none.
#include "estimators/pstf/steps/cells.glsl"

const bool kHasTrees = false;

struct CellTree {
  uint none;
};
uint taught_leaf(CellTree tree, vec3 direction) { return 0u; }
void teach_leaf(uint slot, uint leaf, float light, uint bits) {}
