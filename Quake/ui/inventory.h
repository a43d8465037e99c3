// Which pictures a player's items are: names of gfx.wad and where they stand, without drawing.
#pragma once

#include <string>
#include <vector>

#include "ui/hud_view.h"

namespace fb::ui {

struct Icon {
  int slot = 0;  // weapons: 0 to 6, then the mission pack's; items: 0 to 7 (keys, powers, the mission pack's two)
  std::string picture;
  bool active = false;  // the weapon in hand
};

// In the order of drawing: a later one may lie over an earlier one of the same slot.
std::vector<Icon> weapon_icons(const HudView& view);
std::vector<Icon> item_icons(const HudView& view);
std::vector<Icon> sigil_icons(const HudView& view);

std::string face_picture(const HudView& view);
// Empty: there is none.
std::string armor_picture(const HudView& view);
std::string ammo_picture(const HudView& view);
std::string inventory_bar_picture(const HudView& view);

}  // namespace fb::ui
