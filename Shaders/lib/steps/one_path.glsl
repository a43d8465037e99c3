// Step `begin` of a technique that does not learn.
#include "lib/path_state.glsl"

Path begin_path(uvec2 block, uint number, uint i) { return Path(number, 0u, false, false, false, 0u); }
