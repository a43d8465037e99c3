#include "ui/demo_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/painter.h"

namespace fb::ui {
namespace {

// Virtual pixels of the status bar's canvas: from its left and its upper edge.
constexpr float kLeft = 8.0f, kWidth = 304.0f, kTop = -36.0f, kHeight = 28.0f;
constexpr float kLineTop = -20.0f, kLineHeight = 6.0f, kHandleWidth = 4.0f;
constexpr float kMargin = 6.0f;  // about the line, of what can be pointed at
const vec4 kBarBack(0.0f, 0.0f, 0.0f, 0.6f), kWhole(0.35f, 0.3f, 0.25f, 1.0f), kPast(0.8f, 0.55f, 0.2f, 1.0f),
    kHandleColor(1.0f, 0.9f, 0.7f, 1.0f);
constexpr float kTextLeft = kLeft + kMargin, kTextRight = kLeft + kWidth - kMargin;
constexpr std::size_t kMostName = 16;

Canvas canvas(const HudSettings& settings, ivec2 output) {
  return status_bar_canvas(output, settings.bar_scale, false);
}

std::string clock(double seconds) {
  const auto whole = static_cast<int>(std::clamp(seconds, 0.0, 1e7));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string speed(double rate) {
  const double size = std::abs(rate);
  const char* const sign = rate < 0.0 ? "-" : "";
  const double inverse = std::round(1.0 / size);
  if (size < 1.0 && std::abs(1.0 / size - inverse) < 1e-6) return fmt::format("{}1/{:.0f}x", sign, inverse);
  return fmt::format("{}{:.3g}x", sign, size);
}

// Two arrows where it is faster than the demo's own speed.
std::string arrows(double rate) {
  const std::string arrow = rate < 0.0 ? "<" : ">";
  return std::abs(rate) > 1.0 ? arrow + arrow : arrow;
}

float fraction(const DemoBar& bar) {
  return bar.length > 0.0 ? static_cast<float>(std::clamp(bar.seconds / bar.length, 0.0, 1.0)) : 0.0f;
}

}  // namespace

void draw_demo_bar(scene::DrawList& list, Atlas& atlas, const HudView& view, const DemoBar& bar) {
  Painter painter(list, atlas, canvas(view.settings, view.output));
  painter.fill(kLeft, kTop, kWidth, kHeight, kBarBack);
  const float text_y = kTop + 4.0f, line = kTextRight - kTextLeft;
  painter.text(kTextLeft, text_y, bar.rate == 0.0 ? "paused" : arrows(bar.rate) + " " + speed(bar.rate), true);
  const std::string name = bar.name.substr(0, kMostName);
  painter.text(kLeft + 0.5f * (kWidth - kGlyph * static_cast<float>(name.size())), text_y, name);
  const std::string time = clock(bar.seconds) + "/" + clock(bar.length);
  painter.text(kTextRight - kGlyph * static_cast<float>(time.size()), text_y, time);
  painter.fill(kTextLeft, kLineTop, line, kLineHeight, kWhole);
  const float past = line * fraction(bar);
  painter.fill(kTextLeft, kLineTop, past, kLineHeight, kPast);
  painter.fill(kTextLeft + past - 0.5f * kHandleWidth, kLineTop - 2.0f, kHandleWidth, kLineHeight + 4.0f, kHandleColor);
}

std::optional<double> demo_time_at(const HudSettings& settings, ivec2 output, double length, const vec2& pointer,
                                   bool held) {
  const Canvas where = canvas(settings, output);
  const vec2 at = (pointer - where.origin) / where.scale;
  const bool on_it = at.x >= kTextLeft - kMargin && at.x <= kTextRight + kMargin && at.y >= kLineTop - kMargin &&
                     at.y <= kLineTop + kLineHeight + kMargin;
  if (!held && !on_it) return std::nullopt;
  return length * static_cast<double>(std::clamp((at.x - kTextLeft) / (kTextRight - kTextLeft), 0.0f, 1.0f));
}

}  // namespace fb::ui
