#include "host/game/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "console/cvar.h"

namespace fb::host {
namespace {

constexpr std::size_t kUncounted = 8;  // frames
constexpr std::size_t kFewest = 5;     // frames, however long they take
constexpr const char *kChosen = "r_preset", *kAutomatic = "auto";

// Costs: measurements.md, "What do the presets cost?"
constexpr std::array kPresets{
    Preset{"potato",
           "one reflection, a small picture, light at a third of it",
           {100, 57600, 1, 1, 1, 0.33f, 0.25f, 0, -1},
           0.69,
           100.0,
           0.0,
           0.0},
    Preset{"lavapipe",
           "two reflections at ten frames a second, for processors without a GPU",
           {100, 129600, 1, 1, 2, 0.5f, 0.5f, 0, -1},
           1.0,
           100.0,
           0.0,
           30000.0},
    Preset{"balanced",
           "as much of the picture as sixty frames a second allow, clear water",
           {16, 0, 1, 1, 2, 0.5f, 0.5f, 1, -1},
           1.03,
           16.0,
           0.25,
           0.0},
    Preset{"beautiful",
           "three reflections, two paths a pixel, light as fine as the picture, thirty frames a second",
           {33, 0, 1, 2, 3, 1, 1, 1, -1},
           6.3,
           33.0,
           0.5,
           0.0},
    Preset{"reference",
           "eight reflections, no denoiser: a view that stands still becomes exact",
           {0, 0, 1, 1, 8, 1, 1, 1, 0},
           7.2,
           0.0,
           0.0,
           0.0},
};

bool has_values(const con::Console& console, const Preset& preset) {
  for (std::size_t i = 0; i < kPresetCvars.size(); ++i)
    if (console.cvar(kPresetCvars[i]).value() != preset.values[i]) return false;
  return true;
}

void set_values(con::Console& console, const Preset& preset) {
  for (std::size_t i = 0; i < kPresetCvars.size(); ++i)
    console.set(kPresetCvars[i], con::number_text(preset.values[i]));
}

std::string list_of_presets(const con::Console& console) {
  const Preset* now = preset_in_force(console);
  std::string text = fmt::format("preset: {}\n", now ? now->name : "none; settings were changed one by one");
  for (const Preset& preset : kPresets) text += fmt::format("  {:<10} {}\n", preset.name, preset.purpose);
  return text + "  auto       measures the device for two seconds of a game, and chooses";
}

}  // namespace

std::span<const Preset> presets() { return kPresets; }

const Preset* find_preset(std::string_view name) {
  const auto found =
      std::ranges::find(kPresets, name, [](const Preset& preset) { return std::string_view(preset.name); });
  return found == kPresets.end() ? nullptr : &*found;
}

const Preset* preset_in_force(const con::Console& console) {
  const auto found = std::ranges::find_if(kPresets, [&](const Preset& preset) { return has_values(console, preset); });
  return found == kPresets.end() ? nullptr : &*found;
}

bool presets_untouched(const con::Console& console) {
  return std::ranges::all_of(kPresetCvars, [&](const char* name) {
    const con::Cvar& cvar = console.cvar(name);
    return cvar.string() == cvar.default_string();
  });
}

void apply_preset(con::Console& console, const Preset& preset) {
  set_values(console, preset);
  console.set(kChosen, preset.name);
}

const Preset& preset_for(double speed, uvec2 window) {
  const double pixels = static_cast<double>(window.x) * static_cast<double>(window.y);
  const Preset* chosen = &kPresets.front();
  for (const Preset& preset : kPresets) {
    if (preset.milliseconds <= 0.0) continue;
    const double least = std::max(preset.least_pixels, preset.least_share * pixels);
    if (least * preset.cost <= speed * preset.milliseconds) chosen = &preset;
  }
  return *chosen;
}

void DeviceSpeed::add(const Preset& preset, double pixels, double milliseconds, double now) {
  if (measured() || milliseconds <= 0.0) return;
  if (frames_++ < kUncounted) {
    since_ = now;
    return;
  }
  until_ = now;
  speeds_.push_back(pixels * preset.cost / milliseconds);
}

std::optional<double> DeviceSpeed::measured() const {
  if (speeds_.size() < kFewest || until_ - since_ < seconds_) return std::nullopt;
  std::vector<double> speeds = speeds_;
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

bool PresetChooser::asked() const {
  const std::string& chosen = console_.cvar(kChosen).string();
  return (chosen.empty() && presets_untouched(console_)) || (chosen == kAutomatic && preset_in_force(console_));
}

void PresetChooser::begin(const Preset& likely) {
  const Preset* former = console_.cvar(kChosen).string() == kAutomatic ? preset_in_force(console_) : nullptr;
  drawn_ = former && former->milliseconds > 0.0 ? former : &likely;
  wished_ = nullptr;
  chosen_ = false;
  set_values(console_, *drawn_);
  console_.set(kChosen, kAutomatic);
  speed_ = DeviceSpeed();
}

std::string PresetChooser::choose(const Preset& preset, double speed, bool again) {
  drawn_ = &preset;
  wished_ = nullptr;
  chosen_ = true;
  set_values(console_, preset);
  return fmt::format("preset {}: {} {:.2g} million pixels a second. Options, Video has others", preset.name,
                     again ? "what was measured no longer fits;" : "measured", 1e-3 * speed);
}

// Another preset, if this one's place is elsewhere by more than a margin.
const Preset* PresetChooser::wished(double speed, uvec2 window) const {
  const Preset &slower = preset_for(speed * kMargin, window), &faster = preset_for(speed / kMargin, window);
  if (&slower < drawn_) return &slower;
  return &faster > drawn_ ? &faster : nullptr;
}

std::string PresetChooser::add(double pixels, double milliseconds, uvec2 window, double now) {
  if (!drawn_) return "";
  if (preset_in_force(console_) != drawn_ || console_.cvar(kChosen).string() != kAutomatic) {
    if (console_.cvar(kChosen).string() == kAutomatic) console_.set(kChosen, "");  // settings were changed one by one
    drawn_ = nullptr;
    return "";
  }
  speed_.add(*drawn_, pixels, milliseconds, now);
  const auto speed = speed_.measured();
  if (!speed) return "";
  speed_ = DeviceSpeed(kWatched);
  if (!chosen_) return choose(preset_for(*speed, window), *speed, false);
  const Preset* wish = wished(*speed, window);
  if (wish && wish == std::exchange(wished_, wish)) return choose(*wish, *speed, true);
  wished_ = wish;
  return "";
}

void register_presets(con::Console& console, std::function<void()> measure) {
  console.add_cvar(
      {kChosen, "",
       "the preset that was chosen last; auto: the program chooses by what it measures, at every start and "
       "again when that no longer fits; empty: likewise, unless its settings were changed",
       con::kCvarArchive});
  console.add_command("preset",
                      "preset [name|auto]: list the presets of the picture, choose one, or measure and choose",
                      [&console, measure = std::move(measure)](const con::Args& args) {
                        if (args.size() < 2) return log_info("{}", list_of_presets(console));
                        if (args[1] == "auto") return measure();
                        const Preset* preset = find_preset(args[1]);
                        if (!preset) return console.fail(fmt::format("preset {}: there is none of this name", args[1]));
                        apply_preset(console, *preset);
                        log_info("preset {}: {}", preset->name, preset->purpose);
                      });
}

}  // namespace fb::host
