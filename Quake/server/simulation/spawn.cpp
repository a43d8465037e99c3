#include "server/simulation/spawn.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "progs/text_tokens.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;

bool left_out(const Edict& edict, std::string_view classname, const SpawnRules& rules) {
  if (rules.deathmatch) {
    if (edict.has_flag(fields::spawnflags, kSpawnNotDeathmatch)) return true;
  } else {
    const std::int32_t bit = rules.skill <= 0 ? kSpawnNotEasy : rules.skill == 1 ? kSpawnNotMedium : kSpawnNotHard;
    if (edict.has_flag(fields::spawnflags, bit)) return true;
  }
  return rules.no_monsters && classname.starts_with("monster_");
}

class Spawner {
 public:
  Spawner(Level& level, const SpawnRules& rules) : level_(level), vm_(*level.vm), rules_(rules) {}

  Status spawn(EdictId id, std::string_view& text) {
    auto read = progs::parse_edict(vm_, id, text);
    if (!read) return read.error();
    if (read->empty) {
      vm_.edicts().mark_free(id);
      return ok_status();
    }
    take_looks(level_, id, *read);
    return call_spawn_function(id);
  }
  int left_out_count() const { return left_out_; }

 private:
  Status call_spawn_function(EdictId id) {
    const Edict edict = vm_.edict(id);
    const std::string classname(vm_.text(edict.get(fields::classname)));
    if (left_out(edict, classname, rules_)) {
      ++left_out_;
      vm_.edicts().free(id, level_.time);
      return ok_status();
    }
    if (classname.empty()) return give_up(id, "No classname for:");
    const FunctionId function = vm_.program().find_function(classname);
    if (function == FunctionId::kNull) return give_up(id, "No spawn function for:");
    if (!level_.run(function, id)) return *level_.error();
    return ok_status();
  }
  Status give_up(EdictId id, std::string_view why) {
    log_info("{}{}", why, progs::print_edict(vm_, id));
    vm_.edicts().free(id, level_.time);
    return ok_status();
  }

  Level& level_;
  progs::Vm& vm_;
  SpawnRules rules_;
  int left_out_ = 0;
};

}  // namespace

void take_looks(Level& level, EdictId id, const progs::EdictText& text) {
  EdictExtra& extra = level.extra(id);
  for (const auto& [key, value] : text.unknown) {
    if (key == "alpha") extra.alpha = net::encode_alpha(progs::parse_float(value));
    if (key == "scale") extra.scale = std::clamp(static_cast<int>(progs::parse_float(value) * 16.0f), 0, 255);
  }
  const Edict edict = level.edict(id);
  if (const float alpha = edict.get(level.optional.alpha); alpha != 0.0f) extra.alpha = net::encode_alpha(alpha);
}

Status spawn_entities(Level& level, std::string_view text, std::string_view name, const SpawnRules& rules) {
  Spawner spawner(level, rules);
  bool is_world = true;
  while (const auto token = progs::take_token(text)) {
    if (!token->is('{')) return Error{fmt::format("{}: found {} where an entity's {{ should be", name, token->text)};
    EdictId id = EdictId::kWorld;
    if (!is_world) {
      const auto made = level.edicts().alloc(level.time);
      if (!made) return made.error();
      id = *made;
    }
    is_world = false;
    if (Status status = spawner.spawn(id, text); !status) {
      return level.failed() ? status : Error{fmt::format("{}: {}", name, status.error().message)};
    }
  }
  log_debug("{} entities left out", spawner.left_out_count());
  return ok_status();
}

}  // namespace fb::sv
