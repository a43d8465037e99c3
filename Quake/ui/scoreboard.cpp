#include "ui/scoreboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/named_pictures.h"

namespace fb::ui {
namespace {

constexpr unsigned char kLeftBracket = 16, kRightBracket = 17, kOwnMark = 12;
constexpr int kBarWidth = 320;
constexpr float kScrollSpeed = 30.0f;  // pixels a second
constexpr int kScrollGap = 5;          // letters between two rounds of a text that scrolls, three of them slashes

float width_of(std::string_view text) { return kGlyph * static_cast<float>(text.size()); }

// A text that is wider than the bar goes round.
void draw_scrolling(Painter& painter, float y, std::string_view text, double now) {
  const float round = width_of(text) + kGlyph * kScrollGap;
  const float x = -std::floor(std::fmod(static_cast<float>(std::fmod(now, 1e5)) * kScrollSpeed, round));
  painter.clip(vec2(0.0f, -1e6f), vec2(kBarWidth, 1e6f));
  painter.text(x, y, text);
  painter.text(x + width_of(text) + kGlyph, y, "///");
  painter.text(x + round, y, text);
  painter.clip_nothing();
}

void draw_centered(Painter& painter, float y, std::string_view text) {
  painter.text((kBarWidth - width_of(text)) / 2.0f, y, text);
}

}  // namespace

std::vector<std::size_t> ranking(const cl::Hud& hud) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < hud.scores.size(); ++i)
    if (!hud.scores[i].name.empty()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return hud.scores[a].frags > hud.scores[b].frags; });
  return order;
}

// Each colour is a row of 16 shades; the middle one stands for it.
int color_index(int color) { return (color & 15) * 16 + 8; }

void draw_frags(Painter& painter, const HudView& view, std::size_t player, const FragsBox& box, bool brackets) {
  const cl::Score& score = view.hud.scores[player];
  const vec4 shirt = painter.atlas().color(color_index(score.colors >> 4)),
             trousers = painter.atlas().color(color_index(score.colors));
  painter.fill(box.x, box.y, box.width, box.top, shirt);
  painter.fill(box.x, box.y + box.top, box.width, box.bottom, trousers);
  const float text_x = box.width > 28.0f ? box.x + kGlyph : box.x + 2.0f;
  const float text_y = box.y + box.top + box.bottom - kGlyph;
  painter.text(text_x, text_y, fmt::format("{:3}", score.frags).substr(0, 3));
  if (!brackets || static_cast<int>(player) != view.hud.player) return;
  painter.character(box.width > 28.0f ? box.x : box.x - 4.0f, text_y, kLeftBracket);
  painter.character(box.width > 28.0f ? box.x + 32.0f : box.x + 22.0f, text_y, kRightBracket);
}

void draw_leaders(Painter& painter, const HudView& view) {
  constexpr std::size_t kMost = 4;
  const auto order = ranking(view.hud);
  for (std::size_t i = 0; i < std::min(order.size(), kMost); ++i)
    draw_frags(painter, view, order[i], {194.0f + 32.0f * static_cast<float>(i), 1.0f}, true);
}

bool fits_small_scoreboard(const HudView& view, float scale) {
  constexpr float kNeeded = 512.0f;  // the bar, and enough of the names
  return static_cast<float>(view.output.x) / scale >= kNeeded && view.settings.view_size < 120.0f;
}

void draw_small_scoreboard(Painter& painter, const HudView& view) {
  constexpr float kX = 324.0f;
  const bool low = view.settings.view_size >= 110.0f;
  const auto order = ranking(view.hud);
  const int count = static_cast<int>(order.size()), rows = low ? 3 : 6;
  const auto own = std::find(order.begin(), order.end(), static_cast<std::size_t>(std::max(view.hud.player, 0)));
  int first = view.hud.player < 0 || own == order.end() ? 0 : static_cast<int>(own - order.begin()) - rows / 2;
  first = std::max(0, std::min(first, count - rows));
  float y = low ? 24.0f : 0.0f;
  for (int i = first; i < count && y <= 48.0f; ++i, y += kGlyph) {
    const std::size_t player = order[static_cast<std::size_t>(i)];
    draw_frags(painter, view, player, {kX, y + 1.0f, 40.0f}, true);
    painter.text(kX + 48.0f, y, view.hud.scores[player].name);
  }
}

void draw_level_board(Painter& painter, const HudView& view) {
  painter.text(8.0f, 36.0f,
               fmt::format("Kills: {}/{}", view.stat(net::kStatMonsters), view.stat(net::kStatTotalMonsters)));
  const std::string secrets =
      fmt::format("Secrets: {}/{}", view.stat(net::kStatSecrets), view.stat(net::kStatTotalSecrets));
  painter.text(312.0f - width_of(secrets), 36.0f, secrets);
  draw_centered(painter, 36.0f, fmt::format("skill {}", view.skill));
  const std::string name = fmt::format("{} ({})", view.hud.level_name, view.hud.map_name);
  if (width_of(name) > kBarWidth)
    draw_scrolling(painter, 28.0f, name, view.now);
  else
    draw_centered(painter, 28.0f, name);
}

void draw_rankings(Painter& painter, const HudView& view) {
  if (const Picture* title = painter.atlas().picture("gfx/ranking.lmp"))
    painter.picture(static_cast<float>((kBarWidth - title->width) / 2), 8.0f, *title);
  constexpr float kX = 80.0f, kRow = 10.0f;
  float y = 40.0f;
  for (const std::size_t player : ranking(view.hud)) {
    draw_frags(painter, view, player, {kX, y, 40.0f, 4.0f, 4.0f}, false);
    if (static_cast<int>(player) == view.hud.player) painter.character(kX - kGlyph, y, kOwnMark);
    painter.text(kX + 64.0f, y, view.hud.scores[player].name, true);
    y += kRow;
  }
}

void draw_level_end(Painter& painter, const HudView& view) {
  draw_named(painter, 64.0f, 24.0f, "gfx/complete.lmp");
  draw_named(painter, 0.0f, 56.0f, "gfx/inter.lmp");
  const auto seconds = static_cast<int>(std::clamp(view.hud.completed_time, 0.0, 1e6));
  draw_number(painter, 152.0f, 64.0f, seconds / 60, 3, false);
  draw_named(painter, 224.0f, 64.0f, "num_colon");
  draw_number(painter, 240.0f, 64.0f, seconds % 60 / 10, 1, false);
  draw_number(painter, 264.0f, 64.0f, seconds % 10, 1, false);
  const auto row = [&](float y, int found, int all) {
    draw_number(painter, 152.0f, y, view.stat(found), 3, false);
    draw_named(painter, 224.0f, y, "num_slash");
    draw_number(painter, 240.0f, y, view.stat(all), 3, false);
  };
  row(104.0f, net::kStatSecrets, net::kStatTotalSecrets);
  row(144.0f, net::kStatMonsters, net::kStatTotalMonsters);
}

void draw_finale_title(Painter& painter) {
  if (const Picture* title = painter.atlas().picture("gfx/finale.lmp"))
    painter.picture(static_cast<float>((kBarWidth - title->width) / 2), 16.0f, *title);
}

}  // namespace fb::ui
