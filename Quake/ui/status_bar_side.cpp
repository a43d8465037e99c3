// QuakeWorld's inventory: weapons above each other at the right, the four counts of ammunition and the runes below
// them.
#include <algorithm>

#include "client/session/items.h"
#include "ui/inventory.h"
#include "ui/status_bar_parts.h"

namespace fb::ui {
namespace {

constexpr float kAmmoRow = 11.0f, kSideSize = 48.0f;

Canvas side_canvas(const HudView& view) {
  const vec2 size(view.output);
  const float scale = std::max(1.0f, std::min(view.settings.bar_scale, size.y / 240.0f));
  return {vec2(size.x - kSideSize * scale, size.y - kSideSize * scale), scale, static_cast<int>(kSideSize),
          static_cast<int>(kSideSize)};
}

}  // namespace

void draw_side_inventory(scene::DrawList& list, Atlas& atlas, const HudView& view, bool small_scoreboard) {
  if (!shows_inventory(view)) return;
  Painter painter(list, atlas, side_canvas(view));
  const bool rogue = view.rules == Rules::kRogue, hipnotic = view.rules == Rules::kHipnotic;
  const float ammo_y = small_scoreboard && !rogue && !hipnotic ? -69.0f : -45.0f;  // runes are above a scoreboard
  const float weapons_y = ammo_y - kIconRow * (hipnotic ? 9.0f : 7.0f);
  for (const Icon& icon : weapon_icons(view))
    draw_named(painter, 24.0f, weapons_y + kIconRow * static_cast<float>(icon.slot), icon.picture);
  const Picture* const bar = atlas.picture(inventory_bar_picture(view));
  for (int i = 0; i < 4; ++i) {
    const float y = ammo_y + kAmmoRow * static_cast<float>(i);
    if (bar && rogue) painter.part(4.0f, y, *bar, 48 * i + 1, 0, 44, 11, background(view));
    if (bar && !rogue) painter.part(6.0f, y, *bar, 48 * i + 3, 0, 42, 11, background(view));
    draw_small_number(painter, 13.0f, y, view.stat(net::kStatShells + i));
  }
  const auto sigils = sigil_icons(view);
  const float sigil_y = ammo_y + 53.0f;
  if (bar && !sigils.empty()) painter.part(16.0f, sigil_y, *bar, 288, 8, 32, 16);
  for (const Icon& sigil : sigils)
    draw_named(painter, 16.0f + 8.0f * static_cast<float>(sigil.slot), sigil_y, sigil.picture);
  if (view.hud.max_clients == 1 || small_scoreboard) return;
  const auto order = ranking(view.hud);
  const int count = static_cast<int>(std::min<std::size_t>(order.size(), 4));
  for (int i = 0; i < count; ++i)
    draw_frags(painter, view, order[static_cast<std::size_t>(i)],
               {-78.0f + 32.0f * static_cast<float>(4 - count + i), 0.0f}, true);
}

}  // namespace fb::ui
