// Makes this frame's copies of meshes, a workgroup each: first triangles (posed: each corner between two poses), in the
// mesh's space and in the world's; then, level by level from the leaves up, the boxes of the copy's tree. For ray
// queries, which build and transform for themselves, posed corners in the mesh's space are all.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SCENE_ACCESS coherent
#include "lib/scene_bindings.glsl"
#include "shared/packing.h"

FB_POSE_ARRAY(kBindLevels, 4, readonly, LevelArray, uint, levels)
FB_POSE_ARRAY(kBindCopyJobs, 16, readonly, CopyJobArray, GpuCopyJob, copy_jobs)
FB_POSE_ARRAY(kBindVertices, 4, coherent, VertexArray, float, posed_vertices)

layout(local_size_x = 64) in;
layout(constant_id = kSpecForQuery) const bool FOR_QUERY = false;

const float kFlatTriangle = 1e-6;  // as on the host (render/scene/gpu_scene_assets.cpp)

vec3 pose_position(uint job, uint vertex) {
  vec3 from = unpack_pose_position(poses.at[copy_jobs.at[job].pose_a + vertex].x);
  vec3 to = unpack_pose_position(poses.at[copy_jobs.at[job].pose_b + vertex].x);
  return mix(from, to, copy_jobs.at[job].pose_t) * copy_jobs.at[job].scale.xyz + copy_jobs.at[job].origin.xyz;
}

void write_vertex(uint at, vec3 p) {
  posed_vertices.at[at * 3u] = p.x;
  posed_vertices.at[at * 3u + 1u] = p.y;
  posed_vertices.at[at * 3u + 2u] = p.z;
}

// The triangle in the mesh's space.
GpuTriangle object_triangle(uint job, uint index) {
  uint at = copy_jobs.at[job].object_triangle + index;
  if (copy_jobs.at[job].pose_a == kNoIndex) return triangles.at[at];
  GpuAttribute a = attributes.at[copy_jobs.at[job].first_attribute + index];
  vec3 v0 = pose_position(job, a.vertex0), v1 = pose_position(job, a.vertex1), v2 = pose_position(job, a.vertex2);
  vec3 e1 = v1 - v0, e2 = v2 - v0, e3 = v2 - v1;
  float longest = max(max(dot(e1, e1), dot(e2, e2)), dot(e3, e3));
  if (!(length(cross(e1, e2)) > kFlatTriangle * longest)) {
    e1 = e2 = vec3(0.0);
    v1 = v2 = v0;
  }
  GpuTriangle t = GpuTriangle(vec4(v0, 0.0), vec4(e1, 0.0), vec4(e2, 0.0));
  triangles.at[at] = t;
  if (FOR_QUERY) {
    uint first = copy_jobs.at[job].first_vertex + index * 3u;
    write_vertex(first, v0);
    write_vertex(first + 1u, v1);
    write_vertex(first + 2u, v2);
  }
  return t;
}

vec3 world_vector(uint job, vec3 v) {
  return vec3(dot(copy_jobs.at[job].to_world[0].xyz, v), dot(copy_jobs.at[job].to_world[1].xyz, v),
              dot(copy_jobs.at[job].to_world[2].xyz, v));
}

void make_triangle(uint job, uint index) {
  GpuTriangle t = object_triangle(job, index);
  if (FOR_QUERY) return;
  vec3 origin = vec3(copy_jobs.at[job].to_world[0].w, copy_jobs.at[job].to_world[1].w, copy_jobs.at[job].to_world[2].w);
  // Corners first: neighbours must come to share them to the last bit.
  vec3 v0 = world_vector(job, t.v0.xyz) + origin;
  vec3 v1 = world_vector(job, t.v0.xyz + t.e1.xyz) + origin, v2 = world_vector(job, t.v0.xyz + t.e2.xyz) + origin;
  if (t.e1.xyz == vec3(0.0) && t.e2.xyz == vec3(0.0)) v1 = v2 = v0;
  bool asks = (attributes.at[copy_jobs.at[job].first_attribute + index].flags & kTriangleAlphaTest) != 0u;
  uint owner = copy_jobs.at[job].owner | (asks ? kTriangleAsks : 0u);
  triangles.at[copy_jobs.at[job].world_triangle + index] =
      GpuTriangle(vec4(v0, uintBitsToFloat(owner)), vec4(v1 - v0, 0.0), vec4(v2 - v0, 0.0));
}

// References of the mesh's tree, as the copy's tree has them.
uint placed(uint job, uint ref) {
  return ref < kRefLeaf ? ref - copy_jobs.at[job].mesh_node + copy_jobs.at[job].first_node
                        : ref - copy_jobs.at[job].mesh_triangle + copy_jobs.at[job].world_triangle;
}

// A child's box. Padded at the leaves, since corners are rounded when they are put together.
void child_box(uint ref, out vec3 low, out vec3 high) {
  if (ref < kRefLeaf) {
    low = min(nodes.at[ref].min0, nodes.at[ref].min1);
    high = max(nodes.at[ref].max0, nodes.at[ref].max1);
    return;
  }
  uint at = ref & kRefFirstMask;
  uint count = ((ref >> kRefCountShift) & kRefCountMask) + 1u;
  low = vec3(1e30);
  high = vec3(-1e30);
  for (uint i = at; i < at + count; ++i) {
    vec3 v0 = triangles.at[i].v0.xyz, v1 = v0 + triangles.at[i].e1.xyz, v2 = v0 + triangles.at[i].e2.xyz;
    low = min(low, min(v0, min(v1, v2)));
    high = max(high, max(v0, max(v1, v2)));
  }
  vec3 pad = max(abs(low), abs(high)) * 3e-7;
  low -= pad;
  high += pad;
}

void refit_node(uint job, uint index) {
  uint from = copy_jobs.at[job].mesh_node + index;
  BvhNode node;
  node.child0 = placed(job, nodes.at[from].child0);
  node.child1 = placed(job, nodes.at[from].child1);
  node.pad0 = 0u;
  node.pad1 = 0u;
  child_box(node.child0, node.min0, node.max0);
  child_box(node.child1, node.min1, node.max1);
  nodes.at[copy_jobs.at[job].first_node + index] = node;
}

void main() {
  uint job = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
  for (uint i = lane; i < copy_jobs.at[job].triangle_count; i += gl_WorkGroupSize.x) make_triangle(job, i);
  if (FOR_QUERY) return;
  uint entry = copy_jobs.at[job].first_level_entry;
  for (uint level = copy_jobs.at[job].level_count; level-- > 0u;) {
    memoryBarrierBuffer();
    barrier();
    uint end = copy_jobs.at[job].level_first[level + 1u];
    for (uint i = copy_jobs.at[job].level_first[level] + lane; i < end; i += gl_WorkGroupSize.x)
      refit_node(job, levels.at[entry + i]);
  }
}
