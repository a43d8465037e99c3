// trace() through our own tree: everything stands in the world's space (passes/pose.comp puts it there), so there is
// one tree, one loop, and a triangle says itself whose it is.
//
// Written twice: for 8-wide SIMD on a CPU (lavapipe), where a word fetched costs more than the arithmetic on it, and a
// branch more than a select; and for GPUs. Both visit the same nodes in the same order and find the same hits.
// traversal_bench measures it.
#ifndef FB_LIB_TRACE_BVH
#define FB_LIB_TRACE_BVH

layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsNodes) uniform usamplerBuffer node_texels;

const uint kRefDone = 0xffffffffu;       // bottom of the stack
const float kEdgeTolerance = 1e-5;       // of barycentric weights: closes cracks along shared edges
const float kSlabTolerance = 1.0000004;  // 2 gamma(3), Ize 2013

BvhNode node_at(uint index) {
  int at = int(index) * 4;
  uvec4 q0 = texelFetch(node_texels, at), q1 = texelFetch(node_texels, at + 1);
  uvec4 q2 = texelFetch(node_texels, at + 2), q3 = texelFetch(node_texels, at + 3);
  return BvhNode(uintBitsToFloat(q0.xyz), q0.w, uintBitsToFloat(q1.xyz), q1.w, uintBitsToFloat(q2.xyz), 0u,
                 uintBitsToFloat(q3.xyz), 0u);
}

// A ray that looks for its nearest hit behind `from`.
struct Ray {
  vec3 origin, direction, inv;
  float from;
  uint mask, refused;  // triangle of the hit that did not count, at `from`
};

// Of a node's children.
struct Boxes {
  bool hit0, hit1;
  float in0, in1;  // distance at which the ray enters
};

Boxes boxes_of(Ray r, float t_max, BvhNode n) {
  vec3 a0 = (n.min0 - r.origin) * r.inv, b0 = (n.max0 - r.origin) * r.inv;
  vec3 a1 = (n.min1 - r.origin) * r.inv, b1 = (n.max1 - r.origin) * r.inv;
  vec3 near0 = min(a0, b0), far0 = max(a0, b0), near1 = min(a1, b1), far1 = max(a1, b1);
  float in0 = max(max(near0.x, near0.y), max(near0.z, r.from));
  float in1 = max(max(near1.x, near1.y), max(near1.z, r.from));
  float out0 = min(min(far0.x, far0.y), far0.z) * kSlabTolerance;
  float out1 = min(min(far1.x, far1.y), far1.z) * kSlabTolerance;
  return Boxes(in0 <= min(out0, t_max), in1 <= min(out1, t_max), in0, in1);
}

// Moeller and Trumbore 1997, both sides.
void meet_triangle(Ray r, uint at, GpuTriangle triangle, inout Hit hit, inout uint owner) {
  uint owned = floatBitsToUint(triangle.v0.w);
  vec3 e1 = triangle.e1.xyz, e2 = triangle.e2.xyz, s = r.origin - triangle.v0.xyz;
  vec3 p = cross(r.direction, e2), q = cross(s, e1);
  float det = dot(e1, p);
  float scale = 1.0 / det;
  float u = dot(s, p) * scale, v = dot(r.direction, q) * scale, t = dot(e2, q) * scale;
  bool counts = det != 0.0 && min(u, v) >= -kEdgeTolerance && u + v <= 1.0 + kEdgeTolerance &&
                ((owned >> kTriangleVisibilityShift) & r.mask & kInstanceMaskBits) != 0u;
  if (FEATURE_CANDIDATES) {
    counts = counts && (t > r.from || (t == r.from && r.refused != kNoIndex && at > r.refused)) &&
             (t < hit.t || (t == hit.t && at < hit.triangle && hit.instance != kNoIndex));
  } else {
    counts = counts && t > r.from && t < hit.t;
  }
  hit.t = counts ? t : hit.t;
  hit.bary = counts ? vec2(u, v) : hit.bary;
  hit.instance = counts ? owned >> kTriangleInstanceShift : hit.instance;
  hit.triangle = counts ? at : hit.triangle;
  owner = counts ? owned : owner;
}

// 1 / d, finite where d is zero.
vec3 safe_reciprocal(vec3 d) {
  vec3 tiny = mix(vec3(1e-20), vec3(-1e-20), lessThan(d, vec3(0.0)));
  return 1.0 / mix(d, tiny, lessThan(abs(d), vec3(1e-20)));
}

// Where a traversal stands. References that wait are in a short stack of registers, the newest first: a stack in
// memory, which lanes index apart, was a quarter of the paths' time on lavapipe. What falls out at its end is found
// again from the root by the trail (Laine 2010): a bit for each depth above `depth`, set where nothing waits at that
// node any more.
struct Walk {
  uint current;  // reference
  uint depth;    // of `current`
  uint resumed;  // depth at which the last pop resumed
  uvec2 trail;   // depths 0 to 31 from the highest bit of x on, 32 to 63 in y
  uvec4 newest, oldest;
};

uvec2 depth_bit(uint depth) {
  uint bit = 0x80000000u >> (depth & 31u);
  return depth < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
}

// The subtree at `depth` is done: on to the nearest node above where a child waits.
void pop(inout Walk w) {
  bool root = w.depth == 0u;
  uvec2 bit = depth_bit(w.depth - 1u);
  // Above that bit all is kept, below it nothing; adding the bit carries past nodes where nothing waits.
  uint low = (w.trail.y & (bit.x != 0u ? 0u : ~(bit.y - 1u))) + bit.y;
  uint carry = bit.y != 0u && low == 0u ? 1u : 0u;
  uint kept = bit.x != 0u ? w.trail.x & ~(bit.x - 1u) : w.trail.x;
  uint high = kept + bit.x + carry;
  bool done = root || (high == 0u && low == 0u);
  w.trail = uvec2(high, low);
  w.resumed = low != 0u ? 63u - uint(findLSB(low)) : 31u - uint(findLSB(high));
  uint top = w.newest.x;
  bool again = top == kRefDone;  // it fell out
  w.current = done ? kRefDone : again ? 0u : top;
  w.depth = again ? 0u : w.resumed + 1u;
  w.newest = uvec4(w.newest.yzw, w.oldest.x);
  w.oldest = uvec4(w.oldest.yzw, kRefDone);
}

// Loops test at their end: lavapipe runs the body of a loop that tests at its head once more, with all lanes off.
void nearest_by_trail(Ray r, inout Hit hit, inout uint owner) {
  Walk w = Walk(0u, 0u, kNoIndex, uvec2(0u), uvec4(kRefDone), uvec4(kRefDone));
  do {
    // Down to a leaf.
    if (w.current < kRefLeaf) {
      do {
        BvhNode n = node_at(w.current);
        Boxes b = boxes_of(r, hit.t, n);
        bool both = b.hit0 && b.hit1, any = b.hit0 || b.hit1;
        bool first = b.hit0 && (!b.hit1 || b.in0 <= b.in1);
        uvec2 bit = depth_bit(w.depth);
        bool passed = (w.trail & bit) != uvec2(0u);
        bool one = any && !both && w.depth != w.resumed;
        bool push = both && !passed;
        bool other = both && passed;
        Walk up = w;
        pop(up);
        if (both || one) {
          w.current = first != other ? n.child0 : n.child1;
          w.trail |= one ? bit : uvec2(0u);
          w.depth += 1u;
          w.oldest = push ? uvec4(w.newest.w, w.oldest.xyz) : w.oldest;
          w.newest = push ? uvec4(first ? n.child1 : n.child0, w.newest.xyz) : w.newest;
        } else {
          w = up;
        }
      } while (w.current < kRefLeaf);
    }
    if (w.current != kRefDone) {
      uint at = w.current & kRefFirstMask;
      uint end = at + ((w.current >> kRefCountShift) & kRefCountMask) + 1u;
      do {
        meet_triangle(r, at, triangle_at(at), hit, owner);
      } while (++at < end);
      pop(w);
    }
  } while (w.current != kRefDone);
}

// Where GPU_LANES: the same order with a stack in memory and loads through descriptors or addresses, which there are
// faster than through texels. What is entered behind the nearest hit so far is left on the stack.
struct Stack {
  uint subtree[kTraversalDepth];   // references
  float entered[kTraversalDepth];  // distance at which the ray enters them
  uint top;
};

uint next_of(inout Stack stack, float t_max) {
  while (stack.top > 0u) {
    --stack.top;
    if (stack.entered[stack.top] <= t_max) return stack.subtree[stack.top];
  }
  return kRefDone;
}

void nearest_by_stack(Ray r, inout Hit hit, inout uint owner) {
  uint waiting[kTraversalDepth];   // references
  float entered[kTraversalDepth];  // distance at which the ray enters them
  uint top = 0u, current = 0u;
#define FB_NEXT                                        \
  current = kRefDone;                                  \
  while (top > 0u && current == kRefDone) {            \
    --top;                                             \
    if (entered[top] <= hit.t) current = waiting[top]; \
  }
  do {
    while (current < kRefLeaf) {
      BvhNode n = nodes.at[current];
      Boxes b = boxes_of(r, hit.t, n);
      if (b.hit0 || b.hit1) {
        bool first = b.hit0 && (!b.hit1 || b.in0 <= b.in1);
        current = first ? n.child0 : n.child1;
        if (b.hit0 && b.hit1) {
          waiting[top] = first ? n.child1 : n.child0;
          entered[top++] = first ? b.in1 : b.in0;
        }
      } else {
        FB_NEXT
      }
    }
    if (current != kRefDone) {
      uint at = current & kRefFirstMask;
      uint end = at + ((current >> kRefCountShift) & kRefCountMask) + 1u;
      do {
        meet_triangle(r, at, triangles.at[at], hit, owner);
      } while (++at < end);
      FB_NEXT
    }
  } while (current != kRefDone);
#undef FB_NEXT
}

// Whether a candidate counts is asked of the nearest hit alone, since lavapipe runs that code for every triangle if it
// stands among them. Where it does not count, the ray is traced again for what lies behind: hits are ordered by
// distance, then by triangle, so that surfaces in one place all have their turn.
Hit trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, inout uint rng) {
  Hit hit;
  Ray r = Ray(origin, direction, safe_reciprocal(direction), t_min, mask, kNoIndex);
  bool again = false;
  do {
    hit = Hit(t_max, vec2(0.0), kNoIndex, kNoIndex);
    uint owner = 0u;  // v0.w of the hit's
    if (GPU_LANES)
      nearest_by_stack(r, hit, owner);
    else
      nearest_by_trail(r, hit, owner);
    if (FEATURE_CANDIDATES) {
      again = false;
      uint triangle = hit.triangle;
      if (hit.instance != kNoIndex) hit.triangle -= instance_at(hit.instance).world_triangle;
      if ((owner & kTriangleAsks) != 0u) again = !accept_candidate(hit, rng);
      r.from = again ? hit.t : r.from;
      r.refused = triangle;
    }
  } while (FEATURE_CANDIDATES && again);
  if (!FEATURE_CANDIDATES && hit.instance != kNoIndex) hit.triangle -= instance_at(hit.instance).world_triangle;
  return hit;
}
#endif
