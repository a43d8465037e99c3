#include "ui/overlays.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "ui/wrap.h"

namespace fb::ui {
namespace {

constexpr float kLine = 8.0f;
constexpr std::size_t kCenterColumns = 40;

}  // namespace

void draw_notify(Painter& painter, const std::vector<con::ScrollLine>& lines) {
  float y = 0.0f;
  const auto columns = static_cast<std::size_t>(std::max(painter.width() / 8 - 2, 1));
  for (const con::ScrollLine& line : lines) {
    for (const std::string_view piece : wrap(line.text, columns)) {
      painter.text(kLine, y, piece);
      y += kLine;
    }
  }
}

void draw_fps(Painter& painter, float right, float y, double frames_per_second) {
  if (!(frames_per_second > 0.0)) return;
  // Low frame rates are shown with a decimal.
  const std::string text = frames_per_second < 10.0 ? fmt::format("{:.1f} fps", frames_per_second)
                                                    : fmt::format("{:.0f} fps", frames_per_second);
  painter.text(right - kLine * static_cast<float>(text.size()), y, text);
}

void draw_center_print(Painter& painter, std::string_view text, std::size_t characters, float raised) {
  if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  const auto fitting = static_cast<std::size_t>(std::max(painter.width() / 8, 1));
  const auto lines = wrap(text, std::min(kCenterColumns, fitting));
  float y = lines.size() <= 4 ? static_cast<float>(painter.height()) * 0.35f : 48.0f;
  y = static_cast<float>(static_cast<int>(y)) - raised;
  for (const std::string_view line : lines) {
    const float x = static_cast<float>((painter.width() - 8 * static_cast<int>(line.size())) / 2);
    painter.text(x, y, line.substr(0, characters));
    if (characters <= line.size()) return;
    characters -= line.size();
    y += kLine;
  }
}

void FrameRate::frame(double now) {
  if (start_ < 0.0 || now < start_) {
    start_ = now;
    frames_ = 0;
    return;
  }
  ++frames_;
  if (now - start_ < 0.5) return;
  value_ = frames_ / (now - start_);
  start_ = now;
  frames_ = 0;
}

}  // namespace fb::ui
