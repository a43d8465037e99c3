// What a path's ray met, for steps that learn from it. The technique's Field is defined before.
#ifndef FB_LIB_INCIDENT
#define FB_LIB_INCIDENT
#include "lib/path_state.glsl"

struct Incident {
  vec3 origin;      // of the ray
  Segment way;      // from there; way.hit.instance kNoIndex: nothing was met
  bool sky;         // the light is from far behind it
  vec3 emission;    // radiance that is emitted there: the share that this ray stands for
  vec3 reflection;  // and reflected, as far as the field knows
  Field field;      // about the point that was met; about the ray's own vertex where there is none
};
#endif
