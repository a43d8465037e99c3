// Distributions of directions by place, learnt in one iteration and then frozen (practical path guiding: Müller 2017):
// a binary tree of a cube, whose levels halve x, y and z in turns, and in each leaf a quadtree over the square that
// maps to the sphere with equal areas (shared/equal_area.h, where the paper has cylindrical coordinates). A density is
// a function of place and direction alone, the same when a direction is drawn and when it is asked of one.
//
// The host builds them (render/techniques/guiding_trees.h). Where the words are says the includer: in C++ arguments, in
// GLSL FB_GUIDING_PLACE(at) and FB_GUIDING_NODE(at), defined before this header.
#ifndef FB_MIR_GUIDING_TREE_H
#define FB_MIR_GUIDING_TREE_H
#include "shared/equal_area.h"
FB_NAMESPACE_BEGIN

#ifdef __cplusplus
#define FB_GUIDING_PLACES const uint *places,
#define FB_GUIDING_NODES const uvec4 *nodes,
#define FB_GUIDING_PASS_NODES nodes,
#define FB_GUIDING_PLACE(at) places[at]
#define FB_GUIDING_NODE(at) nodes[at]
#define FB_GUIDING_LEAVE(there) \
  if (there) break;
#else
#define FB_GUIDING_LEAVE(there)
#define FB_GUIDING_PLACES
#define FB_GUIDING_NODES
#define FB_GUIDING_PASS_NODES
#endif

// The spatial tree: a word a node. With kGuidingLeaf: the number of the leaf; else where its two halves are, one after
// the other. A position beyond the cube is taken for the nearest in it.
FB_CONST uint kGuidingLeaf = 0x80000000u;
FB_CONST uint kUntaught = 0xffffffffu;  // in the place of a leaf's first node: it has no distribution
FB_CONST float kBelowOne = 0.99999994f;

struct GuidingCube {
  vec3 low;
  float inverse_width;
};

// All walks take the same number of rounds for all lanes, and who has arrived stays where it is: on lavapipe what a
// loop's rounds read from arrays is lost to lanes that leave it early. `levels`: of the deepest leaf, from 0.
FB_FN uint guiding_leaf(FB_GUIDING_PLACES GuidingCube cube, uint levels, vec3 position) {
  vec3 p = (position - cube.low) * cube.inverse_width;
  p = vec3(clamp(p.x, 0.0f, kBelowOne), clamp(p.y, 0.0f, kBelowOne), clamp(p.z, 0.0f, kBelowOne));
  uint node = FB_GUIDING_PLACE(0u), round = 0u;
  do {
    bool there = (node & kGuidingLeaf) != 0u;
    FB_GUIDING_LEAVE(there)
    uint upper = p.x >= 0.5f ? 1u : 0u;
    uint next = FB_GUIDING_PLACE(there ? 0u : node + upper);
    node = there ? node : next;
    p = vec3(p.y, p.z, 2.0f * p.x - float(upper));
  } while (++round <= levels);
  return node & ~kGuidingLeaf;
}

// A quadtree's node: a word for each quarter, its share of the node in 65535ths in the upper half, which add up to
// kGuidingParts, and in the lower half where its own node is, from the first on; 0: it has none, and is even.
// Quarters: bit 0 the upper half of x, bit 1 that of y.
FB_CONST float kGuidingParts = 65535.0f;
FB_CONST uint kMostGuidingNodes = 65535u;  // of a quadtree

FB_FN float guiding_share(uint word) { return float(word >> 16u) / kGuidingParts; }
FB_FN uint guiding_quarter(uvec4 node, uint quarter) {
  uint low = (quarter & 1u) != 0u ? node.y : node.x, high = (quarter & 1u) != 0u ? node.w : node.z;
  return (quarter & 2u) != 0u ? high : low;
}
// The square [0, 1)^2.
FB_FN vec2 guiding_place(vec3 direction) {
  vec2 p = equal_area_from_direction(direction);
  return vec2(clamp(0.5f * p.x + 0.5f, 0.0f, kBelowOne), clamp(0.5f * p.y + 0.5f, 0.0f, kBelowOne));
}

FB_FN uint guiding_quarter_at(vec2 p) { return (p.x >= 0.5f ? 1u : 0u) + (p.y >= 0.5f ? 2u : 0u); }

// Density of guiding_draw, per steradian. `levels`: of nodes, of the deepest tree.
FB_FN float guiding_pdf(FB_GUIDING_NODES uint first, uint levels, vec3 direction) {
  vec2 p = guiding_place(direction);
  float density = 0.25f / kSpherePi;
  uint at = first, round = 0u;
  bool there = false;
  do {
    uint quarter = guiding_quarter_at(p), word = guiding_quarter(FB_GUIDING_NODE(at), quarter);
    density *= there ? 1.0f : 4.0f * guiding_share(word);
    there = there || (word & 0xffffu) == 0u;
    FB_GUIDING_LEAVE(there)
    at = there ? at : first + (word & 0xffffu);
    p = vec2(2.0f * p.x - float(quarter & 1u), 2.0f * p.y - float(quarter >> 1u));
  } while (++round < levels);
  return density;
}

// A quarter of a node from two uniform numbers, and what is left of these.
struct GuidingChoice {
  uint quarter;
  vec2 left;
};
FB_FN GuidingChoice guiding_choice(uvec4 node, vec2 u) {
  vec4 parts = vec4(float(node.x >> 16u), float(node.y >> 16u), float(node.z >> 16u), float(node.w >> 16u));
  float west = parts.x + parts.z, x = u.x * kGuidingParts;
  bool east = x >= west;
  float south = east ? parts.y : parts.x, column = east ? parts.y + parts.w : west, y = u.y * column;
  bool north = y >= south;
  GuidingChoice c;
  c.quarter = (east ? 1u : 0u) + (north ? 2u : 0u);
  c.left.x = min((east ? x - west : x) / max(column, 1.0f), kBelowOne);
  c.left.y = min((north ? y - south : y) / max(north ? column - south : south, 1.0f), kBelowOne);
  return c;
}

// A direction from two uniform numbers in [0, 1).
FB_FN vec3 guiding_draw(FB_GUIDING_NODES uint first, uint levels, vec2 u) {
  vec2 low = vec2(0.0f, 0.0f);
  float width = 1.0f;
  uint at = first, round = 0u;
  bool there = false;
  do {
    uvec4 node = FB_GUIDING_NODE(at);
    GuidingChoice c = guiding_choice(node, u);
    uint word = guiding_quarter(node, c.quarter);
    width = there ? width : 0.5f * width;
    low = there ? low : vec2(low.x + width * float(c.quarter & 1u), low.y + width * float(c.quarter >> 1u));
    u = there ? u : c.left;
    there = there || (word & 0xffffu) == 0u;
    FB_GUIDING_LEAVE(there)
    at = there ? at : first + (word & 0xffffu);
  } while (++round < levels);
  vec2 p = vec2(low.x + width * u.x, low.y + width * u.y);
  return direction_from_equal_area(vec2(2.0f * p.x - 1.0f, 2.0f * p.y - 1.0f));
}

FB_NAMESPACE_END
#endif
