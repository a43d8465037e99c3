// Step `field` of a technique that knows nothing of the light about a point.
#include "lib/path_state.glsl"

const bool kHasField = false;
const bool kEndsInField = false;

struct Field {
  uint none;
};
Field field_at(Vertex v, inout Path path) { return Field(0u); }
vec3 field_reflection(Field there, Field here, Vertex v) { return vec3(0.0); }
bool field_suffices(Field there, Field here, Path path) { return false; }
