#include "ui/status_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "client/session/items.h"
#include "ui/inventory.h"
#include "ui/status_bar_parts.h"
#include "ui/view_area.h"

namespace fb::ui {
namespace {

// y of the bar and of the inventory's rows in the status bar's canvas.
constexpr float kBarY = 24.0f, kInventoryY = 8.0f;
constexpr int kLowArmor = 25, kLowHealth = 25, kLowAmmo = 10, kMostShown = 999;

void tile_sides(scene::DrawList& list, Atlas& atlas, const HudView& view, const Canvas& bar) {
  if (view.settings.bar_alpha < 1.0f || !shows_bar(view)) return;
  Painter painter(list, atlas, screen_canvas(view.output, 1.0f));
  const vec2 size(view.output);
  const float top = size.y - std::floor((shows_inventory(view) ? 48.0f : 24.0f) * bar.scale);
  draw_tiles(painter, {0.0f, top}, {bar.origin.x, size.y});
  draw_tiles(painter, {std::floor(bar.origin.x + static_cast<float>(bar.width) * bar.scale), top}, size);
}

void draw_inventory(Painter& painter, const HudView& view) {
  draw_named(painter, 0.0f, 0.0f, inventory_bar_picture(view), background(view));
  for (const Icon& icon : weapon_icons(view)) {
    // The mission pack's weapons are further right, where its keys have made room.
    const float x =
        icon.slot < 7 ? 24.0f * static_cast<float>(icon.slot) : 8.0f + 24.0f * static_cast<float>(icon.slot);
    draw_named(painter, x, kInventoryY, icon.picture);
  }
  for (int i = 0; i < 4; ++i)
    draw_small_number(painter, 10.0f + 48.0f * static_cast<float>(i), 0.0f, view.stat(net::kStatShells + i));
  for (const Icon& icon : item_icons(view))
    draw_named(painter, 192.0f + 16.0f * static_cast<float>(icon.slot), kInventoryY, icon.picture);
  for (const Icon& icon : sigil_icons(view))
    draw_named(painter, 288.0f + 8.0f * static_cast<float>(icon.slot), kInventoryY, icon.picture);
}

// Dissolution of Eternity's team games: the team's colours and the frags in the face's place.
void draw_team(Painter& painter, const HudView& view) {
  const std::size_t player = static_cast<std::size_t>(view.hud.player);
  draw_named(painter, 112.0f, kBarY, "r_teambord");
  const cl::Score& score = view.hud.scores[player];
  const int shirt = color_index(score.colors >> 4);
  painter.fill(113.0f, kBarY + 3.0f, 22.0f, 9.0f, painter.atlas().color(shirt));
  painter.fill(113.0f, kBarY + 12.0f, 22.0f, 9.0f, painter.atlas().color(color_index(score.colors)));
  const std::string frags = fmt::format("{:3}", score.frags).substr(0, 3);
  for (std::size_t i = 0; i < frags.size(); ++i) {
    // White digits would not show on white.
    const bool small = shirt == color_index(0) && frags[i] >= '0' && frags[i] <= '9';
    painter.character(113.0f + 7.0f * static_cast<float>(i), kBarY + 3.0f,
                      static_cast<unsigned char>(small ? kSmallZero + frags[i] - '0' : frags[i]));
  }
}

void draw_face(Painter& painter, const HudView& view) {
  const bool teams = view.rules == Rules::kRogue && view.hud.max_clients != 1 && view.teamplay > 3 && view.teamplay < 7;
  if (teams && view.hud.player >= 0 && static_cast<std::size_t>(view.hud.player) < view.hud.scores.size())
    draw_team(painter, view);
  else
    draw_named(painter, 112.0f, kBarY, face_picture(view));
}

void draw_bar(Painter& painter, const HudView& view, bool background_too) {
  if (background_too) draw_named(painter, 0.0f, kBarY, "sbar", background(view));
  if (view.rules == Rules::kHipnotic) {
    if (view.has(cl::kItemKey1)) draw_named(painter, 209.0f, kBarY + 3.0f, "sb_key1");
    if (view.has(cl::kItemKey2)) draw_named(painter, 209.0f, kBarY + 12.0f, "sb_key2");
  }
  const Armor armor = armor_shown(view);
  draw_number(painter, 24.0f, kBarY, armor.points, 3, armor.red);
  draw_named(painter, 0.0f, kBarY, armor_picture(view));
  draw_face(painter, view);
  draw_health(painter, view, 136.0f, kBarY);
  draw_named(painter, 224.0f, kBarY, ammo_picture(view));
  draw_ammo(painter, view, 248.0f, kBarY);
}

// The level's board in the bar's place, and all players in the middle.
void draw_scores(scene::DrawList& list, Atlas& atlas, const HudView& view, const Canvas& bar) {
  {
    Painter painter(list, atlas, bar);
    draw_named(painter, 0.0f, kBarY, "scorebar", background(view));
    draw_level_board(painter, view);
  }
  if (!view.deathmatch()) return;
  Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
  draw_rankings(painter, view);
}

void draw_wide_bar(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const bool quakeworld = view.settings.style == 3.0f;
  Canvas bar = status_bar_canvas(view.output, view.settings.bar_scale, view.deathmatch());
  if (quakeworld) {  // what stands at the side must fit, too
    const float most = static_cast<float>(view.output.y) / 240.0f;
    bar = status_bar_canvas(view.output, std::max(1.0f, std::min(view.settings.bar_scale, most)), view.deathmatch());
  } else {
    tile_sides(list, atlas, view, bar);
  }
  const bool small_scoreboard = view.deathmatch() && fits_small_scoreboard(view, bar.scale);
  if (quakeworld && shows_bar(view)) draw_side_inventory(list, atlas, view, small_scoreboard);
  {
    Painter painter(list, atlas, bar);
    if (quakeworld && shows_bar(view)) {
      for (const Icon& icon : item_icons(view))
        draw_named(painter, 192.0f + 16.0f * static_cast<float>(icon.slot), kInventoryY, icon.picture);
    }
    if (!quakeworld && shows_inventory(view)) {
      draw_inventory(painter, view);
      if (view.hud.max_clients != 1) draw_leaders(painter, view);
    }
    if (!view.scores_shown() && shows_bar(view)) draw_bar(painter, view, !quakeworld);
  }
  if (view.scores_shown()) draw_scores(list, atlas, view, bar);
  if (!small_scoreboard) return;
  Painter painter(list, atlas, bar);
  draw_small_scoreboard(painter, view);
}

}  // namespace

// Red where little is left.
void draw_health(Painter& painter, const HudView& view, float x, float y) {
  const int health = view.stat(net::kStatHealth);
  draw_number(painter, x, y, std::min(health, kMostShown), 3, health <= kLowHealth);
}

void draw_ammo(Painter& painter, const HudView& view, float x, float y) {
  const int ammo = view.stat(net::kStatAmmo);
  draw_number(painter, x, y, std::min(ammo, kMostShown), 3, ammo <= kLowAmmo);
}

Armor armor_shown(const HudView& view) {
  if (view.has(cl::kItemInvulnerability)) return {666, true};
  const int points = view.stat(net::kStatArmor);
  return {std::min(points, kMostShown), points <= kLowArmor};
}

void draw_status_bar(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const bool corners = view.settings.style == 1.0f || view.settings.style == 2.0f;
  if (!corners) return draw_wide_bar(list, atlas, view);
  if (view.scores_shown())
    draw_scores(list, atlas, view, status_bar_canvas(view.output, view.settings.bar_scale, false));
  else if (shows_bar(view))
    draw_corner_bar(list, atlas, view);
}

}  // namespace fb::ui
