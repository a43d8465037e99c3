// What QuakeC asks of the level as a whole: precaching while it loads, the way to the next one.
#include <fmt/format.h>

#include <algorithm>

#include "server/builtins/game_builtins.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::Vm;

// The name that a precache gives, and returns to QuakeC; empty, with a warning, where it is none.
std::string precache_parm(Vm& vm) {
  std::string name(vm.parm_string(0));
  vm.return_string_id(vm.parm_string_id(0));
  if (name.empty() || static_cast<unsigned char>(name.front()) <= ' ') {
    vm.warn(fmt::format("\"{}\" is no name of a file to precache", name));
    return {};
  }
  return name;
}

// Quake has only spawn functions precache.
void warn_if_late(Vm& vm, const GameContext& context, std::string_view name) {
  if (!context.level->loading) vm.warn(fmt::format("\"{}\" is precached while the level runs", name));
}

void precache_sound(Vm& vm, GameContext& context) {
  const std::string name = precache_parm(vm);
  auto& sounds = context.level->sounds;
  if (name.empty() || std::find(sounds.begin() + 1, sounds.end(), name) != sounds.end()) return;
  warn_if_late(vm, context, name);
  if (add_sound(context, name) == 0) vm.fail(fmt::format("{}: more than {} sounds", name, net::kMaxPrecaches - 1));
}

void precache_model(Vm& vm, GameContext& context) {
  const std::string name = precache_parm(vm);
  if (name.empty() || context.level->model_index(name) != 0) return;
  warn_if_late(vm, context, name);
  if (add_model(context, name) == 0) vm.fail(fmt::format("{}: more than {} models", name, net::kMaxPrecaches - 1));
}

}  // namespace

int add_model(GameContext& context, const std::string& name) {
  Level& level = *context.level;
  if (level.models.size() >= net::kMaxPrecaches) return 0;
  level.models.push_back(context.load_model(name));
  const auto number = static_cast<int>(level.models.size() - 1);
  if (!level.loading) context.clients.tell_of_precache("model", number, name);
  return number;
}

int add_sound(GameContext& context, const std::string& name) {
  Level& level = *context.level;
  if (level.sounds.size() >= net::kMaxPrecaches) return 0;
  level.sounds.push_back(name);
  const auto number = static_cast<int>(level.sounds.size() - 1);
  if (!level.loading) context.clients.tell_of_precache("sound", number, name);
  return number;
}

void add_level_builtins(BuiltinTable& table, GameContext& context) {
  const auto model = [&context](Vm& vm) { precache_model(vm, context); };
  const auto sound = [&context](Vm& vm) { precache_sound(vm, context); };
  // For the makers of paks, in Quake's day.
  const auto file = [](Vm& vm) { vm.return_string_id(vm.parm_string_id(0)); };
  table.set(19, "precache_sound", sound);
  table.set(76, "precache_sound2", sound);
  table.set(20, "precache_model", model);
  table.set(75, "precache_model2", model);
  table.set(68, "precache_file", file);
  table.set(77, "precache_file2", file);
  table.set(70, "changelevel", [&context](Vm& vm) {
    std::string name(vm.parm_string(0));
    if (!vm.failed() && context.change_level) context.change_level(std::move(name));
  });
}

}  // namespace fb::sv
