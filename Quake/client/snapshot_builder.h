// From the session to the FrameSnapshot: instances with stable ids, and where each of them was in the snapshot before.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "client/session/session.h"
#include "client/session/view.h"
#include "scene/authored/authored_map.h"
#include "scene/library/library.h"
#include "scene/snapshot.h"

namespace fb::cl {

struct SnapshotInput {
  const Session& session;
  const View& view;
  scene::ModelLibrary& library;
  const scene::Model* world = nullptr;  // null: no world to show
  std::optional<scene::Camera> camera;  // instead of the player's eyes
  int width = 640, height = 480;        // pixels
  bool active = false;                  // false: nothing but the camera
  scene::Sky sky;
  scene::AuthoredMap* authored = nullptr;  // the map's light as its author saw it, if it is to count
};

class SnapshotBuilder {
 public:
  // The same session.frame again gives the same snapshot again.
  void build(const SnapshotInput& input, scene::FrameSnapshot& snapshot);
  // The next snapshot has nothing before it: a new map, a new demo.
  void forget();

 private:
  struct Past {
    std::uint32_t key = 0;  // what it was: another mesh, another light under the same id has no past here
    scene::PoseBlend pose;
    mat4x3 transform{1.0f};
  };
  using History = std::unordered_map<std::uint32_t, Past>;

  // Appends the instance with its past. `cut`: it jumped.
  void add(scene::FrameSnapshot& snapshot, scene::Instance instance, std::uint32_t key, bool cut);
  void add_entity(const SnapshotInput& input, scene::FrameSnapshot& snapshot, const Entity& entity,
                  const scene::Model& model, std::uint32_t id, int number, std::uint32_t visibility);
  void add_alias(const SnapshotInput& input, scene::FrameSnapshot& snapshot, scene::Instance instance,
                 const Entity& entity, const scene::Model& model, int number);
  void add_sprite(const SnapshotInput& input, scene::FrameSnapshot& snapshot, scene::Instance instance,
                  const Entity& entity, const scene::Model& model);
  void add_weapon(const SnapshotInput& input, scene::FrameSnapshot& snapshot);
  void add_beams(const SnapshotInput& input, scene::FrameSnapshot& snapshot);
  void add_particles(const SnapshotInput& input, scene::FrameSnapshot& snapshot);
  void add_lights(const SnapshotInput& input, scene::FrameSnapshot& snapshot);

  History previous_, current_;
  scene::Camera camera_, prev_camera_;
  bool in_liquid_ = false, prev_in_liquid_ = false;
  double time_ = 0.0, prev_time_ = 0.0;
  std::uint64_t built_ = 0, built_before_ = 0;  // session.frame of the last two snapshots
  std::uint64_t count_ = 0;                     // snapshots ever
  bool cut_ = true, forget_ = true;
};

// The transform of a sprite's quad (columns: towards the viewer, the viewer's right, up, origin).
mat4x3 sprite_transform(formats::SpriteOrientation orientation, const vec3& origin, const vec3& angles, float scale,
                        const scene::Camera& camera);

}  // namespace fb::cl
