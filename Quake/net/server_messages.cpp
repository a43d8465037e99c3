// The codec. Most messages are a plain sequence of fields: `fields()` lists them once, for reading and for writing.
// Those whose shape depends on their values (updates, client data, sounds, baselines, serverinfo, temp entities) have
// a function each way.
#include "net/server_messages.h"

#include <fmt/format.h>

#include <type_traits>

#include "net/state_codec.h"

namespace fb::net {
namespace {

// The two directions of a field list.
struct Reading {
  MessageReader& r;
  void u8(int& v) { v = r.u8(); }
  void i16(int& v) { v = r.i16(); }
  void i32(std::int32_t& v) { v = r.i32(); }
  void f32(float& v) { v = r.f32(); }
  void flag(bool& v) { v = r.u8() != 0; }
  void coords(vec3& v) { v = r.coords(); }
  void angles(vec3& v) { v = r.angles(); }
  void i8(int& v) { v = r.i8(); }
  void text(std::string& v) { v = r.string(); }
};
struct Writing {
  MessageWriter& w;
  void u8(const int& v) { w.u8(v); }
  void i8(const int& v) { w.i8(v); }
  void i16(const int& v) { w.i16(v); }
  void i32(const std::int32_t& v) { w.i32(v); }
  void f32(const float& v) { w.f32(v); }
  void flag(const bool& v) { w.u8(v ? 1 : 0); }
  void coords(const vec3& v) { w.coords(v); }
  void angles(const vec3& v) { w.angles(v); }
  void text(const std::string& v) { w.string(v); }
};

// M is const when writing.
template <typename Direction, typename M>
void fields(Direction d, M& m) {
  using T = std::remove_const_t<M>;
  if constexpr (std::is_same_v<T, svc::UpdateStat>) {
    d.u8(m.stat);
    d.i32(m.value);
  } else if constexpr (std::is_same_v<T, svc::Version>) {
    d.i32(m.version);
  } else if constexpr (std::is_same_v<T, svc::SetView>) {
    d.i16(m.entity);
  } else if constexpr (std::is_same_v<T, svc::Time>) {
    d.f32(m.time);
  } else if constexpr (std::is_same_v<T, svc::Print> || std::is_same_v<T, svc::StuffText> ||
                       std::is_same_v<T, svc::CenterPrint> || std::is_same_v<T, svc::Finale> ||
                       std::is_same_v<T, svc::Cutscene>) {
    d.text(m.text);
  } else if constexpr (std::is_same_v<T, svc::SetAngle>) {
    d.angles(m.angles);
  } else if constexpr (std::is_same_v<T, svc::LightStyle>) {
    d.u8(m.style);
    d.text(m.pattern);
  } else if constexpr (std::is_same_v<T, svc::UpdateName>) {
    d.u8(m.client);
    d.text(m.name);
  } else if constexpr (std::is_same_v<T, svc::UpdateFrags>) {
    d.u8(m.client);
    d.i16(m.frags);
  } else if constexpr (std::is_same_v<T, svc::UpdateColors>) {
    d.u8(m.client);
    d.u8(m.colors);
  } else if constexpr (std::is_same_v<T, svc::Particle>) {
    d.coords(m.origin);
    for (auto& c : m.direction) d.i8(c);
    d.u8(m.count);
    d.u8(m.color);
  } else if constexpr (std::is_same_v<T, svc::Damage>) {
    d.u8(m.armor);
    d.u8(m.blood);
    d.coords(m.from);
  } else if constexpr (std::is_same_v<T, svc::SetPause>) {
    d.flag(m.paused);
  } else if constexpr (std::is_same_v<T, svc::SignonNum>) {
    d.u8(m.signon);
  } else if constexpr (std::is_same_v<T, svc::CdTrack>) {
    d.u8(m.track);
    d.u8(m.loop_track);
  } else if constexpr (std::is_same_v<T, svc::Skybox>) {
    d.text(m.name);
  } else if constexpr (std::is_same_v<T, svc::Fog>) {
    d.u8(m.density);
    d.u8(m.red);
    d.u8(m.green);
    d.u8(m.blue);
    d.i16(m.fade);
  } else {
    static_assert(std::is_empty_v<T>, "a message with fields that are not listed");
  }
}

template <typename T>
T read_fields(MessageReader& reader) {
  T message;
  fields(Reading{reader}, message);
  return message;
}

// --- sounds ----------------------------------------------------------------------------------------------------------

svc::Sound read_sound(MessageReader& r) {
  svc::Sound s;
  const auto bits = static_cast<std::uint32_t>(r.u8());
  if (bits & kSoundVolume) s.volume = r.u8();
  if (bits & kSoundAttenuation) s.attenuation = r.u8();
  if (bits & kSoundLargeEntity) {
    s.entity = r.u16();
    s.channel = r.u8();
  } else {
    const int both = r.u16();
    s.entity = both >> 3;
    s.channel = both & 7;
  }
  s.sound = bits & kSoundLargeSound ? r.u16() : r.u8();
  s.origin = r.coords();
  return s;
}

void write_sound(MessageWriter& w, const svc::Sound& s) {
  std::uint32_t bits = 0;
  if (s.volume != 255) bits |= kSoundVolume;
  if (s.attenuation != 64) bits |= kSoundAttenuation;
  if (w.protocol.extended()) {
    if (s.entity >= 8192 || s.channel >= 8) bits |= kSoundLargeEntity;
    if (s.sound > 255) bits |= kSoundLargeSound;
  }
  w.u8(static_cast<int>(Svc::kSound));
  w.u8(static_cast<int>(bits));
  if (bits & kSoundVolume) w.u8(s.volume);
  if (bits & kSoundAttenuation) w.u8(s.attenuation);
  if (bits & kSoundLargeEntity) {
    w.u16(s.entity);
    w.u8(s.channel);
  } else {
    w.u16((s.entity << 3) | (s.channel & 7));
  }
  if (bits & kSoundLargeSound)
    w.u16(s.sound);
  else
    w.u8(s.sound);
  w.coords(s.origin);
}

// --- the rest --------------------------------------------------------------------------------------------------------

bool is_beam(TempEntityType type) {
  return type == TempEntityType::kLightning1 || type == TempEntityType::kLightning2 ||
         type == TempEntityType::kLightning3 || type == TempEntityType::kBeam;
}

void write_command(MessageWriter& w, Svc command) { w.u8(static_cast<int>(command)); }

// The command of a plain message.
template <typename T>
constexpr Svc command_of() {
  if constexpr (std::is_same_v<T, svc::Nop>) return Svc::kNop;
  if constexpr (std::is_same_v<T, svc::Disconnect>) return Svc::kDisconnect;
  if constexpr (std::is_same_v<T, svc::UpdateStat>) return Svc::kUpdateStat;
  if constexpr (std::is_same_v<T, svc::Version>) return Svc::kVersion;
  if constexpr (std::is_same_v<T, svc::SetView>) return Svc::kSetView;
  if constexpr (std::is_same_v<T, svc::Time>) return Svc::kTime;
  if constexpr (std::is_same_v<T, svc::Print>) return Svc::kPrint;
  if constexpr (std::is_same_v<T, svc::StuffText>) return Svc::kStuffText;
  if constexpr (std::is_same_v<T, svc::SetAngle>) return Svc::kSetAngle;
  if constexpr (std::is_same_v<T, svc::LightStyle>) return Svc::kLightStyle;
  if constexpr (std::is_same_v<T, svc::UpdateName>) return Svc::kUpdateName;
  if constexpr (std::is_same_v<T, svc::UpdateFrags>) return Svc::kUpdateFrags;
  if constexpr (std::is_same_v<T, svc::UpdateColors>) return Svc::kUpdateColors;
  if constexpr (std::is_same_v<T, svc::Particle>) return Svc::kParticle;
  if constexpr (std::is_same_v<T, svc::Damage>) return Svc::kDamage;
  if constexpr (std::is_same_v<T, svc::SetPause>) return Svc::kSetPause;
  if constexpr (std::is_same_v<T, svc::SignonNum>) return Svc::kSignonNum;
  if constexpr (std::is_same_v<T, svc::CenterPrint>) return Svc::kCenterPrint;
  if constexpr (std::is_same_v<T, svc::KilledMonster>) return Svc::kKilledMonster;
  if constexpr (std::is_same_v<T, svc::FoundSecret>) return Svc::kFoundSecret;
  if constexpr (std::is_same_v<T, svc::Intermission>) return Svc::kIntermission;
  if constexpr (std::is_same_v<T, svc::Finale>) return Svc::kFinale;
  if constexpr (std::is_same_v<T, svc::CdTrack>) return Svc::kCdTrack;
  if constexpr (std::is_same_v<T, svc::SellScreen>) return Svc::kSellScreen;
  if constexpr (std::is_same_v<T, svc::Cutscene>) return Svc::kCutscene;
  if constexpr (std::is_same_v<T, svc::Skybox>) return Svc::kSkybox;
  if constexpr (std::is_same_v<T, svc::BonusFlash>) return Svc::kBonusFlash;
  if constexpr (std::is_same_v<T, svc::Fog>) return Svc::kFog;
  return Svc::kBad;
}

struct Write {
  MessageWriter& w;

  template <typename T>
  void operator()(const T& m) const {
    static_assert(command_of<T>() != Svc::kBad);
    write_command(w, command_of<T>());
    fields(Writing{w}, m);
  }
  void operator()(const svc::EntityUpdate& m) const { write_update(w, m); }
  void operator()(const svc::ClientData& m) const { write_client_data(w, m); }
  void operator()(const svc::Sound& m) const { write_sound(w, m); }
  void operator()(const svc::StopSound& m) const {
    write_command(w, Svc::kStopSound);
    w.i16((m.entity << 3) | (m.channel & 7));
  }
  void operator()(const svc::ServerInfo& m) const {
    write_command(w, Svc::kServerInfo);
    w.i32(m.protocol.version);
    if (m.protocol.version == kProtocolRmq) w.i32(static_cast<std::int32_t>(m.protocol.flags));
    w.u8(m.max_clients);
    w.u8(m.game_type);
    w.string(m.level_name);
    for (const auto* list : {&m.models, &m.sounds}) {
      for (const std::string& name : *list) w.string(name);
      w.u8(0);
    }
    w.protocol = m.protocol;
  }
  void operator()(const svc::SpawnStatic& m) const {
    write_command(w, m.extended ? Svc::kSpawnStatic2 : Svc::kSpawnStatic);
    write_baseline(w, m.state, m.extended);
  }
  void operator()(const svc::SpawnBaseline& m) const {
    write_command(w, m.extended ? Svc::kSpawnBaseline2 : Svc::kSpawnBaseline);
    w.i16(m.entity);
    write_baseline(w, m.state, m.extended);
  }
  void operator()(const svc::SpawnStaticSound& m) const {
    write_command(w, m.extended ? Svc::kSpawnStaticSound2 : Svc::kSpawnStaticSound);
    w.coords(m.origin);
    if (m.extended)
      w.u16(m.sound);
    else
      w.u8(m.sound);
    w.u8(m.volume);
    w.u8(m.attenuation);
  }
  void operator()(const svc::TempEntity& m) const {
    write_command(w, Svc::kTempEntity);
    w.u8(static_cast<int>(m.type));
    if (is_beam(m.type)) {
      w.i16(m.entity);
      w.coords(m.origin);
      w.coords(m.end);
      return;
    }
    w.coords(m.origin);
    if (m.type == TempEntityType::kExplosion2) {
      w.u8(m.color_start);
      w.u8(m.color_length);
    }
  }
};

// The error for an unknown protocol or too many precaches; empty if valid.
std::string read_server_info(MessageReader& r, svc::ServerInfo& m) {
  m.protocol.version = r.i32();
  if (r.failed()) return {};
  if (!is_known_protocol(m.protocol.version))
    return fmt::format("the server speaks protocol {}, not 15, 666 or 999", m.protocol.version);
  if (m.protocol.version == kProtocolRmq) m.protocol.flags = static_cast<std::uint32_t>(r.i32());
  r.protocol = m.protocol;
  m.max_clients = r.u8();
  m.game_type = r.u8();
  m.level_name = r.string();
  for (auto* list : {&m.models, &m.sounds}) {
    while (true) {
      std::string name = r.string();
      if (name.empty()) break;
      if (list->size() + 1 == kMaxPrecaches) return fmt::format("more than {} precaches", kMaxPrecaches - 1);
      list->push_back(std::move(name));
    }
  }
  if (!r.failed() && (m.max_clients < 1 || m.max_clients > kMaxClients))
    return fmt::format("{} players, not 1 to {}", m.max_clients, kMaxClients);
  return {};
}

std::string read_temp_entity(MessageReader& r, svc::TempEntity& m) {
  const int type = r.u8();
  if (type > static_cast<int>(TempEntityType::kBeam)) return fmt::format("temporary entity {} is unknown", type);
  m.type = static_cast<TempEntityType>(type);
  if (is_beam(m.type)) {
    m.entity = r.i16();
    m.origin = r.coords();
    m.end = r.coords();
    return {};
  }
  m.origin = r.coords();
  if (m.type == TempEntityType::kExplosion2) {
    m.color_start = r.u8();
    m.color_length = r.u8();
  }
  return {};
}

}  // namespace

Error ServerMessageReader::error(std::string_view cause) const {
  return reader_.error_at(start_,
                          fmt::format("{} (after {}): {}", svc_name(command_), svc_name(previous_command_), cause));
}

Result<ServerMessage> ServerMessageReader::next() {
  MessageReader& r = reader_;
  previous_command_ = command_;
  start_ = r.offset();
  command_ = static_cast<unsigned>(r.u8());
  ServerMessage message;
  std::string cause;
  if (command_ & kUpdateSignal) {
    message = read_update(r, command_);
  } else {
    switch (static_cast<Svc>(command_)) {
      case Svc::kNop:
        message = svc::Nop{};
        break;
      case Svc::kDisconnect:
        message = svc::Disconnect{};
        break;
      case Svc::kUpdateStat:
        message = read_fields<svc::UpdateStat>(r);
        break;
      case Svc::kVersion: {
        const auto version = read_fields<svc::Version>(r);
        if (!is_known_protocol(version.version))
          cause = fmt::format("the server speaks protocol {}, not 15, 666 or 999", version.version);
        else
          r.protocol.version = version.version;
        message = version;
        break;
      }
      case Svc::kSetView:
        message = read_fields<svc::SetView>(r);
        break;
      case Svc::kSound:
        message = read_sound(r);
        break;
      case Svc::kTime:
        message = read_fields<svc::Time>(r);
        break;
      case Svc::kPrint:
        message = read_fields<svc::Print>(r);
        break;
      case Svc::kStuffText:
        message = read_fields<svc::StuffText>(r);
        break;
      case Svc::kSetAngle:
        message = read_fields<svc::SetAngle>(r);
        break;
      case Svc::kServerInfo: {
        svc::ServerInfo info;
        cause = read_server_info(r, info);
        message = std::move(info);
        break;
      }
      case Svc::kLightStyle:
        message = read_fields<svc::LightStyle>(r);
        break;
      case Svc::kUpdateName:
        message = read_fields<svc::UpdateName>(r);
        break;
      case Svc::kUpdateFrags:
        message = read_fields<svc::UpdateFrags>(r);
        break;
      case Svc::kClientData:
        message = read_client_data(r);
        break;
      case Svc::kStopSound: {
        const int both = r.u16();
        message = svc::StopSound{both >> 3, both & 7};
        break;
      }
      case Svc::kUpdateColors:
        message = read_fields<svc::UpdateColors>(r);
        break;
      case Svc::kParticle:
        message = read_fields<svc::Particle>(r);
        break;
      case Svc::kDamage:
        message = read_fields<svc::Damage>(r);
        break;
      case Svc::kSpawnStatic:
        message = svc::SpawnStatic{read_baseline(r, false), false};
        break;
      case Svc::kSpawnStatic2:
        message = svc::SpawnStatic{read_baseline(r, true), true};
        break;
      case Svc::kSpawnBaseline:
      case Svc::kSpawnBaseline2: {
        svc::SpawnBaseline baseline;
        baseline.extended = static_cast<Svc>(command_) == Svc::kSpawnBaseline2;
        baseline.entity = r.i16();
        baseline.state = read_baseline(r, baseline.extended);
        message = baseline;
        break;
      }
      case Svc::kTempEntity: {
        svc::TempEntity entity;
        cause = read_temp_entity(r, entity);
        message = entity;
        break;
      }
      case Svc::kSetPause:
        message = read_fields<svc::SetPause>(r);
        break;
      case Svc::kSignonNum:
        message = read_fields<svc::SignonNum>(r);
        break;
      case Svc::kCenterPrint:
        message = read_fields<svc::CenterPrint>(r);
        break;
      case Svc::kKilledMonster:
        message = svc::KilledMonster{};
        break;
      case Svc::kFoundSecret:
        message = svc::FoundSecret{};
        break;
      case Svc::kSpawnStaticSound:
      case Svc::kSpawnStaticSound2: {
        svc::SpawnStaticSound sound;
        sound.extended = static_cast<Svc>(command_) == Svc::kSpawnStaticSound2;
        sound.origin = r.coords();
        sound.sound = sound.extended ? r.u16() : r.u8();
        sound.volume = r.u8();
        sound.attenuation = r.u8();
        message = sound;
        break;
      }
      case Svc::kIntermission:
        message = svc::Intermission{};
        break;
      case Svc::kFinale:
        message = read_fields<svc::Finale>(r);
        break;
      case Svc::kCdTrack:
        message = read_fields<svc::CdTrack>(r);
        break;
      case Svc::kSellScreen:
        message = svc::SellScreen{};
        break;
      case Svc::kCutscene:
        message = read_fields<svc::Cutscene>(r);
        break;
      case Svc::kSkybox:
        message = read_fields<svc::Skybox>(r);
        break;
      case Svc::kBonusFlash:
        message = svc::BonusFlash{};
        break;
      case Svc::kFog:
        message = read_fields<svc::Fog>(r);
        break;
      default:
        return error(fmt::format("command {} is unknown", command_));
    }
  }
  if (!cause.empty()) return error(cause);
  if (r.not_finite()) return error("a number is not finite");
  if (r.failed()) return error("the message is cut short");
  return message;
}

void write_server_message(MessageWriter& writer, const ServerMessage& message) { std::visit(Write{writer}, message); }

}  // namespace fb::net
