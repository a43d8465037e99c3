// The tree that rays are traced through, as the host builds it and the device refits and traverses it. A node holds
// both children's boxes, so that one fetch decides about two subtrees. One buffer holds all nodes: node 0 is this
// frame's root, then come the meshes' trees, the trees of this frame's copies (what is not the world stands in the
// world's space as a copy), and the frame's nodes above all these.
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
// 27..29 and the first one's index in bits 0..26.
FB_CONST uint kRefLeaf = 0x80000000u;
FB_CONST uint kRefCountShift = 27u;
FB_CONST uint kRefCountMask = 7u;
FB_CONST uint kRefFirstMask = 0x07ffffffu;
FB_CONST uint kMaxLeafTriangles = 8u;

// Depth: inner nodes on the longest way from a root to a leaf, in a mesh's tree and in what stands above the meshes.
// The traversal keeps a bit for each: both together are at most kTraversalDepth.
FB_CONST uint kMaxMeshDepth = 40u;
FB_CONST uint kMaxInstanceDepth = 20u;
FB_CONST uint kTraversalDepth = 64u;

FB_NAMESPACE_END
#endif
