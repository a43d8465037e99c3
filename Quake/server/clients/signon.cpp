#include "server/clients/signon.h"

#include "base/log.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
using progs::to_int;

constexpr int kFirstWide = 256;                 // numbers from here on do not fit a byte
constexpr std::uint32_t kNetQuakeEdicts = 600;  // what NetQuake's own clients know

bool is_wide(const net::EntityState& state) {
  return state.model >= kFirstWide || ((state.frame & 0xff00) != 0) || state.alpha != net::kAlphaDefault ||
         state.scale != net::kScaleDefault;
}

// What cannot be said in protocol 15 is said as nothing.
void fit_protocol_15(net::EntityState& state) {
  if (state.model >= kFirstWide) state.model = 0;
  if (state.frame & 0xff00) state.frame = 0;
  state.alpha = net::kAlphaDefault;
  state.scale = net::kScaleDefault;
}

// With the alpha that the entity has from the map, or was sent with last: what QuakeC has set since counts from when
// the edict is sent next, so that static things are as opaque as in QuakeSpasm (Misc/QUIRKS.md).
net::EntityState state_of(Level& level, EdictId id) {
  const Edict edict = level.edict(id);
  net::EntityState state;
  state.origin = edict.get(fields::origin);
  state.angles = edict.get(fields::angles);
  state.frame = to_int(edict.get(fields::frame));
  state.skin = to_int(edict.get(fields::skin));
  state.model = level.model_index(level.vm->text(edict.get(fields::model)));
  state.alpha = level.extra(id).alpha;
  return state;
}

net::EntityState baseline_of(Level& level, EdictId id, const net::Protocol& protocol) {
  net::EntityState state = state_of(level, id);
  if (level.is_client(id)) {
    state.colormap = static_cast<int>(index(id));
    state.model = level.model_index("progs/player.mdl");
    state.alpha = net::kAlphaDefault;
  } else if (protocol.version == net::kProtocolRmq) {
    state.scale = net::encode_scale(level.edict(id).get(level.optional.scale));
  }
  if (!protocol.extended()) fit_protocol_15(state);
  return state;
}

// Appends all but what is nothing ([0]) and, for protocol 15, what a byte does not number.
template <typename Entry, typename Name>
void list_precaches(const std::vector<Entry>& from, std::vector<std::string>& to, const net::Protocol& protocol,
                    std::string_view what, Name name) {
  std::size_t count = from.size();
  if (!protocol.extended() && count > kFirstWide) {
    log_warning("protocol 15 knows {} {} of the level's {}: the others stay away", kFirstWide - 1, what, count - 1);
    count = kFirstWide;
  }
  for (std::size_t i = 1; i < count; ++i) to.push_back(name(from[i]));
}

}  // namespace

net::svc::ServerInfo server_info(const Level& level, const net::Protocol& protocol, int max_clients) {
  net::svc::ServerInfo info;
  info.protocol = protocol;
  info.max_clients = max_clients;
  info.game_type = !level.cvars.coop.on() && level.cvars.deathmatch.on() ? 1 : 0;
  info.level_name = level.title();
  list_precaches(level.models, info.models, protocol, "models", [](const LevelModel& model) { return model.name; });
  list_precaches(level.sounds, info.sounds, protocol, "sounds", [](const std::string& name) { return name; });
  return info;
}

void make_baselines(Level& level, net::MessageWriter& writer) {
  const net::Protocol& protocol = writer.protocol;
  if (!protocol.extended() && level.edicts().count() > kNetQuakeEdicts)
    log_warning("the level has {} entities; NetQuake's own clients know {}", level.edicts().count(), kNetQuakeEdicts);
  for (std::uint32_t i = 0; i < level.edicts().count(); ++i) {
    const EdictId id{i};
    const Edict edict = level.edict(id);
    if (edict.is_free()) continue;
    if (i > static_cast<std::uint32_t>(level.max_clients) && edict.get(fields::modelindex) == 0.0f) continue;
    const net::EntityState state = baseline_of(level, id, protocol);
    level.extra(id).baseline = state;
    net::write_server_message(writer, net::svc::SpawnBaseline{static_cast<int>(i), state, is_wide(state)});
  }
}

std::optional<net::svc::SpawnStatic> static_entity(Level& level, EdictId id, const net::Protocol& protocol) {
  net::EntityState state = state_of(level, id);
  const Edict edict = level.edict(id);
  if (state.alpha == net::kAlphaZero) return std::nullopt;
  state.colormap = to_int(edict.get(fields::colormap));
  if (protocol.version == net::kProtocolRmq) state.scale = net::encode_scale(edict.get(level.optional.scale));
  if (!protocol.extended()) {
    if (state.model >= kFirstWide || (state.frame & 0xff00) != 0) return std::nullopt;
    fit_protocol_15(state);
  }
  return net::svc::SpawnStatic{state, is_wide(state)};
}

}  // namespace fb::sv
