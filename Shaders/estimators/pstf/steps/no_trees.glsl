// Step `trees` of techniques whose cells have none.
#include "estimators/pstf/steps/cells.glsl"

const bool kHasTrees = false;

struct CellTree {
  uint none;
};
void teach_directions(uint slot, CellTree tree, vec3 direction, float light, uint bits) {}
