// The scenes made in code, by name.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <functional>
#include <optional>

#include "base/number.h"
#include "lab/frame_source.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_in_motion.h"
#include "scene/in_code/scenes_of_fog.h"
#include "scene/in_code/scenes_of_glass.h"
#include "scene/in_code/scenes_of_light.h"
#include "scene/in_code/scenes_of_rooms.h"
#include "scene/in_code/scenes_of_scale.h"
#include "scene/in_code/scenes_of_water.h"

namespace fb::lab {
namespace {

// Frame `frame` of a film at so many frames a second.
using Film = std::function<scene::FrameSnapshot(std::uint64_t frame, double frames_per_second)>;

struct Entry {
  std::string_view name;
  std::function<Film()> open;  // makes the assets that the film's frames share
};

Film still_film(scene::FrameSnapshot snapshot) {
  return [snapshot = std::move(snapshot)](std::uint64_t frame, double) {
    scene::FrameSnapshot now = snapshot;
    now.frame = frame;
    return now;
  };
}

// A film that is a function of this frame's time and the former's; frame 0 stands still.
template <typename MakeFrame>
Film timed_film(std::shared_ptr<const scene::Assets> assets, MakeFrame make) {
  return [assets = std::move(assets), make](std::uint64_t frame, double frames_per_second) {
    const double step = 1.0 / frames_per_second;
    scene::FrameSnapshot now =
        make(assets, static_cast<double>(frame) * step, static_cast<double>(frame == 0 ? 0 : frame - 1) * step);
    now.frame = frame;
    return now;
  };
}

template <typename MakeFrame>
Film counted_film(std::shared_ptr<const scene::Assets> assets, MakeFrame make) {
  return [assets = std::move(assets), make](std::uint64_t frame, double fps) { return make(assets, frame, fps); };
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> table{
      {"furnace", [] { return still_film(scene::furnace(0.5f, 1.0f)); }},
      {"furnace_objects", [] { return still_film(scene::furnace(0.5f, 1.0f, true)); }},
      {"cbox", [] { return still_film(scene::cornell_box()); }},
      {"cbox_glossy", [] { return still_film(scene::cornell_box(scene::CornellVariant::kGlossy)); }},
      {"one_light", [] { return still_film(scene::one_light(8.0f, 300.0f, 0.5f)); }},
      {"many", [] { return still_film(scene::many_lights(400)); }},
      {"candles", [] { return still_film(scene::candles(scene::candle_assets(), 0.0, 0.0)); }},
      {"candles_flicker", [] { return timed_film(scene::candle_assets(), scene::candles); }},
      {"strips", [] { return still_film(scene::strips()); }},
      {"lava", [] { return still_film(scene::lava_cave()); }},
      {"slab", [] { return still_film(scene::slab(0.004f, 0.4f)); }},
      {"window", [] { return still_film(scene::window()); }},
      {"ripple", [] { return still_film(scene::ripple()); }},
      {"ripple_soft",
       [] {
         return still_film(scene::ripple({12.0f, true, false}));
       }},
      {"ripple_above",
       [] {
         return still_film(scene::ripple({12.0f, true, true}));
       }},
      {"ripple_murky",
       [] {
         return still_film(scene::ripple({12.0f, true, false, 0.004f}));
       }},
      {"ripple_murky_above",
       [] {
         return still_film(scene::ripple({12.0f, true, true, 0.004f}));
       }},
      {"lava_bath", [] { return still_film(scene::lava_bath()); }},
      {"torus", [] { return still_film(scene::torus()); }},
      {"torus_soft", [] { return still_film(scene::torus(40.0f)); }},
      {"kinds", [] { return still_film(scene::light_of_every_kind()); }},
      {"moving", [] { return timed_film(scene::moving_assets(), scene::moving); }},
      {"rocket", [] { return counted_film(scene::rocket_assets(), scene::rocket); }},
      {"lightsout", [] { return counted_film(scene::lights_out_assets(), scene::lights_out); }},
      {"three_lamps", [] { return still_film(scene::three_lamps()); }},
      {"thin_wall", [] { return still_film(scene::thin_wall()); }},
      {"thin_wall_dark", [] { return still_film(scene::thin_wall(false)); }},
      {"split_room", [] { return still_film(scene::split_room()); }},
      {"red_ball", [] { return still_film(scene::red_ball()); }},
      {"occluder", [] { return timed_film(scene::occluder_assets(), scene::occluder); }},
      {"alpha_panel", [] { return still_film(scene::alpha_panel()); }},
      {"textured_quad", [] { return still_film(scene::textured_quad()); }},
  };
  return table;
}

// Scenes of as many things as their name says: "many:1000".
struct CountedEntry {
  std::string_view name;
  std::uint64_t least, most;
  Film (*open)(std::uint32_t count);
};
constexpr std::array kCounted{
    CountedEntry{"many", 1, 100000, [](std::uint32_t count) { return still_film(scene::many_lights(count)); }},
    CountedEntry{"triangles", 100, 4000000,
                 [](std::uint32_t count) { return still_film(scene::many_triangles(count)); }},
    CountedEntry{"movers", 1, 20000,
                 [](std::uint32_t count) {
                   return timed_film(scene::many_movers_assets(),
                                     [count](const auto& assets, double now, double before) {
                                       return scene::many_movers(assets, count, now, before);
                                     });
                 }},
};

Result<std::optional<Film>> counted_scene(std::string_view name) {
  const std::size_t colon = name.find(':');
  for (const CountedEntry& entry : kCounted) {
    if (colon == name.npos || entry.name != name.substr(0, colon)) continue;
    const auto count = parse_whole_number_unsigned(name.substr(colon + 1));
    if (!count || *count < entry.least || *count > entry.most)
      return Error{
          fmt::format("--scene {}: {}:N is wanted, N from {} to {}", name, entry.name, entry.least, entry.most)};
    return std::optional(entry.open(static_cast<std::uint32_t>(*count)));
  }
  return std::optional<Film>();
}

class CodeScene : public FrameSource {
 public:
  CodeScene(Film film, double frames_per_second) : film_(std::move(film)), frames_per_second_(frames_per_second) {}
  Result<bool> next(scene::FrameSnapshot& snapshot) override {
    snapshot = film_(frame_++, frames_per_second_);
    return true;
  }

 private:
  Film film_;
  double frames_per_second_;
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
    return std::unique_ptr<FrameSource>(std::make_unique<CodeScene>(entry.open(), frames_per_second));
  }
  auto counted = counted_scene(name);
  if (!counted) return counted.error();
  if (*counted)
    return std::unique_ptr<FrameSource>(std::make_unique<CodeScene>(*std::move(*counted), frames_per_second));
  return Error{fmt::format("--scene {}: there is no such scene; there are {}, and many:N, triangles:N, movers:N", name,
                           fmt::join(code_scene_names(), ", "))};
}

}  // namespace fb::lab
