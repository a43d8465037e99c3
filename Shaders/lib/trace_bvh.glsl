// trace() through our own trees: a tree over instances and a tree a mesh, one loop, one stack. A ray enters an instance by
// taking its space (the direction is not renormalised, so t keeps its meaning) and leaves it when the mark that it pushed
// comes off the stack. Triangles met outside any instance are the world's, whose tree hangs in the instances' tree as it
// is: it is instance 0.
//
// Written for 8-wide SIMD on a CPU (lavapipe): there a word fetched costs more than the arithmetic on it, and a branch more
// than a select. traversal_bench measures it.
#ifndef FB_LIB_TRACE_BVH
#define FB_LIB_TRACE_BVH

// Fetch through texel buffers: nearly twice as fast as storage buffers on lavapipe before Mesa 24, slower after.
layout(constant_id = 10) const bool TRACE_TEXELS = false;
// Keep the stack in shared memory (for workgroups of at most 64): faster on lavapipe, costs occupancy on GPUs.
layout(constant_id = 11) const bool SHARED_STACK = true;

layout(set = 0, binding = 0, std430) readonly buffer NodeQuadBlock { uvec4 node_quads[]; };
layout(set = 0, binding = 1, std430) readonly buffer TriangleQuadBlock { uvec4 triangle_quads[]; };
layout(set = 0, binding = 18) uniform usamplerBuffer node_texels;
layout(set = 0, binding = 19) uniform usamplerBuffer triangle_texels;

const uint kRefDone = 0xffffffffu;       // bottom of the stack
const uint kRefLeave = 0xfffffffeu;      // back to the world's space
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

uvec4 node_quad(uint at) { return TRACE_TEXELS ? texelFetch(node_texels, int(at)) : node_quads[at]; }
uvec4 triangle_quad(uint at) { return TRACE_TEXELS ? texelFetch(triangle_texels, int(at)) : triangle_quads[at]; }

// 1 / d, finite where d is zero.
vec3 safe_reciprocal(vec3 d) {
  vec3 tiny = mix(vec3(1e-20), vec3(-1e-20), lessThan(d, vec3(0.0)));
  return 1.0 / mix(d, tiny, lessThan(abs(d), vec3(1e-20)));
}

Hit trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, inout uint rng) {
  Hit hit = Hit(t_max, vec2(0.0), kNoIndex, 0u);
  vec3 o = origin, d = direction, inv = safe_reciprocal(direction);
  uint instance = 0u, current = 0u, top = 1u;
  set_stack(0u, kRefDone);
  while (current != kRefDone) {
    // Down to a leaf.
    while (current < kRefLeaf) {
      uvec4 q0 = node_quad(current * 4u), q1 = node_quad(current * 4u + 1u);
      uvec4 q2 = node_quad(current * 4u + 2u), q3 = node_quad(current * 4u + 3u);
      vec3 a0 = (uintBitsToFloat(q0.xyz) - o) * inv, b0 = (uintBitsToFloat(q1.xyz) - o) * inv;
      vec3 a1 = (uintBitsToFloat(q2.xyz) - o) * inv, b1 = (uintBitsToFloat(q3.xyz) - o) * inv;
      vec3 near0 = min(a0, b0), far0 = max(a0, b0), near1 = min(a1, b1), far1 = max(a1, b1);
      float in0 = max(max(near0.x, near0.y), max(near0.z, t_min));
      float in1 = max(max(near1.x, near1.y), max(near1.z, t_min));
      float out0 = min(min(far0.x, far0.y), far0.z) * kSlabTolerance;
      float out1 = min(min(far1.x, far1.y), far1.z) * kSlabTolerance;
      bool hit0 = in0 <= min(out0, hit.t), hit1 = in1 <= min(out1, hit.t);
      bool both = hit0 && hit1, any = hit0 || hit1;
      bool first = hit0 && (!hit1 || in0 <= in1);
      uint popped = get_stack(top - 1u);
      set_stack(top, first ? q1.w : q0.w);
      current = any ? (first ? q0.w : q1.w) : popped;
      top = both ? top + 1u : any ? top : top - 1u;
    }
    if (current < kRefLeaf + kRefInstance) {
      uint at = current & kRefFirstMask;
      uint end = at + ((current >> kRefCountShift) & kRefCountMask) + 1u;
      for (; at < end; ++at) {
        uvec4 q0 = triangle_quad(at * 3u);
        vec3 e1 = uintBitsToFloat(triangle_quad(at * 3u + 1u).xyz), e2 = uintBitsToFloat(triangle_quad(at * 3u + 2u).xyz);
        // Moeller and Trumbore 1997, both sides.
        vec3 s = o - uintBitsToFloat(q0.xyz);
        vec3 p = cross(d, e2), q = cross(s, e1);
        float det = dot(e1, p);
        float scale = 1.0 / det;
        float u = dot(s, p) * scale, v = dot(d, q) * scale, t = dot(e2, q) * scale;
        bool counts = det != 0.0 && min(u, v) >= -kEdgeTolerance && u + v <= 1.0 + kEdgeTolerance && t > t_min && t < hit.t;
        if (FEATURE_CANDIDATES && counts) {
          bool ask = (q0.w & kTriangleAlphaTest) != 0u || (instances[instance].flags & kInstanceTranslucent) != 0u;
          if (ask) counts = accept_candidate(Hit(t, vec2(u, v), instance, at - instances[instance].first_triangle), rng);
        }
        hit.t = counts ? t : hit.t;
        hit.bary = counts ? vec2(u, v) : hit.bary;
        hit.instance = counts ? instance : hit.instance;
        hit.triangle = counts ? at : hit.triangle;
      }
      current = get_stack(--top);
    } else if (current != kRefDone) {
      bool leave = current == kRefLeave;
      bool enter = !leave && ((current >> kRefVisibilityShift) & mask) != 0u;
      instance = enter ? current & kRefInstanceMask : 0u;
      o = origin;
      d = direction;
      current = get_stack(--top);
      if (enter) {
        vec4 x = instances[instance].to_object[0], y = instances[instance].to_object[1], z = instances[instance].to_object[2];
        vec3 from = origin - vec3(x.w, y.w, z.w);
        o = vec3(dot(x.xyz, from), dot(y.xyz, from), dot(z.xyz, from));
        d = vec3(dot(x.xyz, direction), dot(y.xyz, direction), dot(z.xyz, direction));
        set_stack(++top, kRefLeave);
        ++top;
        current = instances[instance].root_node;
      }
      inv = safe_reciprocal(d);
    }
  }
  if (hit.instance != kNoIndex) hit.triangle -= instances[hit.instance].first_triangle;
  return hit;
}
#endif
