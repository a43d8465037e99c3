// Presets: values for the settings that a frame's time depends on, and the choice of one by what the device draws in
// two seconds of the first game.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
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
// As the player's choice.
void apply_preset(con::Console& console, const Preset& preset);
// The last one that a device of this speed can draw as it is meant, for a window of this size; the first if none.
// `speed`: pixels of `lavapipe` that it renders in a millisecond.
const Preset& preset_for(double speed, uvec2 window);

// What a device takes for the frames of so many seconds.
class DeviceSpeed {
 public:
  explicit DeviceSpeed(double seconds = 2.0) : seconds_(seconds) {}
  // A frame of `pixels` rendered pixels of this preset took the device `milliseconds`; `now` in seconds. The first
  // frames, which make pipelines and have no past, do not count.
  void add(const Preset& preset, double pixels, double milliseconds, double now);
  // Pixels of `lavapipe` in a millisecond, of the median frame; nothing until it has been measured.
  std::optional<double> measured() const;

 private:
  double seconds_;
  std::size_t frames_ = 0;
  double since_ = 0.0, until_ = 0.0;
  std::vector<double> speeds_;
};

// The program's own choice of a preset: by two seconds of a game, and again when what was measured no longer fits,
// which the frames of two times ten seconds one after the other must say. It ends where the player chooses: r_preset is
// `auto` as long as it lasts, in config.cfg too, so that the next start measures again.
class PresetChooser {
 public:
  explicit PresetChooser(con::Console& console) : console_(console) {}
  // Whether settings that have just been read leave the choice to the program.
  bool asked() const;
  // What is likely to fit is drawn and measured; where the program has chosen before, what it chose.
  void begin(const Preset& likely);
  // A frame of `pixels` rendered pixels took `milliseconds`; `now` in seconds. Says what it has chosen, if it has.
  std::string add(double pixels, double milliseconds, uvec2 window, double now);

 private:
  static constexpr double kWatched = 10.0;  // seconds
  static constexpr double kMargin = 1.3;    // of speed, that another preset fits or this one does not

  std::string choose(const Preset& preset, double speed, bool again);
  const Preset* wished(double speed, uvec2 window) const;

  con::Console& console_;
  const Preset* drawn_ = nullptr;   // null: the player has chosen
  const Preset* wished_ = nullptr;  // by the last measurement, if not what is drawn
  bool chosen_ = false;             // measured, at least once
  DeviceSpeed speed_;
};

// The command `preset` and the cvar r_preset. `measure`: what `preset auto` does.
void register_presets(con::Console& console, std::function<void()> measure);

}  // namespace fb::host
