// Presets: values for the settings that a frame's time depends on, and the choice of one by what the device draws in
// two seconds of the first game.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/maths.h"
#include "console/console.h"

namespace fb::host {

constexpr std::array kPresetCvars{"r_target_ms",   "r_cpu_pixels", "r_scale", "r_spp",    "r_bounces",
                                  "r_light_scale", "r_fog_scale",  "r_water", "r_denoise"};

struct Preset {
  const char* name;
  const char* purpose;
  std::array<float, kPresetCvars.size()> values;
  // What the choice goes by. `cost`: of a rendered pixel, relative to one of `lavapipe`, as lavapipe takes it. In
  // `milliseconds` at least `least_share` of the window's pixels and `least_pixels` must be rendered. Milliseconds of
  // 0: it is never chosen.
  double cost, milliseconds, least_share, least_pixels;
};
// From the fastest to the most accurate.
std::span<const Preset> presets();
const Preset* find_preset(std::string_view name);
// The one whose values the cvars have; null where they have those of none.
const Preset* preset_in_force(const con::Console& console);
// Whether every one of their cvars has its default: nobody has chosen anything.
bool presets_untouched(const con::Console& console);
void apply_preset(con::Console& console, const Preset& preset);
// The last one that a device of this speed can draw as it is meant, for a window of this size; the first if none.
// `speed`: pixels of `lavapipe` that it renders in a millisecond.
const Preset& preset_for(double speed, uvec2 window);

// What a device takes for the frames of two seconds.
class DeviceSpeed {
 public:
  // A frame of `pixels` rendered pixels of this preset took the device `milliseconds`; `now` in seconds. The first
  // frames, which make pipelines and have no past, do not count.
  void add(const Preset& preset, double pixels, double milliseconds, double now);
  // Pixels of `lavapipe` in a millisecond, of the median frame; nothing until it has been measured.
  std::optional<double> measured() const;

 private:
  std::size_t frames_ = 0;
  double since_ = 0.0, until_ = 0.0;
  std::vector<double> speeds_;
};

// The command `preset` and the cvar r_preset. `measure`: what `preset auto` does.
void register_presets(con::Console& console, std::function<void()> measure);

}  // namespace fb::host
