// trace() through our own tree: everything stands in the world's space (passes/pose.comp puts it there), so there is one
// tree, one loop, and a triangle says itself whose it is.
//
// Written for 8-wide SIMD on a CPU (lavapipe): there a word fetched costs more than the arithmetic on it, and a branch more
// than a select. traversal_bench measures it.
#ifndef FB_LIB_TRACE_BVH
#define FB_LIB_TRACE_BVH

// Fetch through texel buffers: nearly twice as fast as storage buffers on lavapipe before Mesa 24, slower after.
layout(constant_id = kSpecReadTexels) const bool READ_TEXELS = false;
// Keep the stack in shared memory (for workgroups of at most 64): faster on lavapipe, costs occupancy on GPUs.
layout(constant_id = kSpecSharedStack) const bool SHARED_STACK = true;

FB_SCENE_ARRAY(kBindNodes, 16, readonly, NodeQuadArray, uvec4, node_quads)
FB_SCENE_ARRAY(kBindTriangles, 16, readonly, TriangleQuadArray, uvec4, triangle_quads)
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsNodes) uniform usamplerBuffer node_texels;
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsTriangles) uniform usamplerBuffer triangle_texels;

const uint kRefDone = 0xffffffffu;       // bottom of the stack
const float kEdgeTolerance = 1e-5;       // of barycentric weights: closes cracks along shared edges
const float kSlabTolerance = 1.0000004;  // 2 gamma(3), Ize 2013

const uint kSharedStackSize = SHARED_STACK ? kTraversalStack * 64u : 1u;
const uint kLocalStackSize = SHARED_STACK ? 1u : kTraversalStack;
shared uint shared_stack[kSharedStackSize];
uint local_stack[kLocalStackSize];

void set_stack(uint at, uint value) {
  if (SHARED_STACK) shared_stack[at * 64u + gl_LocalInvocationIndex] = value;
  else local_stack[at] = value;
}
uint get_stack(uint at) { return SHARED_STACK ? shared_stack[at * 64u + gl_LocalInvocationIndex] : local_stack[at]; }

uvec4 node_quad(uint at) { return READ_TEXELS ? texelFetch(node_texels, int(at)) : node_quads.at[at]; }
uvec4 triangle_quad(uint at) { return READ_TEXELS ? texelFetch(triangle_texels, int(at)) : triangle_quads.at[at]; }

// 1 / d, finite where d is zero.
vec3 safe_reciprocal(vec3 d) {
  vec3 tiny = mix(vec3(1e-20), vec3(-1e-20), lessThan(d, vec3(0.0)));
  return 1.0 / mix(d, tiny, lessThan(abs(d), vec3(1e-20)));
}

// Loops test at their end: lavapipe runs the body of a loop that tests at its head once more, with all lanes off.
//
// Whether a candidate counts is asked of the nearest hit alone, since lavapipe runs that code for every triangle if it stands
// among them. Where it does not count, the ray is traced again for what lies behind: hits are ordered by distance, then by
// triangle, so that surfaces in one place all have their turn.
Hit trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, inout uint rng) {
  Hit hit;
  vec3 inv = safe_reciprocal(direction);
  float from = t_min;
  uint refused = kNoIndex, owner;  // triangle of the hit that did not count, at `from`; v0.w of the hit's
  bool again = false;
  do {
    hit = Hit(t_max, vec2(0.0), kNoIndex, kNoIndex);
    owner = 0u;
    uint current = 0u, top = 1u;
    set_stack(0u, kRefDone);
    do {
      // Down to a leaf.
      if (current < kRefLeaf) {
        do {
          uvec4 q0 = node_quad(current * 4u), q1 = node_quad(current * 4u + 1u);
          uvec4 q2 = node_quad(current * 4u + 2u), q3 = node_quad(current * 4u + 3u);
          vec3 a0 = (uintBitsToFloat(q0.xyz) - origin) * inv, b0 = (uintBitsToFloat(q1.xyz) - origin) * inv;
          vec3 a1 = (uintBitsToFloat(q2.xyz) - origin) * inv, b1 = (uintBitsToFloat(q3.xyz) - origin) * inv;
          vec3 near0 = min(a0, b0), far0 = max(a0, b0), near1 = min(a1, b1), far1 = max(a1, b1);
          float in0 = max(max(near0.x, near0.y), max(near0.z, from));
          float in1 = max(max(near1.x, near1.y), max(near1.z, from));
          float out0 = min(min(far0.x, far0.y), far0.z) * kSlabTolerance;
          float out1 = min(min(far1.x, far1.y), far1.z) * kSlabTolerance;
          bool hit0 = in0 <= min(out0, hit.t), hit1 = in1 <= min(out1, hit.t);
          bool both = hit0 && hit1, any = hit0 || hit1;
          bool first = hit0 && (!hit1 || in0 <= in1);
          uint popped = get_stack(top - 1u);
          set_stack(top, first ? q1.w : q0.w);
          current = any ? (first ? q0.w : q1.w) : popped;
          top = both ? top + 1u : any ? top : top - 1u;
        } while (current < kRefLeaf);
      }
      if (current != kRefDone) {
        uint at = current & kRefFirstMask;
        uint end = at + ((current >> kRefCountShift) & kRefCountMask) + 1u;
        do {
          uvec4 q0 = triangle_quad(at * 3u);
          vec3 e1 = uintBitsToFloat(triangle_quad(at * 3u + 1u).xyz), e2 = uintBitsToFloat(triangle_quad(at * 3u + 2u).xyz);
          // Moeller and Trumbore 1997, both sides.
          vec3 s = origin - uintBitsToFloat(q0.xyz);
          vec3 p = cross(direction, e2), q = cross(s, e1);
          float det = dot(e1, p);
          float scale = 1.0 / det;
          float u = dot(s, p) * scale, v = dot(direction, q) * scale, t = dot(e2, q) * scale;
          bool counts = det != 0.0 && min(u, v) >= -kEdgeTolerance && u + v <= 1.0 + kEdgeTolerance &&
                        ((q0.w >> kTriangleVisibilityShift) & mask & kInstanceMaskBits) != 0u;
          if (FEATURE_CANDIDATES) {
            counts = counts && (t > from || (t == from && refused != kNoIndex && at > refused)) &&
                     (t < hit.t || (t == hit.t && at < hit.triangle && hit.instance != kNoIndex));
          } else {
            counts = counts && t > from && t < hit.t;
          }
          hit.t = counts ? t : hit.t;
          hit.bary = counts ? vec2(u, v) : hit.bary;
          hit.instance = counts ? q0.w >> kTriangleInstanceShift : hit.instance;
          hit.triangle = counts ? at : hit.triangle;
          owner = counts ? q0.w : owner;
        } while (++at < end);
        current = get_stack(--top);
      }
    } while (current != kRefDone);
    if (FEATURE_CANDIDATES) {
      again = false;
      uint triangle = hit.triangle;
      if (hit.instance != kNoIndex) hit.triangle -= instances.at[hit.instance].world_triangle;
      if ((owner & kTriangleAsks) != 0u) again = !accept_candidate(hit, rng);
      from = again ? hit.t : from;
      refused = triangle;
    }
  } while (FEATURE_CANDIDATES && again);
  if (!FEATURE_CANDIDATES && hit.instance != kNoIndex) hit.triangle -= instances.at[hit.instance].world_triangle;
  return hit;
}
#endif
