// The trees that rays are traced through, as the host builds them and the device refits and traverses them. A node holds
// both children's boxes, so that one fetch decides about two subtrees. One buffer holds all nodes: node 0 is the root of
// this frame's tree over instances, then come the meshes' trees, the posed instances' copies, and the rest of the
// instances' tree.
#ifndef FB_SHARED_BVH_H
#define FB_SHARED_BVH_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

struct BvhNode {  // 64 bytes
  vec3 min0;
  uint child0;  // a reference, see below
  vec3 max0;
  uint child1;
  vec3 min1;
  uint pad0;
  vec3 max1;
  uint pad1;
};

// A reference to a child. Below kRefLeaf: an inner node's index. kRefLeaf: triangles, their number less one in bits
// 27..29 and the first one's index in bits 0..26. kRefLeaf and kRefInstance: an instance, its visibility in bits 28..29
// and its index in bits 0..27.
FB_CONST uint kRefLeaf = 0x80000000u;
FB_CONST uint kRefInstance = 0x40000000u;
FB_CONST uint kRefCountShift = 27u;
FB_CONST uint kRefCountMask = 7u;
FB_CONST uint kRefFirstMask = 0x07ffffffu;
FB_CONST uint kRefVisibilityShift = 28u;
FB_CONST uint kRefVisibilityMask = 3u;
FB_CONST uint kRefInstanceMask = 0x0fffffffu;
FB_CONST uint kMaxLeafTriangles = 8u;

// Depth: inner nodes on the longest way from a root to a leaf. The traversal's stack holds kTraversalStack references.
FB_CONST uint kMaxMeshDepth = 40u;
FB_CONST uint kMaxInstanceDepth = 20u;
FB_CONST uint kTraversalStack = 64u;

FB_NAMESPACE_END
#endif
