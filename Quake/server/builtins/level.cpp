// What QuakeC asks of the level as a whole: precaching while it loads, the way to the next one.
#include <fmt/format.h>

#include <algorithm>

#include "server/builtins/game_builtins.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::Vm;

// The name that a precache gives, and returns to QuakeC; "" with vm.failed() where it may not.
std::string precache_parm(Vm& vm, const GameContext& context) {
  const std::string name(vm.parm_string(0));
  vm.return_string_id(vm.parm_string_id(0));
  if (!context.level->loading) {
    vm.fail(fmt::format("\"{}\" is precached while the level runs: only spawn functions may", name));
  } else if (name.empty() || static_cast<unsigned char>(name.front()) <= ' ') {
    vm.fail(fmt::format("\"{}\" is no name of a file to precache", name));
  }
  return vm.failed() ? std::string() : name;
}

void precache_sound(Vm& vm, GameContext& context) {
  std::string name = precache_parm(vm, context);
  auto& sounds = context.level->sounds;
  if (name.empty() || std::find(sounds.begin() + 1, sounds.end(), name) != sounds.end()) return;
  if (sounds.size() >= net::kMaxPrecaches)
    return vm.fail(fmt::format("{}: more than {} sounds", name, net::kMaxPrecaches - 1));
  sounds.push_back(std::move(name));
}

void precache_model(Vm& vm, GameContext& context) {
  const std::string name = precache_parm(vm, context);
  auto& models = context.level->models;
  if (name.empty() || context.level->model_index(name) != 0) return;
  if (models.size() >= net::kMaxPrecaches)
    return vm.fail(fmt::format("{}: more than {} models", name, net::kMaxPrecaches - 1));
  models.push_back(context.load_model(name));
}

}  // namespace

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
