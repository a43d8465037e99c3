// trace() through our own trees: a tree over instances and a tree a mesh, one loop, one stack. A ray enters an instance by
// taking its space (the direction is not renormalised, so t keeps its meaning) and leaves it when the mark that it pushed
// comes off the stack. Triangles met outside any instance are the world's, whose tree hangs in the instances' tree as it
// is: it is instance 0.
#ifndef FB_LIB_TRACE_BVH
#define FB_LIB_TRACE_BVH

const uint kRefDone = 0xffffffffu;   // bottom of the stack
const uint kRefLeave = 0xfffffffeu;  // back to the world's space
const float kEdgeTolerance = 1e-5;   // of barycentric weights: closes cracks along shared edges
const float kSlabTolerance = 1.0000004;  // 2 gamma(3), Ize 2013

// 1 / d, finite where d is zero.
vec3 safe_reciprocal(vec3 d) {
  vec3 tiny = vec3(d.x < 0.0 ? -1e-20 : 1e-20, d.y < 0.0 ? -1e-20 : 1e-20, d.z < 0.0 ? -1e-20 : 1e-20);
  return 1.0 / mix(d, tiny, lessThan(abs(d), vec3(1e-20)));
}

Hit trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, inout uint rng) {
  Hit hit = Hit(t_max, vec2(0.0), kNoIndex, 0u);
  vec3 o = origin, d = direction, inv = safe_reciprocal(direction);
  uint instance = 0u;
  uint stack[kTraversalStack];
  stack[0] = kRefDone;
  uint top = 1u;
  uint current = 0u;
  while (current != kRefDone) {
    while (current < kRefLeaf) {
      BvhNode node = nodes[current];
      vec3 a0 = (node.min0 - o) * inv, b0 = (node.max0 - o) * inv;
      vec3 a1 = (node.min1 - o) * inv, b1 = (node.max1 - o) * inv;
      vec3 near0 = min(a0, b0), far0 = max(a0, b0), near1 = min(a1, b1), far1 = max(a1, b1);
      float in0 = max(max(near0.x, near0.y), max(near0.z, t_min));
      float in1 = max(max(near1.x, near1.y), max(near1.z, t_min));
      float out0 = min(min(far0.x, far0.y), far0.z) * kSlabTolerance;
      float out1 = min(min(far1.x, far1.y), far1.z) * kSlabTolerance;
      bool hit0 = in0 <= min(out0, hit.t), hit1 = in1 <= min(out1, hit.t);
      bool first = hit0 && (!hit1 || in0 <= in1);
      if (hit0 && hit1) stack[top++] = first ? node.child1 : node.child0;
      current = first ? node.child0 : node.child1;
      if (!hit0 && !hit1) current = stack[--top];
    }
    if (current < kRefLeaf + kRefInstance) {
      uint at = current & kRefFirstMask;
      uint end = at + ((current >> kRefCountShift) & kRefCountMask) + 1u;
      for (; at < end; ++at) {
        vec3 e1 = triangles[at].e1.xyz, e2 = triangles[at].e2.xyz;
        vec3 s = o - triangles[at].v0.xyz;
        vec3 p = cross(d, e2), q = cross(s, e1);
        float det = dot(e1, p);
        float scale = 1.0 / det;
        float u = dot(s, p) * scale, v = dot(d, q) * scale, t = dot(e2, q) * scale;
        bool inside = det != 0.0 && min(u, v) >= -kEdgeTolerance && u + v <= 1.0 + kEdgeTolerance && t > t_min && t < hit.t;
        if (inside) {
          Hit candidate = Hit(t, vec2(u, v), instance, at - instances[instance].first_triangle);
          if (FEATURE_CANDIDATES) {
            bool ask = (floatBitsToUint(triangles[at].v0.w) & kTriangleAlphaTest) != 0u ||
                       (instances[instance].flags & kInstanceTranslucent) != 0u;
            if (ask) inside = accept_candidate(candidate, rng);
          }
          if (inside) hit = candidate;
        }
      }
      current = stack[--top];
    } else if (current == kRefLeave) {
      o = origin;
      d = direction;
      inv = safe_reciprocal(d);
      instance = 0u;
      current = stack[--top];
    } else if (current != kRefDone) {
      if (((current >> kRefVisibilityShift) & mask) == 0u) {
        current = stack[--top];
      } else {
        instance = current & kRefInstanceMask;
        vec4 x = instances[instance].to_object[0], y = instances[instance].to_object[1], z = instances[instance].to_object[2];
        o = vec3(dot(x.xyz, origin) + x.w, dot(y.xyz, origin) + y.w, dot(z.xyz, origin) + z.w);
        d = vec3(dot(x.xyz, direction), dot(y.xyz, direction), dot(z.xyz, direction));
        inv = safe_reciprocal(d);
        current = instances[instance].root_node;
        stack[top++] = kRefLeave;
      }
    }
  }
  return hit;
}
#endif
