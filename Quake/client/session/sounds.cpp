#include "client/session/sounds.h"

#include <string>

#include "world/bsp_query.h"
#include "world/pvs.h"

namespace fb::cl {
namespace {

constexpr float kFullVolume = 255.0f, kAttenuationUnit = 64.0f;  // in messages

void tell(Session& session, const scene::SoundEvent& event) {
  session.sounds.remember(event, session.state.time);
  if (session.sound_listener && !session.quiet) session.sound_listener(event);
}

// Empty: the level has no such sound.
std::string sound_name(const Session& session, int sound) {
  const auto& names = session.state.sound_names;
  return sound > 0 && static_cast<std::size_t>(sound) < names.size() ? names[static_cast<std::size_t>(sound)] : "";
}

bool is_liquid(std::int32_t contents) {
  return contents == formats::kContentsWater || contents == formats::kContentsSlime ||
         contents == formats::kContentsLava;
}

// Of a spike on a wall: mostly a click, at times one of three ricochets.
const char* spike_sound(Rng& rng) {
  if (rng.below(5) != 0) return "weapons/tink1.wav";
  switch (rng.below(4)) {
    case 1:
      return "weapons/ric1.wav";
    case 2:
      return "weapons/ric2.wav";
    default:
      return "weapons/ric3.wav";
  }
}

// Null: it makes none.
const char* temp_entity_sound_name(net::TempEntityType type, Rng& rng) {
  switch (type) {
    case net::TempEntityType::kSpike:
    case net::TempEntityType::kSuperSpike:
      return spike_sound(rng);
    case net::TempEntityType::kWizSpike:
      return "wizard/hit.wav";
    case net::TempEntityType::kKnightSpike:
      return "hknight/hit.wav";
    case net::TempEntityType::kExplosion:
    case net::TempEntityType::kExplosion2:
    case net::TempEntityType::kTarExplosion:
      return "weapons/r_exp3.wav";
    default:
      return nullptr;
  }
}

}  // namespace

void apply_sound(Session& session, const net::svc::Sound& message) {
  const std::string name = sound_name(session, message.sound);
  if (name.empty()) return;
  tell(session, scene::SoundStart{name, message.entity, message.channel, message.origin,
                                  static_cast<float>(message.volume) / kFullVolume,
                                  static_cast<float>(message.attenuation) / kAttenuationUnit});
}

void apply_stop_sound(Session& session, const net::svc::StopSound& message) {
  tell(session, scene::SoundStop{message.entity, message.channel});
}

void apply_static_sound(Session& session, const net::svc::SpawnStaticSound& message) {
  const std::string name = sound_name(session, message.sound);
  if (name.empty()) return;
  tell(session, scene::SoundLoop{name, message.origin, static_cast<float>(message.volume) / kFullVolume,
                                 static_cast<float>(message.attenuation) / kAttenuationUnit});
}

void apply_track(Session& session, const net::svc::CdTrack& message) {
  session.state.music = {message.track, message.loop_track};
  tell(session, scene::SoundTrack{session.forced_track >= 0 ? session.forced_track : message.track});
}

void temp_entity_sound(Session& session, const net::svc::TempEntity& message) {
  const char* const name = temp_entity_sound_name(message.type, session.sound_rng);
  if (name) tell(session, scene::SoundStart{name, scene::kNoEntity, 0, message.origin, 1.0f, 1.0f});
}

void begin_level_sounds(Session& session) {
  const auto& names = session.state.sound_names;
  tell(session, scene::SoundLevel{{names.begin() + 1, names.end()}});
}

void end_sounds(Session& session) { tell(session, scene::SoundLevel{}); }

void local_sound(Session& session, std::string_view name) {
  if (!session.sound_listener || session.quiet) return;
  const int entity = session.state.view_entity;
  session.sound_listener(scene::SoundStart{std::string(name), entity, scene::kAnyChannel, vec3(0.0f), 1.0f, 1.0f});
}

void stop_hearing(const Session& session) {
  const auto& names = session.state.sound_names;
  if (session.sound_listener && names.size() > 1)
    session.sound_listener(scene::SoundLevel{{names.begin() + 1, names.end()}});
}

void hear_again(const Session& session, int heard_track) {
  if (!session.sound_listener) return;
  stop_hearing(session);
  for (const scene::SoundLoop& loop : session.sounds.loops()) session.sound_listener(loop);
  for (const scene::SoundStart& start : session.sounds.sounding(session.state.time)) session.sound_listener(start);
  const int track = session.sounds.track();
  if (track != heard_track) session.sound_listener(scene::SoundTrack{track});
}

scene::SoundScene sound_scene(const Session& session, const vec3& origin, const vec3& angles, const formats::Bsp* map) {
  scene::SoundScene scene;
  scene.entity = session.state.view_entity;
  scene.paused = session.state.hud.paused;
  if (!map) return scene;
  scene.origin = origin;
  scene.right = angle_vectors(angles).right;
  const std::uint32_t leaf = world::pvs_leaf(*map, origin);
  if (leaf >= map->leafs.size()) return scene;
  scene.ambient = map->leafs[leaf].ambient;
  scene.underwater = is_liquid(map->leafs[leaf].contents);
  return scene;
}

}  // namespace fb::cl
