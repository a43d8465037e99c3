// Places on a triangle as samples keep them: two numbers of [0, 1), of 16 bits each in a word. Their measure is uniform
// on the triangle and of size one for each, so that a sample that is shifted to where its lamp was, or to another
// vertex, has Jacobian 1.
#ifndef FB_RESTIR_PLACES_H
#define FB_RESTIR_PLACES_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_FN vec2 unit_place(uint place) {
  return vec2((float(place >> 16u) + 0.5f) / 65536.0f, (float(place & 0xffffu) + 0.5f) / 65536.0f);
}
FB_FN uint packed_place(vec2 u) {
  uint x = min(uint(max(u.x, 0.0f) * 65536.0f), 0xffffu), y = min(uint(max(u.y, 0.0f) * 65536.0f), 0xffffu);
  return x << 16u | y;
}

// The weights of a triangle's vertices 1 and 2 at a place on it, and back.
FB_FN vec2 triangle_place(vec2 u) {
  float root = sqrt(u.x);
  return vec2(root * (1.0f - u.y), root * u.y);
}
FB_FN vec2 unit_of_triangle(vec2 bary) {
  float both = bary.x + bary.y;
  return vec2(both * both, bary.y / max(both, 1e-20f));
}

FB_NAMESPACE_END
#endif
