// Slots, buffers, and what goes into them. Sending is send.cpp, coming and going connect.cpp, listening receive.cpp.
#include "server/clients/clients.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "server/clients/level_protocol.h"
#include "server/clients/send_entities.h"
#include "server/clients/signon.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
using progs::to_int;

enum Destination { kBroadcast = 0, kOne = 1, kAll = 2, kInit = 3, kMulticast = 4, kEntity = 5 };

constexpr std::size_t kFirstWide = 256;          // sounds from here on do not fit a byte
constexpr std::uint32_t kMostSoundEdict = 8191;  // protocol 15 has 13 bits for who makes a sound

std::string not_precached(std::string_view sample) { return fmt::format("the sound \"{}\" is not precached", sample); }

}  // namespace

float ServerClient::average_ping() const {
  const std::size_t count = std::min(pings, kPings);
  if (count == 0) return 0.0f;
  return std::accumulate(ping_times.begin(), ping_times.begin() + static_cast<std::ptrdiff_t>(count), 0.0f) /
         static_cast<float>(count);
}

Clients::Clients(con::Console& console, const ClientsOptions& options)
    : standard_quake(options.standard_quake), console_(console) {
  if (!console.find_cvar("sv_protocol"))
    console.add_cvar(
        "sv_protocol", "666",
        "network protocol: 15 NetQuake, 666 FitzQuake or 999 RMQ; takes effect at the next level. With 666 a "
        "map beyond 4096 units, or one whose entities have a scale, is told in 999");
  if (!console.find_cvar("sv_signontime"))
    console.add_cvar({"sv_signontime", "60", "seconds within which a newcomer must have signed on; 0: no limit",
                      con::kCvarPlain, 0.0f, 3600.0f});
  if (!console.find_cvar("hostname"))
    console.add_cvar("hostname", "UNNAMED", "name of the server in server lists", con::kCvarArchive);
  set_max_clients(options.max_clients);
}
Clients::~Clients() = default;

void Clients::set_max_clients(int count) {
  slots_.clear();
  for (int i = 0; i < std::clamp(count, 1, net::kMaxClients); ++i) {
    slots_.push_back(std::make_unique<ServerClient>());
    slots_.back()->slot = i;
  }
}

int Clients::active_count() const {
  return static_cast<int>(std::count_if(slots_.begin(), slots_.end(), [](const auto& slot) { return slot->active(); }));
}

ServerClient* Clients::find(EdictId edict) {
  const auto slot = static_cast<std::size_t>(index(edict)) - 1;
  return index(edict) >= 1 && slot < slots_.size() ? slots_[slot].get() : nullptr;
}

// --- levels ----------------------------------------------------------------------------------------------------------

void Clients::begin_level(Level& level) {
  end_level();
  level_ = &level;
  protocol_ = protocol_for(level, console_.cvar("sv_protocol"));
  effects_mask_ = effects_mask(*level.vm);
  for (net::MessageWriter* writer : {&datagram_, &reliable_datagram_, &signon_, &multicast_, &lost_})
    *writer = net::MessageWriter(protocol_);
  for (auto& client : slots_) client->reliable = net::MessageWriter(protocol_);
}

void Clients::finish_level() {
  make_baselines(*level_, signon_);
  for (auto& client : slots_)
    if (client->active()) send_server_info(*client);
}

void Clients::end_level() {
  level_ = nullptr;
  signon_parts_.clear();
  signon_parts_of_ = 0;
  told_full_ = false;
  for (auto& client : slots_) {
    client->stage = ServerClient::Stage::kConnected;
    client->signon = ServerClient::Signon::kWaiting;
    client->reliable = net::MessageWriter(protocol_);
    client->old_frags = 0;
    client->move = {};
  }
}

// --- what is said ----------------------------------------------------------------------------------------------------

void Clients::write_reliable(ServerClient& client, const net::ServerMessage& message) {
  if (client.reliable.size() > kMostBytes)
    client.overflowed = true;
  else
    net::write_server_message(client.reliable, message);
}

void Clients::write_to_all(const net::ServerMessage& message) {
  if (reliable_datagram_.size() <= kMostBytes) net::write_server_message(reliable_datagram_, message);
}

void Clients::broadcast_print(std::string_view text) {
  for (auto& client : slots_)
    if (client->active() && client->spawned()) print(*client, text);
}

bool Clients::heard_here() const {
  return std::any_of(slots_.begin(), slots_.end(), [](const auto& client) {
    return client->active() && client->spawned() && client->connection->is_local();
  });
}

void Clients::print(ServerClient& client, std::string_view text) {
  write_reliable(client, net::svc::Print{std::string(text)});
}
void Clients::center_print(ServerClient& client, std::string_view text) {
  write_reliable(client, net::svc::CenterPrint{std::string(text)});
}
void Clients::stuff(ServerClient& client, std::string_view text) {
  write_reliable(client, net::svc::StuffText{std::string(text)});
}

bool Clients::extensions_wanted() const {
  const con::Cvar* cvar = console_.find_cvar("pr_checkextension");
  return !cvar || cvar->on();
}

Result<net::MessageWriter*> Clients::destination(int where, EdictId msg_entity) {
  const auto within = [&](net::MessageWriter& writer, std::size_t most) -> net::MessageWriter* {
    if (writer.size() <= most) return &writer;
    lost_.truncate(0);
    return &lost_;
  };
  switch (where) {
    case kBroadcast:
      return within(datagram_, kMostBytes);
    case kAll:
      return within(reliable_datagram_, kMostBytes);
    case kInit:
      return within(signon_, kMostSignonBytes);
    case kMulticast:
    case kEntity:
      return within(multicast_, kMostBytes);
    case kOne: {
      ServerClient* client = find(msg_entity);
      if (!client) return Error{fmt::format("a message to entity {}, which is no player", index(msg_entity))};
      if (client->reliable.size() > kMostBytes) client->overflowed = true;
      return within(client->reliable, kMostBytes);
    }
    default:
      return Error{fmt::format("a message to destination {}, which is none", where)};
  }
}

void Clients::multicast(int set, EdictId msg_entity) {
  const auto append = [&](net::MessageWriter& to, std::size_t most) {
    if (to.size() <= most) to.append(multicast_.bytes());
  };
  ServerClient* const client = find(msg_entity);
  if (set >= 0 && set <= 2) append(datagram_, kMostBytes);
  if (set >= 3 && set <= 5) append(reliable_datagram_, kMostBytes);
  if ((set == 6 || set == 7) && client && client->active()) append(client->reliable, kMostBytes);
  if (set == 8) append(signon_, kMostSignonBytes);
  multicast_.truncate(0);
}

void Clients::start_sound(EdictId source, int channel, std::string_view sample, float volume, float attenuation) {
  if (!level_) return;
  const Edict at = level_->edict(source);
  sound_at(at.get(fields::origin) + 0.5f * (at.get(fields::mins) + at.get(fields::maxs)), source, channel, sample,
           volume, attenuation);
}

void Clients::sound_at(const vec3& origin, EdictId source, int channel, std::string_view sample, float volume,
                       float attenuation) {
  if (!level_) return;
  const int sound = level_->sound_index(sample);
  if (sound == 0) return level_->warn_once(not_precached(sample));
  const auto edict = static_cast<int>(index(source));
  const bool fits_15 = static_cast<std::size_t>(sound) < kFirstWide && index(source) <= kMostSoundEdict && channel < 8;
  if ((!protocol_.extended() && !fits_15) || datagram_.size() > kMostBytes) return;
  net::write_server_message(datagram_,
                            net::svc::Sound{edict, channel, sound, std::clamp(to_int(volume * 255.0f), 0, 255),
                                            std::clamp(to_int(attenuation * 64.0f), 0, 255), origin});
}

// By svc_sound, which every client understands; later engines have svc_localsound for it.
void Clients::local_sound(ServerClient& client, std::string_view sample) {
  if (!level_) return;
  const int sound = level_->sound_index(sample);
  if (sound == 0) return level_->warn_once(not_precached(sample));
  if (!protocol_.extended() && static_cast<std::size_t>(sound) >= kFirstWide) return;
  const auto edict = static_cast<int>(index(client.edict_id()));
  write_reliable(client,
                 net::svc::Sound{edict, 0, sound, 255, 0, level_->edict(client.edict_id()).get(fields::origin)});
}

void Clients::start_particle(const vec3& origin, const vec3& direction, int color, int count) {
  if (datagram_.size() > kMostBytes) return;
  net::svc::Particle particle{origin, {}, count, color};
  for (int axis = 0; axis < 3; ++axis)
    particle.direction[static_cast<std::size_t>(axis)] = std::clamp(to_int(direction[axis] * 16.0f), -128, 127);
  net::write_server_message(datagram_, particle);
}

void Clients::ambient_sound(const vec3& origin, std::string_view sample, float volume, float attenuation) {
  if (!level_) return;
  const int sound = level_->sound_index(sample);
  if (sound == 0) return level_->warn_once(not_precached(sample));
  const bool wide = static_cast<std::size_t>(sound) >= kFirstWide;
  if ((wide && !protocol_.extended()) || signon_.size() > kMostSignonBytes) return;
  net::write_server_message(signon_, net::svc::SpawnStaticSound{origin, sound, to_int(volume * 255.0f) & 0xff,
                                                                to_int(attenuation * 64.0f) & 0xff, wide});
}

void Clients::make_static(Edict edict) {
  if (!level_ || signon_.size() > kMostSignonBytes) return;
  if (const auto message = static_entity(*level_, edict.id(), protocol_)) net::write_server_message(signon_, *message);
}

void Clients::light_style(int style, std::string_view pattern) {
  if (!level_ || style < 0 || static_cast<std::size_t>(style) >= level_->light_styles.size()) return;
  level_->light_styles[static_cast<std::size_t>(style)] = pattern;
  for (auto& client : slots_)
    if (client->active() && client->spawned())
      write_reliable(*client, net::svc::LightStyle{style, std::string(pattern)});
}

// As text that starts a comment in the consoles of other engines, whose clients take it for nothing and show nothing in
// the model's place; a message of its own would be their end.
void Clients::tell_of_precache(std::string_view kind, int number, std::string_view name) {
  if (!level_ || (!protocol_.extended() && number >= static_cast<int>(kFirstWide))) return;
  if (name.find_first_of("\"\n\r") == std::string_view::npos)
    write_to_all(net::svc::StuffText{fmt::format("//precache {} {} \"{}\"\n", kind, number, name)});
}

void Clients::set_pause(bool paused) {
  if (!level_ || level_->paused == paused) return;
  level_->paused = paused;
  write_to_all(net::svc::SetPause{paused});
}

}  // namespace fb::sv
