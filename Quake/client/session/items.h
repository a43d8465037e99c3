// The bits of a player's items, as Quake's rules and those of its two mission packs send them.
#pragma once

#include <cstdint>

namespace fb::cl {

enum Items : std::uint32_t {
  kItemShotgun = 1u << 0,  // the seven weapons follow each other: super shotgun, nailgun, ... lightning gun
  kItemGrenadeLauncher = 1u << 4,
  kItemShells = 1u << 8,  // what the weapon in hand shoots; nails, rockets, cells follow
  kItemArmor1 = 1u << 13,
  kItemArmor2 = 1u << 14,
  kItemArmor3 = 1u << 15,
  kItemKey1 = 1u << 17,
  kItemKey2 = 1u << 18,
  kItemInvisibility = 1u << 19,
  kItemInvulnerability = 1u << 20,
  kItemSuit = 1u << 21,
  kItemQuad = 1u << 22,
  kItemSigil1 = 1u << 28,  // the four runes
};

// Numbers of bits that only Scourge of Armagon (hipnotic) uses so.
enum HipnoticBits : unsigned {
  kHipnoticMjolnir = 7,
  kHipnoticProximityGun = 16,
  kHipnoticLaserCannon = 23,
  kHipnoticWetsuit = 24,  // then the empathy shields
};

// Bits that only Dissolution of Eternity (rogue) uses so.
enum RogueItems : std::uint32_t {
  kRogueShells = 1u << 7,        // nails, rockets, cells follow
  kRogueLavaNailgun = 1u << 12,  // five powered weapons follow each other
  kRogueArmor1 = 1u << 23,       // two more follow
  kRogueLavaNails = 1u << 26,    // plasma, multi rockets follow
  kRogueShield = 1u << 29,       // then the antigravity belt
};

}  // namespace fb::cl
