// Poses and refits: a workgroup makes one posed mesh's copy for this frame. First its triangles, each corner between two
// poses; then, level by level from the leaves up, the boxes of its tree. Without the tree (ray queries build their own),
// the corners are written as a plain list.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SCENE_ACCESS coherent
#define INTERSECTOR_QUERY 0
#include "lib/scene_bindings.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool REFIT = true;
layout(constant_id = 1) const bool WRITE_VERTICES = false;

const float kFlatTriangle = 1e-6;  // as on the host (render/gpu_scene_assets.cpp)

vec3 pose_position(uint job, uint vertex) {
  uint a = poses[pose_jobs[job].pose_a + vertex].x, b = poses[pose_jobs[job].pose_b + vertex].x;
  vec3 from = vec3(a & 0xffu, (a >> 8u) & 0xffu, (a >> 16u) & 0xffu);
  vec3 to = vec3(b & 0xffu, (b >> 8u) & 0xffu, (b >> 16u) & 0xffu);
  return mix(from, to, pose_jobs[job].pose_t) * pose_jobs[job].scale.xyz + pose_jobs[job].origin.xyz;
}

void write_vertex(uint at, vec3 p) {
  posed_vertices[at * 3u] = p.x;
  posed_vertices[at * 3u + 1u] = p.y;
  posed_vertices[at * 3u + 2u] = p.z;
}

void pose_triangle(uint job, uint index) {
  GpuAttribute a = attributes[pose_jobs[job].first_attribute + index];
  vec3 v0 = pose_position(job, a.vertex0), v1 = pose_position(job, a.vertex1), v2 = pose_position(job, a.vertex2);
  vec3 e1 = v1 - v0, e2 = v2 - v0, e3 = v2 - v1;
  float longest = max(max(dot(e1, e1), dot(e2, e2)), dot(e3, e3));
  if (!(length(cross(e1, e2)) > kFlatTriangle * longest)) {
    e1 = e2 = vec3(0.0);
    v1 = v2 = v0;
  }
  uint at = pose_jobs[job].first_triangle + index;
  triangles[at] = GpuTriangle(vec4(v0, uintBitsToFloat(a.flags)), vec4(e1, 0.0), vec4(e2, 0.0));
  if (WRITE_VERTICES) {
    uint first = pose_jobs[job].first_vertex + index * 3u;
    write_vertex(first, v0);
    write_vertex(first + 1u, v1);
    write_vertex(first + 2u, v2);
  }
}

// A child's box; `ref` is relative to the mesh. Padded, since corners are rounded when they are put together.
void child_box(uint job, uint ref, out vec3 low, out vec3 high) {
  if (ref < kRefLeaf) {
    uint at = pose_jobs[job].first_node + ref;
    low = min(nodes[at].min0, nodes[at].min1);
    high = max(nodes[at].max0, nodes[at].max1);
    return;
  }
  uint at = pose_jobs[job].first_triangle + (ref & kRefFirstMask);
  uint count = ((ref >> kRefCountShift) & kRefCountMask) + 1u;
  low = vec3(1e30);
  high = vec3(-1e30);
  for (uint i = at; i < at + count; ++i) {
    vec3 v0 = triangles[i].v0.xyz, v1 = v0 + triangles[i].e1.xyz, v2 = v0 + triangles[i].e2.xyz;
    low = min(low, min(v0, min(v1, v2)));
    high = max(high, max(v0, max(v1, v2)));
  }
  vec3 pad = max(abs(low), abs(high)) * 3e-7;
  low -= pad;
  high += pad;
}

uint placed(uint job, uint ref) {
  return ref < kRefLeaf ? ref + pose_jobs[job].first_node : ref + pose_jobs[job].first_triangle;
}

void refit_node(uint job, uint index) {
  uint child0 = nodes[pose_jobs[job].template_node + index].child0;
  uint child1 = nodes[pose_jobs[job].template_node + index].child1;
  BvhNode node;
  child_box(job, child0, node.min0, node.max0);
  child_box(job, child1, node.min1, node.max1);
  node.child0 = placed(job, child0);
  node.child1 = placed(job, child1);
  node.pad0 = 0u;
  node.pad1 = 0u;
  nodes[pose_jobs[job].first_node + index] = node;
}

void main() {
  uint job = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
  for (uint i = lane; i < pose_jobs[job].triangle_count; i += gl_WorkGroupSize.x) pose_triangle(job, i);
  if (!REFIT) return;
  for (uint level = pose_jobs[job].level_count; level-- > 0u;) {
    memoryBarrierBuffer();
    barrier();
    uint end = pose_jobs[job].level_first[level + 1u];
    for (uint i = pose_jobs[job].level_first[level] + lane; i < end; i += gl_WorkGroupSize.x) refit_node(job, i);
  }
}
