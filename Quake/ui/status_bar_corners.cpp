// The status bar without a bar: numbers in the lower corners, weapons at the right, powers at the left (Ironwail's
// forms 1 and 2, whose difference is where the ammunition stands).
#include <algorithm>
#include <cmath>

#include "client/session/items.h"
#include "ui/inventory.h"
#include "ui/status_bar_parts.h"

namespace fb::ui {
namespace {

constexpr float kMarginX = 16.0f, kMarginY = 10.0f, kBigRow = 24.0f;
constexpr double kSigilSeconds = 3.0;

// The canvas of all of the output at the status bar's scale, which leaves room for both corners.
Canvas corner_bar_canvas(const HudView& view) {
  const vec2 size(view.output);
  const float most = std::max(1.0f, std::min(size.x / 400.0f, size.y / 225.0f));
  return screen_canvas(view.output, std::clamp(view.settings.bar_scale, 1.0f, most));
}

struct CornerBar {
  Painter& painter;
  const HudView& view;
  float right, bottom;
  bool at_side;  // the ammunition: at the right, in two rows, instead of in the middle

  void draw_vitals() const {
    const float y = bottom - kMarginY - kBigRow;
    draw_named(painter, kMarginX, y, face_picture(view));
    draw_health(painter, view, kMarginX + 32.0f, y);
    const Armor armor = armor_shown(view);
    if (armor.points <= 0) return;
    draw_number(painter, kMarginX + 32.0f, y - kBigRow, armor.points, 3, armor.red);
    draw_named(painter, kMarginX, y - kBigRow, armor_picture(view));
  }

  void draw_ammo() const {
    const float y = bottom - kMarginY - kBigRow;
    float x = right - kMarginX - 24.0f;
    if (const std::string picture = ammo_picture(view); !picture.empty()) {
      draw_named(painter, x, y, picture);
      x -= 32.0f;
    }
    ui::draw_ammo(painter, view, x - 48.0f, y);
  }

  // From the right edge, the lowest slot at the bottom; the weapon in hand comes out further.
  void draw_weapons() const {
    const float middle = std::floor((bottom - 148.0f) / 2.0f + kIconRow * 3.5f + 0.5f) + kBigRow +
                         (view.rules == Rules::kHipnotic ? 12.0f : 0.0f);
    const auto icons = weapon_icons(view);
    for (const Icon& icon : icons) {
      // A mission pack's picture takes the place of the weapon's own.
      const auto covers = [&](const Icon& other) { return &other > &icon && other.slot == icon.slot; };
      if (std::any_of(icons.begin(), icons.end(), covers)) continue;
      draw_named(painter, right + 1.0f - (icon.active ? 24.0f : 18.0f),
                 middle - kIconRow * static_cast<float>(icon.slot), icon.picture);
    }
  }

  void draw_ammo_counts() const {
    const Picture* const bar = painter.atlas().picture(inventory_bar_picture(view));
    for (int i = 0; i < 4; ++i) {
      const float number = static_cast<float>(i), column = static_cast<float>(i % 2), row = static_cast<float>(i / 2);
      float x = std::floor(right / 2.0f) - 96.0f + 48.0f * number, y = bottom - 9.0f, gap = 0.0f;
      if (at_side) {
        x = right - kMarginX - 104.0f + 52.0f * column;
        y = bottom - kMarginY - 36.0f - 10.0f * row;
        gap = 1.0f;
      }
      if (bar) painter.part(x + 2.0f * gap, y, *bar, 48 * i, 0, 48, 10, background(view));
      draw_small_number(painter, x + 10.0f + 2.0f * gap, y, view.stat(net::kStatShells + i));
    }
  }

  void draw_keys() const {
    const bool side = at_side && shows_inventory(view);
    const float x = right - kMarginX - (side ? 16.0f : 20.0f);
    float y = bottom - kMarginY - (side ? 64.0f : 44.0f);
    const bool hipnotic = view.rules == Rules::kHipnotic;  // whose keys are smaller
    for (const auto& [bit, name] : {std::pair{cl::kItemKey1, "sb_key1"}, std::pair{cl::kItemKey2, "sb_key2"}}) {
      if (!view.has(bit)) continue;
      draw_named(painter, x, y + (hipnotic ? 6.0f : 0.0f), name);
      const Picture* const key = hipnotic ? painter.atlas().picture(name) : nullptr;
      y -= key ? static_cast<float>(key->height) : kIconRow;
    }
  }

  void draw_powers() const {
    float y = bottom - kMarginY - 42.0f - (armor_shown(view).points > 0 ? kBigRow : 0.0f);
    for (const Icon& icon : item_icons(view)) {
      if (icon.slot < 2) continue;  // keys
      draw_named(painter, kMarginX + 4.0f, y, icon.picture);
      y -= kIconRow;
    }
  }

  void draw_players() const {
    const auto order = ranking(view.hud);
    float y = std::max(40.0f, std::floor(bottom / 4.0f) - 8.0f * static_cast<float>(order.size() / 4));
    for (const std::size_t player : order) {
      draw_frags(painter, view, player, {6.0f, y + 1.0f}, true);
      if (shows_inventory(view)) painter.text(40.0f, y, view.hud.scores[player].name);
      y += 8.0f;
    }
  }
};

// Runes show for a while when they are won.
void draw_sigils(scene::DrawList& list, Atlas& atlas, const HudView& view, bool at_side) {
  const auto sigils = sigil_icons(view);
  double newest = -1e9;
  for (const Icon& sigil : sigils)
    newest = std::max(newest, view.hud.item_time[static_cast<std::size_t>(28 + sigil.slot)]);
  if (sigils.empty() || view.hud.time - newest > kSigilSeconds) return;
  Painter painter(list, atlas, status_bar_canvas(view.output, view.settings.bar_scale, false));
  const float x = 144.0f, y = at_side ? 20.0f : 16.0f;
  if (const Picture* bar = atlas.picture("ibar")) painter.part(x, y, *bar, 288, 8, 32, 16);
  for (const Icon& sigil : sigils) draw_named(painter, x + 8.0f * static_cast<float>(sigil.slot), y, sigil.picture);
}

}  // namespace

void draw_corner_bar(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const bool at_side = view.settings.style == 2.0f;
  {
    Painter painter(list, atlas, corner_bar_canvas(view));
    const CornerBar bar{painter, view, static_cast<float>(painter.width()), static_cast<float>(painter.height()),
                        at_side};
    bar.draw_vitals();
    bar.draw_ammo();
    if (shows_inventory(view)) {
      bar.draw_weapons();
      bar.draw_ammo_counts();
      bar.draw_powers();
    }
    bar.draw_keys();
    if (view.hud.max_clients != 1) bar.draw_players();
  }
  draw_sigils(list, atlas, view, at_side);
}

}  // namespace fb::ui
