#include "ui/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "client/session/items.h"

namespace fb::ui {
namespace {

constexpr int kGrenadeSlot = 4, kFirstExtraSlot = 7;
constexpr double kFlashSeconds = 1.0;

// States of a weapon's picture: owned, in hand, then the five of its flash.
enum : int { kOwned = 0, kInHand = 1, kFlash = 2, kFlashes = 5 };

std::string weapon_picture(int state, std::string_view weapon) {
  if (state == kOwned) return fmt::format("inv_{}", weapon);
  if (state == kInHand) return fmt::format("inv2_{}", weapon);
  return fmt::format("inva{}_{}", state - kFlash + 1, weapon);
}

// A weapon that has just been won flashes for a second, ten pictures a second.
int weapon_state(const HudView& view, unsigned bit) {
  const double age = view.hud.time - view.hud.item_time[bit];
  if (age >= 0.0 && age < kFlashSeconds) return kFlash + static_cast<int>(age * 10.0) % kFlashes;
  return view.active_weapon() == 1u << bit ? kInHand : kOwned;
}

// The proximity gun shares the grenade launcher's slot: which of the two is in hand or flashes shows.
void add_proximity_gun(const HudView& view, std::vector<Icon>& icons) {
  const bool grenades = view.has(cl::kItemGrenadeLauncher);
  if (!view.has(1u << cl::kHipnoticProximityGun)) return;
  const auto add = [&](int state, std::string_view weapon) {
    icons.push_back({kGrenadeSlot, weapon_picture(state, weapon), state == kInHand});
  };
  const int proximity = weapon_state(view, cl::kHipnoticProximityGun);
  if (!grenades) return add(proximity, "prox");
  const int launcher = weapon_state(view, kGrenadeSlot);
  if (launcher != kOwned)
    add(launcher, "gren_prox");
  else
    add(proximity, "prox_gren");
}

void add_hipnotic_weapons(const HudView& view, std::vector<Icon>& icons) {
  add_proximity_gun(view, icons);
  const auto add = [&](int slot, unsigned bit, std::string_view weapon) {
    if (!view.has(1u << bit)) return;
    const int state = weapon_state(view, bit);
    icons.push_back({slot, weapon_picture(state, weapon), state == kInHand});
  };
  add(kFirstExtraSlot, cl::kHipnoticLaserCannon, "laser");
  add(kFirstExtraSlot + 1, cl::kHipnoticMjolnir, "mjolnir");
}

// A weapon of Dissolution of Eternity's that shoots its second ammunition lies over the plain one.
void add_powered_weapon(const HudView& view, std::vector<Icon>& icons) {
  constexpr std::array<const char*, 5> kPowered = {"r_lava", "r_superlava", "r_gren", "r_multirock", "r_plasma"};
  for (std::size_t i = 0; i < kPowered.size(); ++i) {
    if (view.active_weapon() == cl::kRogueLavaNailgun << i)
      icons.push_back({static_cast<int>(i) + 2, kPowered[i], true});
  }
}

}  // namespace

std::uint32_t HudView::active_weapon() const {
  const auto sent = static_cast<std::uint32_t>(stat(net::kStatActiveWeapon));
  if (rules == Rules::kQuake) return sent;
  return sent < 32 ? 1u << sent : 0u;
}

std::vector<Icon> weapon_icons(const HudView& view) {
  constexpr std::array<const char*, 7> kWeapons = {"shotgun", "sshotgun", "nailgun", "snailgun",
                                                   "rlaunch", "srlaunch", "lightng"};
  std::vector<Icon> icons;
  for (unsigned i = 0; i < kWeapons.size(); ++i) {
    if (!view.has(cl::kItemShotgun << i)) continue;
    const int state = weapon_state(view, i);
    icons.push_back({static_cast<int>(i), weapon_picture(state, kWeapons[i]), state == kInHand});
  }
  if (view.rules == Rules::kHipnotic) add_hipnotic_weapons(view, icons);
  if (view.rules == Rules::kRogue) add_powered_weapon(view, icons);
  return icons;
}

std::vector<Icon> item_icons(const HudView& view) {
  constexpr std::array<const char*, 6> kItems = {"sb_key1", "sb_key2", "sb_invis", "sb_invuln", "sb_suit", "sb_quad"};
  std::vector<Icon> icons;
  const bool hipnotic = view.rules == Rules::kHipnotic;
  for (std::size_t i = hipnotic ? 2 : 0; i < kItems.size(); ++i)
    if (view.has(cl::kItemKey1 << i)) icons.push_back({static_cast<int>(i), kItems[i]});
  const auto add_two = [&](std::uint32_t first, const char* one, const char* other) {
    if (view.has(first)) icons.push_back({6, one});
    if (view.has(first << 1u)) icons.push_back({7, other});
  };
  if (hipnotic) add_two(1u << cl::kHipnoticWetsuit, "sb_wsuit", "sb_eshld");
  if (view.rules == Rules::kRogue) add_two(cl::kRogueShield, "r_shield1", "r_agrav1");
  return icons;
}

std::vector<Icon> sigil_icons(const HudView& view) {
  std::vector<Icon> icons;
  if (view.rules == Rules::kRogue) return icons;
  for (int i = 0; i < 4; ++i)
    if (view.has(cl::kItemSigil1 << static_cast<unsigned>(i))) icons.push_back({i, fmt::format("sb_sigil{}", i + 1)});
  return icons;
}

std::string face_picture(const HudView& view) {
  const bool unseen = view.has(cl::kItemInvisibility), unhurt = view.has(cl::kItemInvulnerability);
  if (unseen && unhurt) return "face_inv2";
  if (view.has(cl::kItemQuad)) return "face_quad";
  if (unseen) return "face_invis";
  if (unhurt) return "face_invul2";
  // 1 is the healthiest: five pictures, one for each 20 points.
  const int face = 5 - std::clamp(view.stat(net::kStatHealth) / 20, 0, 4);
  return fmt::format("{}{}", view.hud.time <= view.hud.face_pain_until ? "face_p" : "face", face);
}

std::string armor_picture(const HudView& view) {
  if (view.has(cl::kItemInvulnerability)) return "disc";
  const std::uint32_t first = view.rules == Rules::kRogue ? std::uint32_t{cl::kRogueArmor1} : cl::kItemArmor1;
  for (int i = 2; i >= 0; --i)
    if (view.has(first << static_cast<unsigned>(i))) return fmt::format("sb_armor{}", i + 1);
  return {};
}

std::string ammo_picture(const HudView& view) {
  constexpr std::array<const char*, 4> kAmmo = {"sb_shells", "sb_nails", "sb_rocket", "sb_cells"};
  // Plasma's and multi rockets' pictures are exchanged, as in the mission pack itself.
  constexpr std::array<const char*, 3> kRogueAmmo = {"r_ammolava", "r_ammomulti", "r_ammoplasma"};
  const bool rogue = view.rules == Rules::kRogue;
  const std::uint32_t first = rogue ? std::uint32_t{cl::kRogueShells} : cl::kItemShells;
  for (std::size_t i = 0; i < kAmmo.size(); ++i)
    if (view.has(first << i)) return kAmmo[i];
  for (std::size_t i = 0; rogue && i < kRogueAmmo.size(); ++i)
    if (view.has(cl::kRogueLavaNails << i)) return kRogueAmmo[i];
  return {};
}

std::string inventory_bar_picture(const HudView& view) {
  if (view.rules != Rules::kRogue) return "ibar";
  return view.active_weapon() >= cl::kRogueLavaNailgun ? "r_invbar1" : "r_invbar2";
}

}  // namespace fb::ui
