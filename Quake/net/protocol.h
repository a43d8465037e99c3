// Constants of Quake's network protocols 15 (NetQuake), 666 (FitzQuake) and 999 (RMQ), as in QuakeSpasm. Values only:
// message.h and server_messages.h encode them.
#pragma once

#include <cstdint>
#include <string_view>

namespace fb::net {

constexpr int kProtocolNetQuake = 15;
constexpr int kProtocolFitzQuake = 666;
constexpr int kProtocolRmq = 999;

// Protocol 999 states the width of its numbers in svc_serverinfo.
enum ProtocolFlags : std::uint32_t {
  kShortAngle = 1u << 1,
  kFloatAngle = 1u << 2,
  kCoord24 = 1u << 3,
  kFloatCoord = 1u << 4,
  kEdictScale = 1u << 5,
  kAlphaSanity = 1u << 6,  // for the server only: does not change messages
  kInt32Coord = 1u << 7,
  kMoreFlags = 1u << 31,  // reserved: no engine sends data for it
};
constexpr std::uint32_t kKnownProtocolFlags =
    kShortAngle | kFloatAngle | kCoord24 | kFloatCoord | kEdictScale | kAlphaSanity | kInt32Coord;

struct Protocol {
  int version = kProtocolNetQuake;
  std::uint32_t flags = 0;  // ProtocolFlags, zero unless version is 999
  bool extended() const { return version != kProtocolNetQuake; }
  bool operator==(const Protocol&) const = default;
};
constexpr bool is_known_protocol(int version) {
  return version == kProtocolNetQuake || version == kProtocolFitzQuake || version == kProtocolRmq;
}

// The byte that begins a message, and its name in errors. Each struct of server_messages.h and client_messages.h has
// one.
struct Command {
  std::uint8_t number;
  std::string_view name;
};

// Fields of an entity update. A command byte of 128 and more is an update; its low seven bits are the first bits.
enum UpdateBits : std::uint32_t {
  kUpdateMoreBits = 1u << 0,
  kUpdateOrigin1 = 1u << 1,
  kUpdateOrigin2 = 1u << 2,
  kUpdateOrigin3 = 1u << 3,
  kUpdateAngle2 = 1u << 4,
  kUpdateStep = 1u << 5,  // moves by MOVETYPE_STEP: the client interpolates its steps
  kUpdateFrame = 1u << 6,
  kUpdateSignal = 1u << 7,
  kUpdateAngle1 = 1u << 8,
  kUpdateAngle3 = 1u << 9,
  kUpdateModel = 1u << 10,
  kUpdateColormap = 1u << 11,
  kUpdateSkin = 1u << 12,
  kUpdateEffects = 1u << 13,
  kUpdateLongEntity = 1u << 14,
  kUpdateExtend1 = 1u << 15,  // 666 and 999; in 15 the bit means Nehahra's transparency
  kUpdateAlpha = 1u << 16,
  kUpdateFrame2 = 1u << 17,
  kUpdateModel2 = 1u << 18,
  kUpdateLerpFinish = 1u << 19,
  kUpdateScale = 1u << 20,
  kUpdateExtend2 = 1u << 23,
};

// Fields of svc_clientdata.
enum ClientDataBits : std::uint32_t {
  kDataViewHeight = 1u << 0,
  kDataIdealPitch = 1u << 1,
  kDataPunch1 = 1u << 2,     // and the next two bits
  kDataVelocity1 = 1u << 5,  // and the next two bits
  kDataItems = 1u << 9,      // always sent
  kDataOnGround = 1u << 10,
  kDataInWater = 1u << 11,
  kDataWeaponFrame = 1u << 12,
  kDataArmor = 1u << 13,
  kDataWeapon = 1u << 14,
  kDataExtend1 = 1u << 15,
  kDataWeapon2 = 1u << 16,
  kDataArmor2 = 1u << 17,
  kDataAmmo2 = 1u << 18,
  kDataShells2 = 1u << 19,
  kDataNails2 = 1u << 20,
  kDataRockets2 = 1u << 21,
  kDataCells2 = 1u << 22,
  kDataExtend2 = 1u << 23,
  kDataWeaponFrame2 = 1u << 24,
  kDataWeaponAlpha = 1u << 25,
  kDataOnElevator = 1u << 26,
};

enum SoundBits : std::uint32_t {
  kSoundVolume = 1u << 0,
  kSoundAttenuation = 1u << 1,
  kSoundLargeEntity = 1u << 3,
  kSoundLargeSound = 1u << 4,
};

enum BaselineBits : std::uint32_t {
  kBaselineLargeModel = 1u << 0,
  kBaselineLargeFrame = 1u << 1,
  kBaselineAlpha = 1u << 2,
  kBaselineScale = 1u << 3,
};

enum class TempEntityType : std::uint8_t {
  kSpike = 0,
  kSuperSpike = 1,
  kGunshot = 2,
  kExplosion = 3,
  kTarExplosion = 4,
  kLightning1 = 5,
  kLightning2 = 6,
  kWizSpike = 7,
  kKnightSpike = 8,
  kLightning3 = 9,
  kLavaSplash = 10,
  kTeleport = 11,
  kExplosion2 = 12,
  kBeam = 13,
};
constexpr bool is_beam(TempEntityType type) {
  return type == TempEntityType::kLightning1 || type == TempEntityType::kLightning2 ||
         type == TempEntityType::kLightning3 || type == TempEntityType::kBeam;
}

// An entity's alpha and scale are bytes: alpha 0 means "as the model has it", 1 invisible, 255 opaque; scale is in
// sixteenths.
constexpr int kAlphaDefault = 0, kAlphaZero = 1, kAlphaOne = 255;
constexpr int kScaleDefault = 16;
float decode_alpha(int alpha);
int encode_alpha(float alpha);
int encode_scale(float scale);  // a value that is not positive is not sent
inline float decode_scale(int scale) { return static_cast<float>(scale) / 16.0f; }

// The statistics of a player and the level that svc_updatestat and svc_clientdata carry.
enum Stat : int {
  kStatHealth = 0,
  kStatFrags = 1,
  kStatWeapon = 2,
  kStatAmmo = 3,
  kStatArmor = 4,
  kStatWeaponFrame = 5,
  kStatShells = 6,
  kStatNails = 7,
  kStatRockets = 8,
  kStatCells = 9,
  kStatActiveWeapon = 10,
  kStatTotalSecrets = 11,
  kStatTotalMonsters = 12,
  kStatSecrets = 13,
  kStatMonsters = 14,
  // No message carries these as such: a client makes them of svc_clientdata, for status bars of mods.
  kStatItems = 15,
  kStatViewHeight = 16,
  kStatIdealPitch = 25,
  kStatPunchPitch = 26,  // and yaw and roll
};

constexpr int kDefaultViewHeight = 22;
constexpr int kMaxStats = 32, kMaxLightStyles = 64, kMaxClients = 16;
constexpr int kMaxEntities = 32768;          // entity numbers are below
constexpr std::size_t kMaxPrecaches = 8192;  // models, and sounds

}  // namespace fb::net
