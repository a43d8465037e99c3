#include "ui/signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ui/named_pictures.h"
#include "ui/overlays.h"
#include "ui/painter.h"
#include "ui/view_area.h"

namespace fb::ui {
namespace {

constexpr double kSilent = 0.3;          // seconds without a message after which the sign comes
constexpr double kSpeedInterval = 0.05;  // seconds

// A picture of its own in the middle of the menu's canvas, a little above.
void draw_plaque(scene::DrawList& list, Atlas& atlas, const HudView& view, const char* name) {
  Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
  if (const Picture* picture = atlas.picture(name)) {
    painter.picture(static_cast<float>((painter.width() - picture->width) / 2),
                    static_cast<float>((painter.height() - 8 - picture->height) / 2), *picture);
  }
}

void draw_speed(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  Painter painter(list, atlas, crosshair_canvas(view_area(view), view.settings.crosshair_scale));
  const std::string text = fmt::format("{}", static_cast<int>(std::min(view.speed, 1e6f)));
  painter.text(-kGlyph / 2.0f * static_cast<float>(text.size()), 4.0f + view.settings.speed_offset, text);
}

}  // namespace

void draw_crosshair(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  if (view.settings.crosshair == 0.0f) return;
  Painter painter(list, atlas, crosshair_canvas(view_area(view), view.settings.crosshair_scale));
  painter.character(-kGlyph / 2.0f, -kGlyph / 2.0f, '+');
}

void draw_warnings(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const HudSettings& s = view.settings;
  Painter painter(list, atlas,
                  screen_canvas(view.output, console_scale(view.output, s.console_scale, s.console_width)));
  if (view.silence > kSilent) draw_named(painter, 64.0f, 0.0f, "net");
  if (view.slow && s.show_turtle != 0.0f) draw_named(painter, 0.0f, 0.0f, "turtle");
}

void draw_pause(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  if (view.hud.paused && view.settings.show_pause != 0.0f) draw_plaque(list, atlas, view, "gfx/pause.lmp");
}

void draw_loading(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  draw_plaque(list, atlas, view, "gfx/loading.lmp");
}

void draw_start(scene::DrawList& list, Atlas& atlas, const HudView& view, double seconds, std::string_view what) {
  constexpr float kWidth = 128.0f, kHeight = 4.0f, kPart = 0.3f, kSweep = 1.6f;  // kSweep: seconds from end to end
  constexpr vec4 kGround(0.2f, 0.16f, 0.13f, 1.0f), kBar(0.75f, 0.5f, 0.2f, 1.0f);
  draw_loading(list, atlas, view);
  Painter painter(list, atlas, view.output.x, view.output.y, automatic_scale(view.output.x, view.output.y));
  const float x = 0.5f * (static_cast<float>(painter.width()) - kWidth);
  const float y = 0.62f * static_cast<float>(painter.height());
  const auto turn = static_cast<float>(std::fmod(seconds / kSweep, 2.0));
  const float at = (1.0f - kPart) * kWidth * (turn < 1.0f ? turn : 2.0f - turn);
  painter.fill(x, y, kWidth, kHeight, kGround);
  painter.fill(x + at, y, kPart * kWidth, kHeight, kBar);
  const float length = kGlyph * static_cast<float>(what.size());
  painter.text(0.5f * (static_cast<float>(painter.width()) - length), y + 2.0f * kHeight, what);
}

void draw_readings(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const HudSettings& s = view.settings;
  if (s.show_speed != 0.0f && view.speed >= 0.0f) draw_speed(list, atlas, view);
  // The other forms of the status bar have the lower corner for ammunition.
  const bool low = s.style == 0.0f;
  const float scale = console_scale(view.output, s.console_scale, s.console_width);
  Painter painter(list, atlas, corner_canvas(view.output, scale, true, low));
  const float right = static_cast<float>(painter.width()) - (low ? 0.0f : 16.0f);
  float y = low ? static_cast<float>(painter.height()) - kGlyph : kGlyph;
  if (s.clock == 1.0f) {
    const auto seconds = static_cast<int>(std::clamp(view.hud.time, 0.0, 1e6));
    const std::string time = fmt::format("{}:{:02}", seconds / 60, seconds % 60);
    painter.text(right - kGlyph * static_cast<float>(time.size()), y, time);
    y += low ? -kGlyph : kGlyph;
  }
  if (s.show_fps != 0.0f) draw_fps(painter, right, y, view.frame_rate);
}

void SpeedReading::frame(double now, float speed) {
  most_ = std::max(most_, speed);
  if (since_ >= 0.0 && now >= since_ && now - since_ < kSpeedInterval) return;
  if (since_ >= 0.0) shown_ = most_;
  since_ = now;
  most_ = 0.0f;
}

}  // namespace fb::ui
