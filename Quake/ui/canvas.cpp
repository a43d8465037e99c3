#include "ui/canvas.h"

#include <algorithm>
#include <cmath>

namespace fb::ui {
namespace {

constexpr int kMenuWidth = 320, kMenuHeight = 200, kBarHeight = 48;
constexpr float kMostCrosshair = 10.0f;

// At least 1, and at most `most` unless that is less. What is no number is 1.
float bounded(float scale, float most) { return std::max(1.0f, std::min(scale, most)); }

vec2 floored(float x, float y) { return {std::floor(x), std::floor(y)}; }

}  // namespace

int automatic_scale(int output_width, int output_height) {
  return std::max(1, std::min(output_width / 640, output_height / 360));
}

Canvas screen_canvas(ivec2 output, float scale) {
  scale = std::max(scale, 1.0f);
  const vec2 size = vec2(output) / scale;
  return {vec2(0.0f), scale, static_cast<int>(size.x), static_cast<int>(size.y)};
}

Canvas status_bar_canvas(ivec2 output, float scale, bool left) {
  const vec2 size(output);
  scale = bounded(scale, size.x / kMenuWidth);
  const float x = left ? 0.0f : (size.x - kMenuWidth * scale) / 2.0f;
  return {floored(x, size.y - kBarHeight * scale), scale, kMenuWidth, kBarHeight};
}

Canvas menu_canvas(ivec2 output, float scale) {
  const vec2 size(output);
  scale = bounded(scale, std::min(size.x / kMenuWidth, size.y / kMenuHeight));
  return {floored((size.x - kMenuWidth * scale) / 2.0f, (size.y - kMenuHeight * scale) / 2.0f), scale, kMenuWidth,
          kMenuHeight};
}

Canvas corner_canvas(ivec2 output, float scale, bool right, bool bottom) {
  const vec2 size(output);
  scale = std::max(scale, 1.0f);
  return {vec2(right ? size.x - kMenuWidth * scale : 0.0f, bottom ? size.y - kMenuHeight * scale : 0.0f), scale,
          kMenuWidth, kMenuHeight};
}

Canvas crosshair_canvas(const scene::Area& picture, float scale) {
  return {vec2(picture.min + picture.size / 2u), bounded(scale, kMostCrosshair), 0, 0};
}

float console_scale(ivec2 output, float scale, float width) {
  const auto whole = static_cast<float>(output.x);
  const float wanted = width > 0.0f ? width : scale > 0.0f ? whole / scale : whole;
  return whole / std::max(1.0f, std::clamp(wanted, std::min(320.0f, whole), whole));
}

}  // namespace fb::ui
