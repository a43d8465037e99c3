// The scenes made in code, by name.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <functional>

#include "lab/frame_source.h"
#include "scene/scenes_in_code.h"

namespace fb::lab {
namespace {

struct Entry {
  std::string_view name;
  std::function<scene::FrameSnapshot()> make;
};

const std::array<Entry, 9>& entries() {
  static const std::array<Entry, 9> table{{
      {"furnace", [] { return scene::furnace(0.5f, 1.0f); }},
      {"furnace_objects", [] { return scene::furnace(0.5f, 1.0f, true); }},
      {"cbox", [] { return scene::cornell_box(); }},
      {"cbox_glossy", [] { return scene::cornell_box(scene::CornellVariant::kGlossy); }},
      {"one_light", [] { return scene::one_light(8.0f, 300.0f, 0.5f); }},
      {"many", [] { return scene::many_lights(400); }},
      {"alpha_panel", [] { return scene::alpha_panel(); }},
      {"textured_quad", [] { return scene::textured_quad(); }},
      {"moving", nullptr},
  }};
  return table;
}

class StillScene : public FrameSource {
 public:
  explicit StillScene(scene::FrameSnapshot snapshot) : snapshot_(std::move(snapshot)) {}
  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    snapshot = snapshot_;
    snapshot.frame = frame_++;
    return true;
  }

 private:
  scene::FrameSnapshot snapshot_;
  std::uint64_t frame_ = 0;
};

class MovingScene : public FrameSource {
 public:
  explicit MovingScene(double fps) : step_(1.0 / fps), assets_(scene::moving_assets()) {}
  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    snapshot = scene::moving(assets_, static_cast<double>(frame_) * step_,
                             frame_ == 0 ? 0.0 : static_cast<double>(frame_ - 1) * step_);
    snapshot.frame = frame_++;
    return true;
  }

 private:
  double step_;
  std::shared_ptr<const scene::Assets> assets_;
  std::uint64_t frame_ = 0;
};

}  // namespace

std::vector<std::string> code_scene_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.emplace_back(entry.name);
  return names;
}

Result<std::unique_ptr<FrameSource>> code_scene(std::string_view name, double frames_per_second) {
  for (const Entry& entry : entries()) {
    if (entry.name != name) continue;
    if (!entry.make) return std::unique_ptr<FrameSource>(std::make_unique<MovingScene>(frames_per_second));
    return std::unique_ptr<FrameSource>(std::make_unique<StillScene>(entry.make()));
  }
  return Error{
      fmt::format("--scene {}: there is no such scene; there are {}", name, fmt::join(code_scene_names(), ", "))};
}

}  // namespace fb::lab
