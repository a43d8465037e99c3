// What a camera in a liquid sees, distorted as Quake's software renderer did it (d_scan.c, D_WarpScreen): sines across
// the picture move its columns by their rows and its rows by their columns. That picture was 200 rows high, with waves
// of 3 pixels and 128 pixels long that moved 20 pixels a second; these are the same parts of any picture's height.
#ifndef FB_SHARED_PICTURE_WARP_H
#define FB_SHARED_PICTURE_WARP_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST float kWarpHeight = 0.015f;    // of a wave, of the picture's height: what it moves to either side
FB_CONST float kWarpLength = 0.64f;     // of the picture's height
FB_CONST float kWarpTurns = 0.15625f;   // a second
FB_CONST float kWarpTurn = 6.2831853f;  // a whole one

// Where the picture of this size shows what is seen at a point of it, in pixels; phase in radians. The picture is
// compressed by what the waves need, so that none of its points is shown from beyond its edges.
FB_FN vec2 warped_point(vec2 point, vec2 size, float phase) {
  float height = kWarpHeight * size.y;
  vec2 turns = vec2(point.y, point.x) * (kWarpTurn / (kWarpLength * size.y)) + vec2(phase);
  vec2 moved = point + height * (vec2(1.0f) + sin(turns));
  return clamp(moved * size / (size + vec2(2.0f * height)), vec2(0.0f), size);
}

FB_NAMESPACE_END
#endif
