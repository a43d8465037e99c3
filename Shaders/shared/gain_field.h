// The field of factors between a map's light and its baked light (Quake/scene/authored/gain_field.h): which of six ways
// a surface faces. The first vertex of a path has it on its albedo (lib/seen_texel.glsl).
#ifndef FB_SHARED_GAIN_FIELD_H
#define FB_SHARED_GAIN_FIELD_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kGainWays = 6u;  // +x -x +y -y +z -z

// How much a surface of that normal faces a way; over all six the sum is 1.
FB_FN float gain_weight(vec3 normal, uint way) {
  uint axis = way / 2u;
  float along = axis == 0u ? normal.x : (axis == 1u ? normal.y : normal.z);
  return (way & 1u) == (along < 0.0f ? 1u : 0u) ? along * along : 0.0f;
}

FB_NAMESPACE_END
#endif
