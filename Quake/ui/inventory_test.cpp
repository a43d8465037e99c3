#include "ui/inventory.h"

#include <gtest/gtest.h>

#include "client/session/items.h"

namespace fb::ui {
namespace {

struct Player {
  Player() {
    hud.time = 50.0;
    hud.stats[net::kStatHealth] = 100;
  }
  HudView view() const { return {hud, {}, rules, {320, 200}}; }
  void give(std::uint32_t items) { hud.items |= static_cast<std::int32_t>(items); }
  std::string weapons() const {
    std::string all;
    for (const Icon& icon : weapon_icons(view()))
      all += std::to_string(icon.slot) + ":" + icon.picture + (icon.active ? "! " : " ");
    return all;
  }
  std::string items() const {
    std::string all;
    for (const Icon& icon : item_icons(view())) all += std::to_string(icon.slot) + ":" + icon.picture + " ";
    for (const Icon& icon : sigil_icons(view())) all += std::to_string(icon.slot) + ":" + icon.picture + " ";
    return all;
  }
  cl::Hud hud;
  Rules rules = Rules::kQuake;
};

TEST(Inventory, WeaponsOwnedInHandAndNew) {
  Player p;
  EXPECT_EQ(p.weapons(), "");
  p.give(cl::kItemShotgun | 64u);
  p.hud.stats[net::kStatActiveWeapon] = 64;
  EXPECT_EQ(p.weapons(), "0:inv_shotgun 6:inv2_lightng! ");
  p.hud.item_time[0] = 50.0;
  EXPECT_EQ(p.weapons(), "0:inva1_shotgun 6:inv2_lightng! ");
  p.hud.time = 50.25;
  EXPECT_EQ(p.weapons(), "0:inva3_shotgun 6:inv2_lightng! ");
  p.hud.time = 50.75;  // the five pictures twice
  EXPECT_EQ(p.weapons(), "0:inva3_shotgun 6:inv2_lightng! ");
  p.hud.time = 51.0;
  EXPECT_EQ(p.weapons(), "0:inv_shotgun 6:inv2_lightng! ");
  p.hud.time = 49.0;  // the clock has gone back
  EXPECT_EQ(p.weapons(), "0:inv_shotgun 6:inv2_lightng! ");
}

TEST(Inventory, HipnoticSharesTheGrenadeLaunchersSlot) {
  Player p;
  p.rules = Rules::kHipnotic;
  p.give(1u << cl::kHipnoticProximityGun);
  EXPECT_EQ(p.weapons(), "4:inv_prox ");
  p.hud.stats[net::kStatActiveWeapon] = cl::kHipnoticProximityGun;  // numbers of bits
  EXPECT_EQ(p.weapons(), "4:inv2_prox! ");
  p.give(cl::kItemGrenadeLauncher);
  EXPECT_EQ(p.weapons(), "4:inv_rlaunch 4:inv2_prox_gren! ");
  p.hud.stats[net::kStatActiveWeapon] = 4;
  EXPECT_EQ(p.weapons(), "4:inv2_rlaunch! 4:inv2_gren_prox! ");
  p.hud.stats[net::kStatActiveWeapon] = 0;
  EXPECT_EQ(p.weapons(), "4:inv_rlaunch 4:inv_prox_gren ");
  p.give(1u << cl::kHipnoticLaserCannon | 1u << cl::kHipnoticMjolnir);
  EXPECT_EQ(p.weapons(), "4:inv_rlaunch 4:inv_prox_gren 7:inv_laser 8:inv_mjolnir ");
}

TEST(Inventory, RoguesPoweredWeaponsLieOverThePlainOnes) {
  Player p;
  p.rules = Rules::kRogue;
  p.give(4u | cl::kRogueShells << 1u);
  EXPECT_EQ(inventory_bar_picture(p.view()), "r_invbar2");
  p.hud.stats[net::kStatActiveWeapon] = 2;
  EXPECT_EQ(p.weapons(), "2:inv2_nailgun! ");
  p.hud.stats[net::kStatActiveWeapon] = 12;
  EXPECT_EQ(p.weapons(), "2:inv_nailgun 2:r_lava! ");
  EXPECT_EQ(inventory_bar_picture(p.view()), "r_invbar1");
  EXPECT_EQ(ammo_picture(p.view()), "sb_nails");
  p.hud.items = static_cast<std::int32_t>(cl::kRogueLavaNails << 1u);
  EXPECT_EQ(ammo_picture(p.view()), "r_ammomulti");
  p.hud.items = static_cast<std::int32_t>(cl::kRogueArmor1 << 2u);
  EXPECT_EQ(armor_picture(p.view()), "sb_armor3");
}

TEST(Inventory, ItemsOfEachGame) {
  Player p;
  p.give(cl::kItemKey1 | cl::kItemQuad | cl::kItemSigil1 | cl::kItemSigil1 << 3u);
  EXPECT_EQ(p.items(), "0:sb_key1 5:sb_quad 0:sb_sigil1 3:sb_sigil4 ");
  p.rules = Rules::kHipnotic;  // whose keys are on the bar itself
  p.give(1u << 24u | 1u << 25u);
  EXPECT_EQ(p.items(), "5:sb_quad 6:sb_wsuit 7:sb_eshld 0:sb_sigil1 3:sb_sigil4 ");
  p.rules = Rules::kRogue;
  p.hud.items = static_cast<std::int32_t>(cl::kRogueShield | cl::kRogueShield << 1u | cl::kItemKey2);
  EXPECT_EQ(p.items(), "1:sb_key2 6:r_shield1 7:r_agrav1 ");
}

TEST(Inventory, FaceByHealthPainAndPowers) {
  Player p;
  const auto face = [&](int health) {
    p.hud.stats[net::kStatHealth] = health;
    return face_picture(p.view());
  };
  EXPECT_EQ(face(250), "face1");
  EXPECT_EQ(face(80), "face1");
  EXPECT_EQ(face(79), "face2");
  EXPECT_EQ(face(40), "face3");
  EXPECT_EQ(face(20), "face4");
  EXPECT_EQ(face(19), "face5");
  EXPECT_EQ(face(-40), "face5");
  p.hud.face_pain_until = 50.0;
  EXPECT_EQ(face(100), "face_p1");
  p.give(cl::kItemInvisibility);
  EXPECT_EQ(face(100), "face_invis");
  p.give(cl::kItemQuad);
  EXPECT_EQ(face(100), "face_quad");
  p.give(cl::kItemInvulnerability);
  EXPECT_EQ(face(100), "face_inv2");
  p.hud.items = static_cast<std::int32_t>(cl::kItemInvulnerability);
  EXPECT_EQ(face(100), "face_invul2");
  EXPECT_EQ(armor_picture(p.view()), "disc");
}

TEST(Inventory, ArmorAndAmmunition) {
  Player p;
  EXPECT_EQ(armor_picture(p.view()), "");
  EXPECT_EQ(ammo_picture(p.view()), "");
  p.give(cl::kItemArmor2 | cl::kItemShells << 2u);
  EXPECT_EQ(armor_picture(p.view()), "sb_armor2");
  EXPECT_EQ(ammo_picture(p.view()), "sb_rocket");
}

}  // namespace
}  // namespace fb::ui
