#include "ui/view_area.h"

#include <algorithm>
#include <cmath>

#include "ui/canvas.h"
#include "ui/mod_bar.h"

namespace fb::ui {
namespace {

constexpr int kNarrowest = 96;

// What an opaque status bar of Quake's form covers, output pixels.
int bar_lines(const HudView& view) {
  const HudSettings& s = view.settings;
  if (s.view_size >= 120.0f || s.bar_alpha < 1.0f || s.style != 0.0f) return 0;
  if (view.mod_bar && view.mod_bar->has_bar()) return 0;
  const float scale = status_bar_canvas(view.output, s.bar_scale, false).scale;
  return static_cast<int>((s.view_size >= 110.0f ? 24.0f : 48.0f) * scale);
}

}  // namespace

scene::Area view_area(const HudView& view) {
  const ivec2 output = view.output;
  if (view.hud.intermission != cl::Intermission::kNone) return {uvec2(0), uvec2(output)};
  const int lines = bar_lines(view);
  const float share = std::clamp(view.settings.view_size, 30.0f, 100.0f) / 100.0f;
  const int width = std::min(std::max(static_cast<int>(static_cast<float>(output.x) * share), kNarrowest), output.x);
  const int height = std::max(1, std::min(static_cast<int>(static_cast<float>(output.y) * share), output.y - lines));
  const ivec2 min((output.x - width) / 2, std::max(0, (output.y - lines - height) / 2));
  return {uvec2(min), uvec2(width, height)};
}

void draw_tiles(Painter& painter, const vec2& min, const vec2& max) {
  constexpr float kTile = 64.0f;
  const Picture* const picture = painter.atlas().picture("backtile");
  if (!picture || min.x >= max.x || min.y >= max.y) return;
  painter.clip(min, max);
  const vec2 first = glm::floor(min / kTile) * kTile;
  for (float y = first.y; y < max.y; y += kTile)
    for (float x = first.x; x < max.x; x += kTile) painter.picture(x, y, kTile, kTile, *picture);
  painter.clip_nothing();
}

void draw_border(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const scene::Area area = view_area(view);
  if (area.size == uvec2(view.output)) return;
  Painter painter(list, atlas, screen_canvas(view.output, 1.0f));
  const vec2 min(area.min), max = min + vec2(area.size);
  const vec2 end(static_cast<float>(view.output.x), static_cast<float>(view.output.y - bar_lines(view)));
  draw_tiles(painter, {0.0f, 0.0f}, {min.x, end.y});
  draw_tiles(painter, {max.x, 0.0f}, end);
  draw_tiles(painter, {min.x, 0.0f}, {max.x, min.y});
  draw_tiles(painter, {min.x, max.y}, {max.x, end.y});
}

}  // namespace fb::ui
