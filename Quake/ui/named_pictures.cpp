#include "ui/named_pictures.h"

#include <fmt/format.h>

#include <algorithm>

namespace fb::ui {
namespace {

constexpr float kDigit = 24.0f;
constexpr int kMostSmall = 999;

}  // namespace

void draw_named(Painter& painter, float x, float y, const std::string& name, const vec4& color) {
  if (name.empty()) return;
  if (const Picture* picture = painter.atlas().picture(name)) painter.picture(x, y, *picture, color);
}

void draw_number(Painter& painter, float x, float y, int number, int digits, bool red) {
  std::string text = fmt::format("{}", number);
  const auto places = static_cast<std::size_t>(digits);
  if (text.size() > places) text.erase(0, text.size() - places);
  x += kDigit * static_cast<float>(places - text.size());
  for (const char c : text) {
    const std::string digit = c == '-' ? "minus" : std::string(1, c);
    draw_named(painter, x, y, (red ? "anum_" : "num_") + digit);
    x += kDigit;
  }
}

void draw_small_number(Painter& painter, float x, float y, int number) {
  const std::string text = fmt::format("{:3}", std::clamp(number, 0, kMostSmall));
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ') continue;
    painter.character(x + kGlyph * static_cast<float>(i), y, static_cast<unsigned char>(kSmallZero + text[i] - '0'));
  }
}

}  // namespace fb::ui
