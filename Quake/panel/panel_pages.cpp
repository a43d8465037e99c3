// What the panel shows.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "panel/panel.h"
#include "render/passes/debug_views.h"
#include "render/passes/settings.h"

namespace fb::panel {
namespace {

constexpr float kGraphHeight = 90.0f;  // of ImGui's units
constexpr double kMegabyte = 1024.0 * 1024.0;

// A slider over a wide range has more room for small numbers.
ImGuiSliderFlags slider_over(float low, float high) {
  constexpr float kWide = 100.0f;
  const bool wide = low > 0.0f ? high / low > kWide : high - low > kWide;
  return wide ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
}

// Colours of passes, in turns: apart in hue, so that neighbours differ.
ImU32 pass_color(std::size_t pass) {
  constexpr float kGolden = 0.618034f;
  const float hue = std::fmod(0.08f + kGolden * static_cast<float>(pass), 1.0f);
  float r = 0.0f, g = 0.0f, b = 0.0f;
  const bool dark = pass / 6 % 2 != 0;
  ImGui::ColorConvertHSVtoRGB(hue, dark ? 0.8f : 0.55f, dark ? 0.55f : 0.95f, r, g, b);
  return ImGui::ColorConvertFloat4ToU32({r, g, b, 1.0f});
}

void text(const std::string& line) { ImGui::TextUnformatted(line.data(), line.data() + line.size()); }

void help_of(const con::Cvar& cvar) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(260.0f);
  text(cvar.spec().help);
  text(fmt::format("{}; default {}", cvar.range_text(), cvar.default_string()));
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::size_t count_ids(const scene::FrameSnapshot& snapshot, std::uint32_t first, std::uint32_t behind) {
  return static_cast<std::size_t>(
      std::count_if(snapshot.instances.begin(), snapshot.instances.end(),
                    [=](const scene::Instance& i) { return i.id >= first && i.id < behind; }));
}

const char* sky_name(scene::SkyMode mode) {
  switch (mode) {
    case scene::SkyMode::kConstant:
      return "of one colour";
    case scene::SkyMode::kLayers:
      return "two layers of clouds";
    case scene::SkyMode::kBox:
      return "a box of six images";
    default:
      return "black";
  }
}

}  // namespace

void Panel::draw_pages(const Facts& facts) {
  ImGui::SetNextWindowPos({8.0f, 8.0f}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({380.0f, 330.0f}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Renderer", &open_) && ImGui::BeginTabBar("pages")) {
    const auto page = [](const char* name, const auto& draw) {
      if (!ImGui::BeginTabItem(name)) return;
      draw();
      ImGui::EndTabItem();
    };
    page("Times", [&] { draw_times(facts); });
    page("Settings", [&] { draw_settings(); });
    page("Views", [&] { draw_views(); });
    page("Scene", [&] { draw_scene(facts); });
    ImGui::EndTabBar();
  }
  ImGui::End();
}

// A column a frame, its passes one on the other.
void Panel::draw_graph(double highest) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 32.0f);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + kGraphHeight}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  const float column = width / static_cast<float>(kFrames);
  const auto pixel = [this](float x) { return std::round(x * scale_) / scale_; };
  float right = corner.x + width;
  for (auto frame = history_.rbegin(); frame != history_.rend() && highest > 0.0; ++frame) {
    float bottom = corner.y + kGraphHeight;
    for (std::size_t i = 0; i < frame->passes.size(); ++i) {
      const float top = bottom - kGraphHeight * static_cast<float>(frame->passes[i].milliseconds / highest);
      list.AddRectFilled({pixel(right - column), pixel(top)}, {pixel(right), pixel(bottom)}, pass_color(i));
      bottom = top;
    }
    right -= column;
  }
  ImGui::Dummy({width, kGraphHeight});
}

void Panel::draw_times(const Facts& facts) {
  text(fmt::format("{}, rays by {}", facts.device, facts.rays));
  if (history_.empty()) return text("No frame has been shown yet.");
  const auto device_time = [](const Frame& frame) {
    double sum = 0.0;
    for (const render::PassTime& pass : frame.passes) sum += pass.milliseconds;
    return sum;
  };
  double highest = 0.0, whole = 0.0;
  const std::vector<render::PassTime>& latest = history_.back().passes;
  std::vector<double> means(latest.size(), 0.0);
  for (const Frame& frame : history_) {
    highest = std::max(highest, device_time(frame));
    whole += frame.whole;
    for (std::size_t i = 0; i < std::min(means.size(), frame.passes.size()); ++i)
      means[i] += frame.passes[i].milliseconds;
  }
  const auto frames = static_cast<double>(history_.size());
  text(fmt::format("{}x{}, {:.1f} ms a frame, {:.1f} frames a second", facts.rendered.x, facts.rendered.y,
                   whole / frames, whole > 0.0 ? 1e3 * frames / whole : 0.0));
  draw_graph(highest);
  text(fmt::format("the last {} frames; up to {:.1f} ms; means, ms:", history_.size(), highest));
  for (std::size_t i = 0; i < latest.size(); ++i) {
    if (i % 2 != 0) ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetTextLineHeight() - 4.0f;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 2.0f}, {at.x + side, at.y + 2.0f + side}, pass_color(i));
    ImGui::Dummy({side + 4.0f, side});
    ImGui::SameLine();
    text(fmt::format("{:6.2f} {}", means[i] / frames, latest[i].name));
  }
}

void Panel::draw_setting(const con::Cvar& cvar) {
  const con::CvarSpec& spec = cvar.spec();
  const float low = spec.min.value_or(0.0f), high = spec.max.value_or(low);
  const char* const name = cvar.name().c_str();
  const auto set = [&](float value) { console_.set(cvar.name(), con::number_text(value)); };
  ImGui::SetNextItemWidth(0.4f * ImGui::GetContentRegionAvail().x);
  if (!spec.min || !spec.max) {
    std::array<char, 64> typed{};
    cvar.string().copy(typed.data(), typed.size() - 1);
    if (ImGui::InputText(name, typed.data(), typed.size(), ImGuiInputTextFlags_EnterReturnsTrue))
      console_.set(cvar.name(), typed.data());
  } else if (spec.integer && low == 0.0f && high == 1.0f) {
    bool on = cvar.on();
    if (ImGui::Checkbox(name, &on)) set(on ? 1.0f : 0.0f);
  } else if (spec.integer) {
    int value = cvar.integer();
    if (ImGui::SliderInt(name, &value, static_cast<int>(low), static_cast<int>(high), "%d", slider_over(low, high)))
      set(static_cast<float>(value));
  } else {
    float value = cvar.value();
    if (ImGui::SliderFloat(name, &value, low, high, "%.4g", slider_over(low, high))) set(value);
  }
  help_of(cvar);
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) console_.set(cvar.name(), cvar.default_string());
}

void Panel::draw_settings() {
  std::array<char, 64> typed{};
  filter_.copy(typed.data(), typed.size() - 1);
  ImGui::SetNextItemWidth(0.4f * ImGui::GetContentRegionAvail().x);
  if (ImGui::InputText("search", typed.data(), typed.size())) filter_ = typed.data();
  ImGui::TextDisabled("right button: default; Ctrl and left: type");
  const auto wanted = [this](const con::Cvar& cvar) {
    return filter_.empty() || con::name_contains(cvar.name(), filter_) || con::name_contains(cvar.spec().help, filter_);
  };
  std::set<std::string_view> grouped;
  const auto group = [&](std::string_view title, const std::vector<std::string_view>& names) {
    std::vector<const con::Cvar*> shown;
    for (const std::string_view name : names) {
      grouped.insert(name);
      const con::Cvar* const cvar = console_.find_cvar(name);
      if (cvar && cvar->has_effect() && wanted(*cvar)) shown.push_back(cvar);
    }
    if (shown.empty()) return;
    const ImGuiTreeNodeFlags flags = filter_.empty() ? ImGuiTreeNodeFlags_None : ImGuiTreeNodeFlags_DefaultOpen;
    if (!ImGui::CollapsingHeader(std::string(title).c_str(), flags)) return;
    for (const con::Cvar* cvar : shown) draw_setting(*cvar);
  };
  ImGui::BeginChild("settings");
  for (const render::SettingGroup& one : render::setting_groups()) group(one.title, one.cvars);
  std::vector<std::string_view> others;
  for (const con::Cvar* cvar : console_.cvars())
    if (con::name_starts_with(cvar->name(), "r_") && !grouped.contains(cvar->name())) others.push_back(cvar->name());
  group("Others", others);
  ImGui::EndChild();
}

void Panel::draw_views() {
  const auto now = static_cast<std::uint32_t>(std::max(0, console_.cvar("r_debug").integer()));
  for (const render::DebugView& view : render::debug_views()) {
    const std::string label = fmt::format("{}##{}", view.name, view.number);
    if (ImGui::RadioButton(label.c_str(), now == view.number)) console_.set("r_debug", std::string(view.name));
    ImGui::SameLine(140.0f);
    ImGui::TextDisabled("%.*s", static_cast<int>(view.help.size()), view.help.data());
  }
}

void Panel::draw_scene(const Facts& facts) {
  const scene::FrameSnapshot& snapshot = facts.snapshot;
  const render::SceneStatistics& s = facts.scene;
  text(fmt::format("{} triangles, {} meshes, {} instances, {} posed", s.triangles, s.meshes, s.instances,
                   s.posed_instances));
  text(fmt::format("device memory: {:.0f} MiB, of the scene {:.0f}",
                   static_cast<double>(facts.device_bytes) / kMegabyte,
                   static_cast<double>(s.device_bytes) / kMegabyte));
  ImGui::Separator();
  text("Light");
  if (s.lights > 0)
    text(fmt::format("{} triangles glow, power {:.4g}", s.lights, s.light_power));
  else
    text("no list of lights: nothing glows or looks for it");
  text(fmt::format("light entities {}, dynamic lights {}, particles {}",
                   count_ids(snapshot, scene::kIdEntityLight, scene::kIdEntityLight + 0x10000u),
                   count_ids(snapshot, scene::kIdDynamicLight, scene::kIdEntityLight),
                   count_ids(snapshot, scene::kIdParticle, scene::kIdDynamicLight)));
  text(fmt::format("sky: {}, {} suns", sky_name(snapshot.sky.mode), snapshot.sky.suns.size()));
  for (const scene::Sun& sun : snapshot.sky.suns)
    text(fmt::format("  sun from {:.2f} {:.2f} {:.2f}, {:.3g} {:.3g} {:.3g}", sun.direction.x, sun.direction.y,
                     sun.direction.z, sun.irradiance.x, sun.irradiance.y, sun.irradiance.z));
  text(fmt::format("even light: {:.3g} {:.3g} {:.3g}", snapshot.ambient.x, snapshot.ambient.y, snapshot.ambient.z));
  const scene::Medium& fog = snapshot.medium;
  if (fog.scatters())
    text(fmt::format("fog: half of the light left after {:.0f} units{}",
                     fog.square > 0.0f ? std::sqrt(std::log(2.0f) / fog.square) : std::log(2.0f) / fog.extinction,
                     fog.square > 0.0f ? ", by Quake's law" : ""));
  else
    text("no fog");
  ImGui::Separator();
  text("Path guiding");
  if (facts.learnt_bytes > 0)
    text(fmt::format("{:.0f} MiB of states and cache", static_cast<double>(facts.learnt_bytes) / kMegabyte));
  else
    text("the estimator learns nothing");
  text(fmt::format("{} frames in the picture's mean", facts.accumulated));
}

}  // namespace fb::panel
