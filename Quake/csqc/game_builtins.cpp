// What a mod's status bar asks of the game: numbers of the player and the level, players by name, the server's rules;
// and the little that it may do besides drawing. Numbers of builtins and keys are FTE's and vkQuake's.
#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "csqc/hud_context.h"
#include "progs/text_tokens.h"
#include "progs/vm.h"
#include "ui/scoreboard.h"

namespace fb::csqc {
namespace {

using progs::BuiltinTable;
using progs::Vm;

// 0 for those that there are not, or that no message has told of.
std::int32_t stat(const HudContext& context, int index) {
  if (!context.hud || index < 0 || index >= net::kMaxStats) return 0;
  if (index == net::kStatItems) return context.hud->items;
  return context.hud->stats[static_cast<std::size_t>(index)];
}

// getstatf(index, first bit, number of bits): all of it as a number, or some of its bits.
void getstatf(Vm& vm, HudContext& context) {
  const std::int32_t value = stat(context, vm.parm_int(0));
  if (vm.parm_count() < 2) return vm.return_float(static_cast<float>(value));
  const int first = vm.parm_int(1), count = vm.parm_count() > 2 ? vm.parm_int(2) : 1;
  if (first < 0 || first > 31 || count < 1) return vm.return_float(0.0f);
  const std::uint32_t bits = static_cast<std::uint32_t>(value) >> static_cast<unsigned>(first);
  const std::uint32_t mask = count > 31 ? ~0u : (1u << static_cast<unsigned>(count)) - 1u;
  vm.return_float(static_cast<float>(bits & mask));
}

// The player of this number; of -1, -2 ... the first, second ... of the scoreboard.
std::optional<std::size_t> player_of(const HudContext& context, int number) {
  if (!context.hud) return std::nullopt;
  if (number >= 0) {
    const auto player = static_cast<std::size_t>(number);
    return player < context.hud->scores.size() ? std::optional(player) : std::nullopt;
  }
  const auto places = ui::ranking(*context.hud);
  const auto place = static_cast<std::size_t>(-1 - static_cast<std::int64_t>(number));
  return place < places.size() ? std::optional(places[place]) : std::nullopt;
}

std::string rgb_text(HudContext& context, int color) {
  const vec4 rgb = context.pictures.atlas().color(ui::color_index(color));
  return fmt::format("{:g} {:g} {:g}", rgb.x, rgb.y, rgb.z);
}

// nullopt for what is not known: of players of the protocols that this engine speaks there is no ping.
std::optional<std::string> player_key(HudContext& context, int number, std::string_view key) {
  const auto player = player_of(context, number);
  if (!player) return std::nullopt;
  const cl::Score& score = context.hud->scores[*player];
  const int shirt = score.colors >> 4 & 15, trousers = score.colors & 15;
  if (key == "viewentity") return fmt::format("{}", *player + 1);
  if (score.name.empty()) return std::nullopt;
  if (key == "name") return score.name;
  if (key == "frags") return fmt::format("{}", score.frags);
  if (key == "topcolor") return fmt::format("{}", shirt);
  if (key == "bottomcolor") return fmt::format("{}", trousers);
  if (key == "topcolor_rgb") return rgb_text(context, shirt);
  if (key == "bottomcolor_rgb") return rgb_text(context, trousers);
  if (key == "team") return fmt::format("{}", trousers + 1);
  return std::nullopt;
}

std::string server_key(const HudContext& context, std::string_view key) {
  if (key == "constate") return context.hud ? "active" : "disconnected";
  const bool deathmatch = context.hud && context.hud->game_type == 1;
  const int clients = context.hud ? context.hud->max_clients : 1;
  if (key == "deathmatch") return deathmatch ? "1" : "0";
  if (key == "coop") return clients > 1 && !deathmatch ? "1" : "0";
  if (key == "maxclients") return fmt::format("{}", clients);
  if (key == "mapname") return context.hud ? context.hud->map_name : "";
  const con::Cvar* cvar = context.console.find_cvar(key);
  return cvar ? cvar->string() : "";
}

void return_optional(Vm& vm, const std::optional<std::string>& text) {
  if (text) return vm.return_string(*text);
  vm.return_string_id(progs::StringId::kNull);
}

void add_stats(BuiltinTable& table, HudContext& context) {
  table.set(330, "getstati",
            [&context](Vm& vm) { vm.return_word(static_cast<progs::Word>(stat(context, vm.parm_int(0)))); });
  table.set(331, "getstatf", [&context](Vm& vm) { getstatf(vm, context); });
  // Texts of a mod's own need a protocol of other engines.
  table.set_idle(332, "getstats");
}

void add_players(BuiltinTable& table, HudContext& context) {
  table.set(348, "getplayerkeyvalue",
            [&context](Vm& vm) { return_optional(vm, player_key(context, vm.parm_int(0), vm.parm_string(1))); });
  table.set_named("getplayerkeyfloat", [&context](Vm& vm) {
    const float otherwise = vm.parm_count() > 2 ? vm.parm_float(2) : 0.0f;
    const auto text = player_key(context, vm.parm_int(0), vm.parm_string(1));
    vm.return_float(text ? progs::parse_float(*text) : otherwise);
  });
  table.set(354, "serverkey", [&context](Vm& vm) { vm.return_string(server_key(context, vm.parm_string(0))); });
  table.set_named("serverkeyfloat",
                  [&context](Vm& vm) { vm.return_float(progs::parse_float(server_key(context, vm.parm_string(0)))); });
  table.set(349, "isdemo", [&context](Vm& vm) { vm.return_float(context.moment.demo ? 1.0f : 0.0f); });
  table.set(350, "isserver", [&context](Vm& vm) { vm.return_float(context.moment.local_server ? 1.0f : 0.0f); });
}

}  // namespace

void add_game_builtins(BuiltinTable& table, HudContext& context) {
  add_stats(table, context);
  add_players(table, context);
  // For programs that are a server's, too: what is precached for it is nothing to a bar.
  for (const auto& [number, name] : {std::pair(19u, "precache_sound"), std::pair(20u, "precache_model")})
    table.set(number, name, [](Vm& vm) { vm.return_string_id(vm.parm_string_id(0)); });
  table.set(177, "localsound", [&context](Vm& vm) {
    const std::string_view name = vm.parm_string(0);
    if (!vm.failed() && context.play_sound) context.play_sound(name);
  });
  table.set(519, "gettime", [&context](Vm& vm) { vm.return_float(static_cast<float>(context.moment.now)); });
  table.set(352, "registercommand", [&context](Vm& vm) {
    const std::string name(vm.parm_string(0));
    if (!vm.failed() && context.register_command) context.register_command(name);
  });
}

void add_hud_builtins(BuiltinTable& table, HudContext& context) {
  add_draw_builtins(table, context);
  add_game_builtins(table, context);
}

}  // namespace fb::csqc
