// For tests: the G-buffer's motion against a computation on the host, point by point: the triangle that holds a visible
// point now says where the point was a frame ago, and the camera of then projects it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "render/picture/frame_constants.h"
#include "render/renderer.h"
#include "scene/shapes.h"

namespace fb::render::test {

inline vec3 project(const CameraFrame& camera, const vec3& p, double width, double height) {
  const vec3 d = p - camera.position;
  const double depth = glm::dot(d, camera.forward);
  const double x = glm::dot(d, camera.right) / glm::dot(camera.right, camera.right) / depth;
  const double y = -glm::dot(d, camera.up) / glm::dot(camera.up, camera.up) / depth;
  return {static_cast<float>((x * 0.5 + 0.5) * width), static_cast<float>((y * 0.5 + 0.5) * height),
          static_cast<float>(depth)};
}

inline vec3 posed_vertex(const scene::Mesh& mesh, std::uint32_t vertex, const scene::PoseBlend& pose) {
  if (!mesh.posed()) return mesh.positions[vertex];
  return glm::mix(scene::vertex_position(mesh, vertex, pose.a), scene::vertex_position(mesh, vertex, pose.b), pose.t);
}

// Where a surface point of an instance was a frame ago: found from the triangle that holds it now.
inline bool position_before(const scene::Mesh& mesh, const scene::Instance& instance, const vec3& world, vec3& before) {
  float best = 0.05f;
  for (const scene::MeshTriangle& t : mesh.triangles) {
    vec3 now[3], then[3];
    for (std::size_t k = 0; k < 3; ++k) {
      now[k] = transform_point(instance.transform, posed_vertex(mesh, t.vertices[k], instance.pose));
      then[k] = transform_point(instance.prev_transform, posed_vertex(mesh, t.vertices[k], instance.prev_pose));
    }
    const vec3 n = glm::cross(now[1] - now[0], now[2] - now[0]);
    const float area2 = glm::dot(n, n);
    if (area2 < 1e-12f) continue;
    const float distance = std::abs(glm::dot(world - now[0], n)) / std::sqrt(area2);
    const float b1 = glm::dot(glm::cross(world - now[0], now[2] - now[0]), n) / area2;
    const float b2 = glm::dot(glm::cross(now[1] - now[0], world - now[0]), n) / area2;
    if (distance < best && b1 > -1e-3f && b2 > -1e-3f && b1 + b2 < 1.001f) {
      best = distance;
      before = then[0] + (then[1] - then[0]) * b1 + (then[2] - then[0]) * b2;
    }
  }
  return best < 0.05f;
}

// Checks all pixels of instances that `wanted` (by id) names, or of all; how many were checked, by id.
template <typename Wanted>
std::map<std::uint32_t, int> check_motion(const scene::FrameSnapshot& snapshot, const Renderer& renderer,
                                          Wanted wanted) {
  const auto width = renderer.render_size().x, height = renderer.render_size().y;
  const auto gbuffer = renderer.read().gbuffer();
  const CameraFrame camera = camera_frame(snapshot.prev_camera, width, height);
  std::map<std::uint32_t, int> checked;
  for (std::size_t i = 0; i < gbuffer.size(); ++i) {
    const shared::GBufferTexel& g = gbuffer[i];
    if (g.position_t.w == 0 || !wanted(g.id)) continue;
    const auto instance = std::find_if(snapshot.instances.begin(), snapshot.instances.end(),
                                       [&](const scene::Instance& x) { return x.id == g.id; });
    if (instance == snapshot.instances.end()) {
      ADD_FAILURE() << "id " << g.id << " is not in the snapshot";
      return checked;
    }
    vec3 before;
    const vec3 position(g.position_t.x, g.position_t.y, g.position_t.z);
    if (!position_before(snapshot.assets->meshes[instance->mesh], *instance, position, before)) continue;
    const vec3 expected = project(camera, before, width, height);
    const float x = static_cast<float>(i % width) + 0.5f + g.motion.x,
                y = static_cast<float>(i / width) + 0.5f + g.motion.y;
    EXPECT_NEAR(x, expected.x, 0.01f) << "id " << g.id;
    EXPECT_NEAR(y, expected.y, 0.01f) << "id " << g.id;
    ++checked[g.id];
  }
  return checked;
}
inline std::map<std::uint32_t, int> check_motion(const scene::FrameSnapshot& snapshot, const Renderer& renderer) {
  return check_motion(snapshot, renderer, [](std::uint32_t) { return true; });
}

}  // namespace fb::render::test
