#include "client/session/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/log.h"
#include "base/number.h"
#include "client/effects/temp_entities.h"
#include "client/session/entities.h"
#include "client/session/fog_command.h"
#include "client/session/sounds.h"
#include "console/args.h"
#include "world/entity_lump.h"

namespace fb::cl {
namespace {

constexpr char kTalk = 1;                                   // begins what a player says
constexpr float kLastTime = 1e9f;                           // seconds: 30 years of play
constexpr float kHardestKick = 10.0f, kHardestHit = 50.0f;  // degrees of recoil, points of damage: a jolt of 1

// "maps/start.bsp" -> "start"
std::string bare_map_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.rfind('.'));
}

// `//precache model 57 "progs/demon.mdl"`: what a level that runs has got (network.md).
void take_late_precache(Session& session, std::string_view line) {
  const con::Args args(line.substr(2));
  const auto number = parse_whole_number_unsigned(args[2]);
  ClientState& state = session.state;
  const bool is_model = args[1] == "model";
  auto& names = is_model ? state.model_names : state.sound_names;
  if (!number || *number == 0 || *number >= net::kMaxPrecaches || names.empty() || args.size() != 4) return;
  const auto place = static_cast<std::size_t>(*number);
  if (place < names.size() && !names[place].empty()) return;  // as who comes just now has it from the list, too
  if (place >= names.size()) names.resize(place + 1);
  names[place] = args[3];
  state.late_precaches.push_back(fmt::format("{}\n", line));
  if (!is_model) return;
  state.models.resize(names.size(), nullptr);
  if (session.load_model) state.models[place] = session.load_model(args[3]);
}

// What a server stuffs into the console. Only what shows is obeyed, unless it is the player's own server: neither a
// demo nor a stranger must change a player's settings.
void obey(Session& session, std::string_view line) {
  const std::size_t space = line.find(' ');
  const std::string_view command = line.substr(0, space);
  const std::string_view rest = space == std::string_view::npos ? std::string_view{} : line.substr(space + 1);
  const std::vector<float> numbers = world::parse_numbers(rest, 4);
  ClientState& state = session.state;
  if (command == "//precache") {
    take_late_precache(session, line);
  } else if (command.starts_with("//")) {  // a comment
  } else if (command == "reconnect") {
    session.reconnect = true;
  } else if (command == "bf") {
    bonus_flash(state);
  } else if (command == "v_cshift") {
    if (numbers.size() >= 4) set_empty_shift(state, {numbers[0], numbers[1], numbers[2]}, numbers[3]);
  } else if (command == "fog") {
    const Result<std::string> said = fog_command(state, con::Args(line));
    if (session.quiet) return;
    if (!said.ok())
      log_warning("{}", said.error().message);
    else if (!said->empty())
      log_info("{}", *said);
  } else if (command == "sky") {
    state.skybox = std::string(rest.substr(0, rest.find_last_not_of(" \"") + 1));
    state.skybox->erase(0, std::min(state.skybox->find_first_not_of(" \""), state.skybox->size()));
    state.sky_changed = true;
  } else if (!command.empty() && session.command) {
    session.command(line);
  } else if (!command.empty()) {
    log_debug("the server's command \"{}\" is ignored", line);
  }
}

// Lines end at a line break or a semicolon outside quotes; a piece without an end waits for the rest.
void stuff_text(Session& session, const std::string& text) {
  for (const char c : text) {
    const bool quoted = std::count(session.stuffed.begin(), session.stuffed.end(), '"') % 2 != 0;
    if (c == '\n' || (c == ';' && !quoted)) {
      const std::size_t start = session.stuffed.find_first_not_of(" \t\r");
      const std::size_t end = session.stuffed.find_last_not_of(" \t\r");
      if (start != std::string::npos) obey(session, std::string_view(session.stuffed).substr(start, end - start + 1));
      session.stuffed.clear();
    } else if (session.stuffed.size() < 1024) {
      session.stuffed.push_back(c);
    }
  }
}

// Everything that a message does; a cause is returned where it cannot be obeyed.
struct Apply {
  Session& session;
  ClientState& state = session.state;

  std::string operator()(const net::svc::Nop&) const { return {}; }
  std::string operator()(const net::svc::Disconnect&) const {
    session.disconnected = true;
    return {};
  }
  std::string operator()(const net::svc::UpdateStat& m) const {
    if (m.stat >= net::kMaxStats) return fmt::format("stat {} is out of range", m.stat);
    state.hud.stats[static_cast<std::size_t>(m.stat)] = m.value;
    return {};
  }
  std::string operator()(const net::svc::Version& m) const {
    state.protocol.version = m.version;
    return {};
  }
  std::string operator()(const net::svc::SetView& m) const {
    state.view_entity = m.entity;
    state.hud.player = m.entity - 1;
    return {};
  }
  std::string operator()(const net::svc::Sound& m) const {
    if (static_cast<std::size_t>(m.sound) >= net::kMaxPrecaches)
      return fmt::format("sound {} is out of range", m.sound);
    apply_sound(session, m);
    return {};
  }
  std::string operator()(const net::svc::StopSound& m) const {
    apply_stop_sound(session, m);
    return {};
  }
  std::string operator()(const net::svc::SpawnStaticSound& m) const {
    apply_static_sound(session, m);
    return {};
  }
  std::string operator()(const net::svc::CdTrack& m) const {
    apply_track(session, m);
    return {};
  }
  std::string operator()(const net::svc::SellScreen&) const { return {}; }
  std::string operator()(const net::svc::Time& m) const {
    if (std::abs(m.time) > kLastTime) return fmt::format("the time is {} seconds", m.time);
    state.message_times = {m.time, state.message_times[0]};
    return {};
  }
  std::string operator()(const net::svc::Print& m) const {
    if (m.text.starts_with(kTalk)) local_sound(session, "misc/talk.wav");
    if (session.print && !session.quiet) session.print(localised(m.text));
    return {};
  }
  std::string operator()(const net::svc::StuffText& m) const {
    stuff_text(session, m.text);
    return {};
  }
  std::string operator()(const net::svc::SetAngle& m) const {
    state.view_angles = m.angles;
    return {};
  }
  std::string operator()(const net::svc::ServerInfo& m) const;
  std::string operator()(const net::svc::LightStyle& m) const {
    if (m.style >= net::kMaxLightStyles) return fmt::format("light style {} is out of range", m.style);
    state.light_styles[static_cast<std::size_t>(m.style)] = m.pattern;
    return {};
  }
  // The score of a client; null for one that does not play.
  Score* score(int client) const {
    const auto index = static_cast<std::size_t>(client);
    return index < state.hud.scores.size() ? &state.hud.scores[index] : nullptr;
  }
  std::string no_client(int client) const {
    return fmt::format("player {} of {} does not exist", client, state.hud.scores.size());
  }
  std::string operator()(const net::svc::UpdateName& m) const {
    if (!score(m.client)) return no_client(m.client);
    score(m.client)->name = m.name;
    return {};
  }
  std::string operator()(const net::svc::UpdateFrags& m) const {
    if (!score(m.client)) return no_client(m.client);
    score(m.client)->frags = m.frags;
    return {};
  }
  std::string operator()(const net::svc::UpdateColors& m) const {
    if (!score(m.client)) return no_client(m.client);
    score(m.client)->colors = m.colors;
    return {};
  }
  std::string operator()(const net::svc::ClientData& m) const;
  std::string operator()(const net::svc::Particle& m) const {
    const vec3 direction = vec3(m.direction[0], m.direction[1], m.direction[2]) / 16.0f;
    session.effects.particles.effect(m.origin, direction, m.color, m.count == 255 ? 1024 : m.count, state.time);
    return {};
  }
  std::string operator()(const net::svc::Damage& m) const;
  std::string operator()(const net::svc::SpawnStatic& m) const { return apply_static(state, m); }
  std::string operator()(const net::svc::SpawnBaseline& m) const { return apply_baseline(state, m); }
  std::string operator()(const net::svc::EntityUpdate& m) const { return apply_update(session, m); }
  std::string operator()(const net::svc::TempEntity& m) const {
    apply_temp_entity(session.effects, m, state.time);
    temp_entity_sound(session, m);
    return {};
  }
  std::string operator()(const net::svc::SetPause& m) const {
    state.hud.paused = m.paused;
    return {};
  }
  std::string operator()(const net::svc::SignonNum& m) const {
    if (m.signon <= state.signon) return fmt::format("signon stage {} when at {}", m.signon, state.signon);
    state.signon = session.signon_heard = m.signon;
    return {};
  }
  std::string operator()(const net::svc::CenterPrint& m) const {
    center_print(m.text);
    return {};
  }
  std::string operator()(const net::svc::KilledMonster&) const {
    ++state.hud.stats[net::kStatMonsters];
    return {};
  }
  std::string operator()(const net::svc::FoundSecret&) const {
    ++state.hud.stats[net::kStatSecrets];
    return {};
  }
  std::string operator()(const net::svc::Intermission&) const {
    intermission(Intermission::kLevel);
    return {};
  }
  std::string operator()(const net::svc::Finale& m) const {
    intermission(Intermission::kFinale);
    center_print(m.text);
    return {};
  }
  std::string operator()(const net::svc::Cutscene& m) const {
    intermission(Intermission::kCutscene);
    center_print(m.text);
    return {};
  }
  std::string operator()(const net::svc::Skybox& m) const {
    state.skybox = m.name;
    state.sky_changed = true;
    return {};
  }
  std::string operator()(const net::svc::BonusFlash&) const {
    bonus_flash(state);
    return {};
  }
  std::string operator()(const net::svc::Achievement&) const { return {}; }
  std::string operator()(const net::svc::LocalSound& m) const {
    const auto sound = static_cast<std::size_t>(m.sound);
    if (sound < state.sound_names.size()) local_sound(session, state.sound_names[sound]);
    return {};
  }
  std::string operator()(const net::svc::Fog& m) const {
    Fog fog;
    fog.density = static_cast<float>(m.density) / 255.0f;
    fog.color = vec3(m.red, m.green, m.blue) / 255.0f;
    change_fog(state.fog, fog, std::max(0, m.fade) / 100.0, state.time);
    return {};
  }

  // A server of this program sends no keys, but others do, and their demos hold them.
  std::string localised(const std::string& text) const {
    return session.localization ? std::string(session.localization->text(text)) : text;
  }
  void center_print(const std::string& text) const {
    state.hud.center_print = localised(text);
    state.hud.center_print_time = state.time;
  }
  void intermission(Intermission kind) const {
    state.hud.intermission = kind;
    state.hud.completed_time = state.time;
  }
};

std::string Apply::operator()(const net::svc::ServerInfo& m) const {
  session.clear();
  ++session.levels;
  state.protocol = m.protocol;
  if (const std::uint32_t unknown = m.protocol.flags & ~net::kKnownProtocolFlags)
    log_warning("protocol 999 with unknown flags {:#x}: its messages may not be understood", unknown);
  state.have_server_info = true;
  state.hud.max_clients = m.max_clients;
  state.hud.scores.resize(static_cast<std::size_t>(m.max_clients));
  state.hud.game_type = m.game_type;
  state.hud.level_name = localised(m.level_name);
  state.model_names.assign(1, "");
  state.model_names.insert(state.model_names.end(), m.models.begin(), m.models.end());
  state.sound_names.assign(1, "");
  state.sound_names.insert(state.sound_names.end(), m.sounds.begin(), m.sounds.end());
  begin_level_sounds(session);
  state.models.assign(state.model_names.size(), nullptr);
  if (!m.models.empty()) state.hud.map_name = bare_map_name(m.models.front());
  state.entities.resize(1);
  state.entities[0].model = 1;
  if (!session.load_world) return {};
  const Status loaded = session.load_world(state);
  return loaded.ok() ? std::string{} : loaded.error().message;
}

std::string Apply::operator()(const net::svc::ClientData& m) const {
  state.view_height = m.view_height;
  state.ideal_pitch = m.ideal_pitch;
  state.message_velocities[1] = state.message_velocities[0];
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    state.punch[i] = static_cast<float>(m.punch[k]);
    state.message_velocities[0][i] = static_cast<float>(m.velocity[k]) * 16.0f;
  }
  if (state.punches[0] != state.punch) {
    const float kick = glm::length(state.punch);
    if (kick > glm::length(state.punches[0])) state.jolt = std::max(state.jolt, std::min(kick / kHardestKick, 1.0f));
    state.punches = {state.punch, state.punches[0]};
  }
  const auto had = static_cast<std::uint32_t>(state.hud.items), has = static_cast<std::uint32_t>(m.items);
  for (std::size_t bit = 0; bit < 32; ++bit)
    if ((has & ~had) >> bit & 1u) state.hud.item_time[bit] = state.time;
  state.hud.items = m.items;
  state.on_ground = m.on_ground;
  state.in_water = m.in_water;
  state.on_elevator = m.on_elevator;
  auto& stats = state.hud.stats;
  if (stats[net::kStatWeapon] != m.weapon) state.view_model.lerp_flags |= kLerpResetAnim;
  stats[net::kStatWeaponFrame] = m.weapon_frame;
  stats[net::kStatArmor] = m.armor;
  stats[net::kStatWeapon] = m.weapon;
  stats[net::kStatHealth] = m.health;
  stats[net::kStatAmmo] = m.ammo;
  for (std::size_t i = 0; i < 4; ++i) stats[net::kStatShells + i] = m.ammo_counts[i];
  stats[net::kStatActiveWeapon] = m.active_weapon;
  stats[net::kStatViewHeight] = m.view_height;
  stats[net::kStatIdealPitch] = m.ideal_pitch;
  for (std::size_t i = 0; i < 3; ++i) stats[net::kStatPunchPitch + i] = m.punch[i];
  state.view_model.alpha = m.weapon_alpha;
  return {};
}

std::string Apply::operator()(const net::svc::Damage& m) const {
  const float count = std::max(10.0f, 0.5f * static_cast<float>(m.blood + m.armor));
  state.hud.face_pain_until = state.time + 0.2;
  state.jolt = std::max(state.jolt, std::min(2.0f * count / kHardestHit, 1.0f));
  ColorShift& shift = state.shifts[kShiftDamage];
  shift.percent = std::clamp(shift.percent + 3.0f * count, 0.0f, 150.0f);
  if (m.armor > m.blood)
    shift.color = {200, 100, 100};
  else if (m.armor)
    shift.color = {220, 50, 50};
  else
    shift.color = {255, 0, 0};
  const Entity* player = state.view_entity_state();
  if (!player) return {};
  vec3 from = m.from - player->origin;
  const float distance = glm::length(from);
  if (distance > 0.0f) from /= distance;
  const AxisVectors axes = angle_vectors(player->angles);
  state.damage_roll = count * glm::dot(from, axes.right) * session.settings.v_kickroll;
  state.damage_pitch = count * glm::dot(from, axes.forward) * session.settings.v_kickpitch;
  state.damage_time = session.settings.v_kicktime;
  return {};
}

}  // namespace

void Session::clear() {
  const auto view_angles = state.message_view_angles;
  state = ClientState{};
  state.message_view_angles = view_angles;
  effects.clear();
  disconnected = reconnect = false;
  stuffed.clear();
}

void Session::reseed() {
  rng = Rng(kSeed);
  sound_rng = Rng(kSoundSeed);
  const std::size_t most = effects.particles.capacity();
  effects = Effects();
  effects.particles.set_capacity(most);
}

void bonus_flash(ClientState& state) { state.shifts[kShiftBonus] = {vec3(215, 186, 69), 50.0f}; }

void set_empty_shift(ClientState& state, const vec3& color, float percent) { state.empty_shift = {color, percent}; }

Status parse_server_message(Session& session, ByteView data, std::string_view name) {
  session.state.on_ground = false;  // unless this message says otherwise
  net::ServerMessageReader reader(data, name, session.state.protocol);
  while (!reader.at_end() && !session.disconnected) {
    auto message = reader.next();
    if (!message.ok()) return message.error();
    const std::string cause = std::visit(Apply{session}, *message);
    if (!cause.empty()) return reader.error(cause);
  }
  return ok_status();
}

}  // namespace fb::cl
