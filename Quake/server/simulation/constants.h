// Numbers that QuakeC's fields hold, as Quake's defs.qc names them.
#pragma once

#include <cstdint>

namespace fb::sv {

// movetype
constexpr int kMoveNone = 0, kMoveWalk = 3, kMoveStep = 4, kMoveFly = 5, kMoveToss = 6, kMovePush = 7, kMoveNoClip = 8,
              kMoveFlyMissile = 9, kMoveBounce = 10, kMoveGib = 11;
// solid
constexpr int kSolidNot = 0, kSolidTrigger = 1, kSolidBBox = 2, kSolidSlideBox = 3, kSolidBsp = 4;
// deadflag
constexpr int kDeadNo = 0, kDeadDying = 1, kDeadDead = 2;
// takedamage
constexpr int kDamageNo = 0, kDamageYes = 1, kDamageAim = 2;
// flags
constexpr std::int32_t kFlagFly = 1, kFlagSwim = 2, kFlagConveyor = 4, kFlagClient = 8, kFlagInWater = 16,
                       kFlagMonster = 32, kFlagGodMode = 64, kFlagNoTarget = 128, kFlagItem = 256, kFlagOnGround = 512,
                       kFlagPartialGround = 1024, kFlagWaterJump = 2048, kFlagJumpReleased = 4096;
// spawnflags
constexpr std::int32_t kSpawnNotEasy = 256, kSpawnNotMedium = 512, kSpawnNotHard = 1024, kSpawnNotDeathmatch = 2048;

// What a move may meet (traceline's second parameter): everything; no monsters; missiles, to whom monsters are wider.
enum class MoveKind { kNormal = 0, kNoMonsters = 1, kMissile = 2 };

}  // namespace fb::sv
