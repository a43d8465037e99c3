// Messages from server to client: one struct for each message, with its command and its fields in their order on the
// wire (fields.h), and the codec between structs and bytes. The structs hold decoded values; the codec handles the bits
// that announce them. Reading trusts nothing: a message that is truncated, unknown or out of its limits is an Error
// that names the message, its offset and the message before it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
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
  static constexpr Command kCommand{1, "svc_nop"};
  bool operator==(const Nop&) const = default;
};
struct Disconnect {
  static constexpr Command kCommand{2, "svc_disconnect"};
  bool operator==(const Disconnect&) const = default;
};
struct UpdateStat {
  static constexpr Command kCommand{3, "svc_updatestat"};
  int stat = 0;  // Stat
  std::int32_t value = 0;
  static void fields(auto& m, auto& wire) {
    wire.u8(m.stat);
    wire.i32(m.value);
  }
  bool operator==(const UpdateStat&) const = default;
};
struct Version {
  static constexpr Command kCommand{4, "svc_version"};
  std::int32_t version = kProtocolNetQuake;
  static void fields(auto& m, auto& wire) { wire.i32(m.version); }
  bool operator==(const Version&) const = default;
};
struct SetView {
  static constexpr Command kCommand{5, "svc_setview"};
  int entity = 0;
  static void fields(auto& m, auto& wire) { wire.i16(m.entity); }
  bool operator==(const SetView&) const = default;
};
struct Sound {
  static constexpr Command kCommand{6, "svc_sound"};
  int entity = 0, channel = 0, sound = 0;
  int volume = 255;      // of 255
  int attenuation = 64;  // in 64ths
  vec3 origin{0.0f};
  bool operator==(const Sound&) const = default;
};
struct Time {
  static constexpr Command kCommand{7, "svc_time"};
  float time = 0.0f;  // seconds
  static void fields(auto& m, auto& wire) { wire.f32(m.time); }
  bool operator==(const Time&) const = default;
};
struct Print {
  static constexpr Command kCommand{8, "svc_print"};
  std::string text;
  static void fields(auto& m, auto& wire) { wire.text(m.text); }
  bool operator==(const Print&) const = default;
};
struct StuffText {
  static constexpr Command kCommand{9, "svc_stufftext"};
  std::string text;
  static void fields(auto& m, auto& wire) { wire.text(m.text); }
  bool operator==(const StuffText&) const = default;
};
struct SetAngle {
  static constexpr Command kCommand{10, "svc_setangle"};
  vec3 angles{0.0f};
  static void fields(auto& m, auto& wire) { wire.angles(m.angles); }
  bool operator==(const SetAngle&) const = default;
};
struct ServerInfo {
  static constexpr Command kCommand{11, "svc_serverinfo"};
  Protocol protocol;
  int max_clients = 1;
  int game_type = 0;  // 0 cooperative, 1 deathmatch
  std::string level_name;
  std::vector<std::string> models, sounds;  // [i] is precache i + 1
  bool operator==(const ServerInfo&) const = default;
};
struct LightStyle {
  static constexpr Command kCommand{12, "svc_lightstyle"};
  int style = 0;
  std::string pattern;  // letters 'a' (dark) to 'z', ten a second
  static void fields(auto& m, auto& wire) {
    wire.u8(m.style);
    wire.text(m.pattern);
  }
  bool operator==(const LightStyle&) const = default;
};
struct UpdateName {
  static constexpr Command kCommand{13, "svc_updatename"};
  int client = 0;
  std::string name;
  static void fields(auto& m, auto& wire) {
    wire.u8(m.client);
    wire.text(m.name);
  }
  bool operator==(const UpdateName&) const = default;
};
struct UpdateFrags {
  static constexpr Command kCommand{14, "svc_updatefrags"};
  int client = 0, frags = 0;
  static void fields(auto& m, auto& wire) {
    wire.u8(m.client);
    wire.i16(m.frags);
  }
  bool operator==(const UpdateFrags&) const = default;
};
struct UpdateColors {
  static constexpr Command kCommand{17, "svc_updatecolors"};
  int client = 0, colors = 0;  // 16 * shirt + trousers
  static void fields(auto& m, auto& wire) {
    wire.u8(m.client);
    wire.u8(m.colors);
  }
  bool operator==(const UpdateColors&) const = default;
};
struct ClientData {
  static constexpr Command kCommand{15, "svc_clientdata"};
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
  static constexpr Command kCommand{16, "svc_stopsound"};
  int entity = 0, channel = 0;
  static void fields(auto& m, auto& wire) { wire.entity_channel(m.entity, m.channel); }
  bool operator==(const StopSound&) const = default;
};
struct Particle {
  static constexpr Command kCommand{18, "svc_particle"};
  vec3 origin{0.0f};
  std::array<int, 3> direction{};  // in 16ths
  int count = 0, color = 0;
  static void fields(auto& m, auto& wire) {
    wire.coords(m.origin);
    for (auto& d : m.direction) wire.i8(d);
    wire.u8(m.count);
    wire.u8(m.color);
  }
  bool operator==(const Particle&) const = default;
};
struct Damage {
  static constexpr Command kCommand{19, "svc_damage"};
  int armor = 0, blood = 0;
  vec3 from{0.0f};
  static void fields(auto& m, auto& wire) {
    wire.u8(m.armor);
    wire.u8(m.blood);
    wire.coords(m.from);
  }
  bool operator==(const Damage&) const = default;
};
struct SpawnStatic {
  static constexpr Command kCommand{20, "svc_spawnstatic"};
  static constexpr Command kExtendedCommand{43, "svc_spawnstatic2"};
  EntityState state;
  bool extended = false;  // svc_spawnstatic2: wide model and frame, alpha, scale
  static void fields(auto& m, auto& wire) { wire.state(m.state, m.extended); }
  bool operator==(const SpawnStatic&) const = default;
};
struct SpawnBaseline {
  static constexpr Command kCommand{22, "svc_spawnbaseline"};
  static constexpr Command kExtendedCommand{42, "svc_spawnbaseline2"};
  int entity = 0;
  EntityState state;
  bool extended = false;  // svc_spawnbaseline2
  static void fields(auto& m, auto& wire) {
    wire.i16(m.entity);
    wire.state(m.state, m.extended);
  }
  bool operator==(const SpawnBaseline&) const = default;
};
struct TempEntity {
  static constexpr Command kCommand{23, "svc_temp_entity"};
  TempEntityType type = TempEntityType::kSpike;
  vec3 origin{0.0f};
  int entity = 0;                         // beams: the entity that fires
  vec3 end{0.0f};                         // beams
  int color_start = 0, color_length = 1;  // kExplosion2
  static void fields(auto& m, auto& wire) {
    wire.one_of(m.type);
    if (is_beam(m.type)) wire.i16(m.entity);
    wire.coords(m.origin);
    if (is_beam(m.type)) wire.coords(m.end);
    if (m.type == TempEntityType::kExplosion2) {
      wire.u8(m.color_start);
      wire.u8(m.color_length);
    }
  }
  bool operator==(const TempEntity&) const = default;
};
struct SetPause {
  static constexpr Command kCommand{24, "svc_setpause"};
  bool paused = false;
  static void fields(auto& m, auto& wire) { wire.flag(m.paused); }
  bool operator==(const SetPause&) const = default;
};
struct SignonNum {
  static constexpr Command kCommand{25, "svc_signonnum"};
  int signon = 0;
  static void fields(auto& m, auto& wire) { wire.u8(m.signon); }
  bool operator==(const SignonNum&) const = default;
};
struct CenterPrint {
  static constexpr Command kCommand{26, "svc_centerprint"};
  std::string text;
  static void fields(auto& m, auto& wire) { wire.text(m.text); }
  bool operator==(const CenterPrint&) const = default;
};
struct KilledMonster {
  static constexpr Command kCommand{27, "svc_killedmonster"};
  bool operator==(const KilledMonster&) const = default;
};
struct FoundSecret {
  static constexpr Command kCommand{28, "svc_foundsecret"};
  bool operator==(const FoundSecret&) const = default;
};
struct SpawnStaticSound {
  static constexpr Command kCommand{29, "svc_spawnstaticsound"};
  static constexpr Command kExtendedCommand{44, "svc_spawnstaticsound2"};
  vec3 origin{0.0f};
  int sound = 0, volume = 0, attenuation = 0;
  bool extended = false;  // svc_spawnstaticsound2: wide sound
  static void fields(auto& m, auto& wire) {
    wire.coords(m.origin);
    if (m.extended)
      wire.u16(m.sound);
    else
      wire.u8(m.sound);
    wire.u8(m.volume);
    wire.u8(m.attenuation);
  }
  bool operator==(const SpawnStaticSound&) const = default;
};
struct Intermission {
  static constexpr Command kCommand{30, "svc_intermission"};
  bool operator==(const Intermission&) const = default;
};
struct Finale {
  static constexpr Command kCommand{31, "svc_finale"};
  std::string text;
  static void fields(auto& m, auto& wire) { wire.text(m.text); }
  bool operator==(const Finale&) const = default;
};
struct CdTrack {
  static constexpr Command kCommand{32, "svc_cdtrack"};
  int track = 0, loop_track = 0;
  static void fields(auto& m, auto& wire) {
    wire.u8(m.track);
    wire.u8(m.loop_track);
  }
  bool operator==(const CdTrack&) const = default;
};
struct SellScreen {
  static constexpr Command kCommand{33, "svc_sellscreen"};
  bool operator==(const SellScreen&) const = default;
};
struct Cutscene {
  static constexpr Command kCommand{34, "svc_cutscene"};
  std::string text;
  static void fields(auto& m, auto& wire) { wire.text(m.text); }
  bool operator==(const Cutscene&) const = default;
};
struct Skybox {
  static constexpr Command kCommand{37, "svc_skybox"};
  std::string name;
  static void fields(auto& m, auto& wire) { wire.text(m.name); }
  bool operator==(const Skybox&) const = default;
};
struct BonusFlash {
  static constexpr Command kCommand{40, "svc_bf"};
  bool operator==(const BonusFlash&) const = default;
};
struct Fog {
  static constexpr Command kCommand{41, "svc_fog"};
  int density = 0, red = 0, green = 0, blue = 0;  // of 255
  int fade = 0;                                   // hundredths of a second
  static void fields(auto& m, auto& wire) {
    wire.u8(m.density);
    wire.u8(m.red);
    wire.u8(m.green);
    wire.u8(m.blue);
    wire.i16(m.fade);
  }
  bool operator==(const Fog&) const = default;
};
// The 2021 re-release's QuakeC sends this; here it means nothing.
struct Achievement {
  static constexpr Command kCommand{52, "svc_achievement"};
  std::string id;
  static void fields(auto& m, auto& wire) { wire.text(m.id); }
  bool operator==(const Achievement&) const = default;
};
// The re-release's, too: a sound for this player alone. `bits` says whether its number is wide (kSoundLargeSound).
struct LocalSound {
  static constexpr Command kCommand{56, "svc_localsound"};
  int bits = 0, sound = 0;
  static void fields(auto& m, auto& wire) {
    wire.u8(m.bits);
    if (static_cast<unsigned>(m.bits) & kSoundLargeSound)
      wire.u16(m.sound);
    else
      wire.u8(m.sound);
  }
  bool operator==(const LocalSound&) const = default;
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
                 svc::CdTrack, svc::SellScreen, svc::Cutscene, svc::Skybox, svc::BonusFlash, svc::Fog, svc::Achievement,
                 svc::LocalSound, svc::EntityUpdate>;

// "svc_time"; "fast update" from 128 on; "svc_?" for numbers that no protocol uses.
std::string_view svc_name(unsigned command);

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
