// Messages from server to client: one struct for each message, and the codec between structs and bytes. The structs
// hold decoded values; the codec handles the bits that announce them. Reading trusts nothing: a message that is
// truncated, unknown or out of its limits is an Error that names the message, its offset and the message before it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "net/message.h"
#include "net/protocol.h"

namespace fb::net {

// A baseline's values, to which updates are relative.
struct EntityState {
  vec3 origin{0.0f}, angles{0.0f};  // units, degrees
  int model = 0, frame = 0;         // model: index of the precache list, 0 none
  int colormap = 0, skin = 0, effects = 0;
  int alpha = kAlphaDefault, scale = kScaleDefault;
  bool operator==(const EntityState&) const = default;
};

namespace svc {

struct Nop {
  bool operator==(const Nop&) const = default;
};
struct Disconnect {
  bool operator==(const Disconnect&) const = default;
};
struct UpdateStat {
  int stat = 0;
  std::int32_t value = 0;
  bool operator==(const UpdateStat&) const = default;
};
struct Version {
  std::int32_t version = kProtocolNetQuake;
  bool operator==(const Version&) const = default;
};
struct SetView {
  int entity = 0;
  bool operator==(const SetView&) const = default;
};
struct Sound {
  int entity = 0, channel = 0, sound = 0;
  int volume = 255;      // of 255
  int attenuation = 64;  // in 64ths
  vec3 origin{0.0f};
  bool operator==(const Sound&) const = default;
};
struct Time {
  float time = 0.0f;  // seconds
  bool operator==(const Time&) const = default;
};
struct Print {
  std::string text;
  bool operator==(const Print&) const = default;
};
struct StuffText {
  std::string text;
  bool operator==(const StuffText&) const = default;
};
struct SetAngle {
  vec3 angles{0.0f};
  bool operator==(const SetAngle&) const = default;
};
struct ServerInfo {
  Protocol protocol;
  int max_clients = 1;
  int game_type = 0;  // 0 cooperative, 1 deathmatch
  std::string level_name;
  std::vector<std::string> models, sounds;  // [i] is precache i + 1
  bool operator==(const ServerInfo&) const = default;
};
struct LightStyle {
  int style = 0;
  std::string pattern;  // letters 'a' (dark) to 'z', ten a second
  bool operator==(const LightStyle&) const = default;
};
struct UpdateName {
  int client = 0;
  std::string name;
  bool operator==(const UpdateName&) const = default;
};
struct UpdateFrags {
  int client = 0, frags = 0;
  bool operator==(const UpdateFrags&) const = default;
};
struct UpdateColors {
  int client = 0, colors = 0;  // 16 * shirt + trousers
  bool operator==(const UpdateColors&) const = default;
};
struct ClientData {
  int view_height = kDefaultViewHeight, ideal_pitch = 0;
  std::array<int, 3> punch{};     // degrees
  std::array<int, 3> velocity{};  // in 16 units a second
  std::int32_t items = 0;
  bool on_ground = false, in_water = false, on_elevator = false;
  int weapon_frame = 0, armor = 0, weapon = 0, health = 0;
  int ammo = 0;                      // of the weapon in hand
  std::array<int, 4> ammo_counts{};  // shells, nails, rockets, cells
  int active_weapon = 0;
  int weapon_alpha = kAlphaDefault;
  bool operator==(const ClientData&) const = default;
};
struct StopSound {
  int entity = 0, channel = 0;
  bool operator==(const StopSound&) const = default;
};
struct Particle {
  vec3 origin{0.0f};
  std::array<int, 3> direction{};  // in 16ths
  int count = 0, color = 0;
  bool operator==(const Particle&) const = default;
};
struct Damage {
  int armor = 0, blood = 0;
  vec3 from{0.0f};
  bool operator==(const Damage&) const = default;
};
struct SpawnStatic {
  EntityState state;
  bool extended = false;  // svc_spawnstatic2: wide model and frame, alpha, scale
  bool operator==(const SpawnStatic&) const = default;
};
struct SpawnBaseline {
  int entity = 0;
  EntityState state;
  bool extended = false;  // svc_spawnbaseline2
  bool operator==(const SpawnBaseline&) const = default;
};
struct TempEntity {
  TempEntityType type = TempEntityType::kSpike;
  vec3 origin{0.0f};
  int entity = 0;                         // beams: the entity that fires
  vec3 end{0.0f};                         // beams
  int color_start = 0, color_length = 1;  // kExplosion2
  bool operator==(const TempEntity&) const = default;
};
struct SetPause {
  bool paused = false;
  bool operator==(const SetPause&) const = default;
};
struct SignonNum {
  int signon = 0;
  bool operator==(const SignonNum&) const = default;
};
struct CenterPrint {
  std::string text;
  bool operator==(const CenterPrint&) const = default;
};
struct KilledMonster {
  bool operator==(const KilledMonster&) const = default;
};
struct FoundSecret {
  bool operator==(const FoundSecret&) const = default;
};
struct SpawnStaticSound {
  vec3 origin{0.0f};
  int sound = 0, volume = 0, attenuation = 0;
  bool extended = false;  // svc_spawnstaticsound2: wide sound
  bool operator==(const SpawnStaticSound&) const = default;
};
struct Intermission {
  bool operator==(const Intermission&) const = default;
};
struct Finale {
  std::string text;
  bool operator==(const Finale&) const = default;
};
struct CdTrack {
  int track = 0, loop_track = 0;
  bool operator==(const CdTrack&) const = default;
};
struct SellScreen {
  bool operator==(const SellScreen&) const = default;
};
struct Cutscene {
  std::string text;
  bool operator==(const Cutscene&) const = default;
};
struct Skybox {
  std::string name;
  bool operator==(const Skybox&) const = default;
};
struct BonusFlash {
  bool operator==(const BonusFlash&) const = default;
};
struct Fog {
  int density = 0, red = 0, green = 0, blue = 0;  // of 255
  int fade = 0;                                   // hundredths of a second
  bool operator==(const Fog&) const = default;
};
// The fields that differ from the baseline; `bits` says which are valid (kUpdateOrigin1 ... kUpdateScale). The writer
// sets the bits that only affect the encoding (more bits, long entity, extend, frame2, model2); the reader reports
// them.
struct EntityUpdate {
  std::uint32_t bits = 0;  // UpdateBits
  int entity = 0;
  vec3 origin{0.0f}, angles{0.0f};
  int model = 0, frame = 0, colormap = 0, skin = 0, effects = 0;
  int alpha = kAlphaDefault, scale = kScaleDefault;
  int lerp_finish = 0;  // 255ths of a second until the server moves the entity again
  bool operator==(const EntityUpdate&) const = default;
};

}  // namespace svc

using ServerMessage =
    std::variant<svc::Nop, svc::Disconnect, svc::UpdateStat, svc::Version, svc::SetView, svc::Sound, svc::Time,
                 svc::Print, svc::StuffText, svc::SetAngle, svc::ServerInfo, svc::LightStyle, svc::UpdateName,
                 svc::UpdateFrags, svc::UpdateColors, svc::ClientData, svc::StopSound, svc::Particle, svc::Damage,
                 svc::SpawnStatic, svc::SpawnBaseline, svc::TempEntity, svc::SetPause, svc::SignonNum, svc::CenterPrint,
                 svc::KilledMonster, svc::FoundSecret, svc::SpawnStaticSound, svc::Intermission, svc::Finale,
                 svc::CdTrack, svc::SellScreen, svc::Cutscene, svc::Skybox, svc::BonusFlash, svc::Fog,
                 svc::EntityUpdate>;

// Reads a datagram's messages one after the other. svc_serverinfo changes the protocol for the messages after it.
class ServerMessageReader {
 public:
  ServerMessageReader(ByteView data, std::string_view name, Protocol protocol = {}) : reader_(data, name, protocol) {}
  bool at_end() const { return reader_.at_end(); }
  std::size_t offset() const { return reader_.offset(); }
  Result<ServerMessage> next();
  const Protocol& protocol() const { return reader_.protocol; }
  // The offset of the message that next() returned last, for the receiver's errors.
  Error error(std::string_view cause) const;

 private:
  MessageReader reader_;
  std::size_t start_ = 0;
  unsigned command_ = 0, previous_command_ = 0;
};

// Appends the message. Values that the writer's protocol cannot carry are lost (alpha in protocol 15, say).
void write_server_message(MessageWriter& writer, const ServerMessage& message);

}  // namespace fb::net
