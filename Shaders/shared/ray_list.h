// Rays and hits as plain lists: what tests and the traversal benchmark exchange with passes/trace_rays.comp.
#ifndef FB_SHARED_RAY_LIST_H
#define FB_SHARED_RAY_LIST_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

struct ListRay {  // 48 bytes
  vec3 origin;
  float t_min;
  vec3 direction;
  float t_max;
  uint mask;  // scene::Visibility
  uint pad0, pad1, pad2;
};

struct ListHit {  // 32 bytes
  float t;
  float u, v;     // weights of vertices 1 and 2
  uint instance;  // index on the device; kNoIndex: nothing was hit, the rest means nothing
  uint id;        // scene::Instance::id
  uint vertex0;   // the triangle's first vertex in its mesh
  uint triangle;  // in leaf order
  uint pad0;
};

FB_NAMESPACE_END
#endif
