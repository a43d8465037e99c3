// What QuakeC does in the world: putting things somewhere, tracing, monsters' steps.
#include <fmt/format.h>

#include <cmath>

#include "server/builtins/game_builtins.h"
#include "server/simulation/link.h"
#include "server/simulation/quakec.h"
#include "server/simulation/steps.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::Vm;
namespace fields = progs::fields;
namespace globals = progs::globals;

// Quake's SetMinMaxSize.
void set_size(Vm& vm, Level& level, Edict edict, const vec3& mins, const vec3& maxs) {
  for (int i = 0; i < 3; ++i) {
    if (mins[i] > maxs[i]) {
      return vm.fail(fmt::format("the box of entity {} is inside out: '{} {} {}' to '{} {} {}'", index(edict.id()),
                                 mins.x, mins.y, mins.z, maxs.x, maxs.y, maxs.z));
    }
  }
  edict.set(fields::mins, mins);
  edict.set(fields::maxs, maxs);
  edict.set(fields::size, maxs - mins);
  link_edict(level, edict.id(), false);
}

void setorigin(Vm& vm, GameContext& context) {
  Edict edict = vm.parm_edict(0);
  if (vm.failed()) return;
  edict.set(fields::origin, vm.parm_vector(1));
  link_edict(*context.level, edict.id(), false);
}

void setsize(Vm& vm, GameContext& context) {
  const Edict edict = vm.parm_edict(0);
  if (!vm.failed()) set_size(vm, *context.level, edict, vm.parm_vector(1), vm.parm_vector(2));
}

void setmodel(Vm& vm, GameContext& context) {
  Edict edict = vm.parm_edict(0);
  const std::string name(vm.parm_string(1));
  if (vm.failed()) return;
  Level& level = *context.level;
  int number = level.model_index(name);
  if (number == 0 && !name.empty()) {
    number = add_model(context, name);
    vm.warn(fmt::format("setmodel: {} is not precached{}", name, number == 0 ? ", and cannot be" : ""));
  }
  edict.set(fields::model, vm.strings().intern(name));
  edict.set(fields::modelindex, static_cast<float>(number));
  const LevelModel& model = level.models[static_cast<std::size_t>(number)];
  set_size(vm, level, edict, model.mins, model.maxs);
}

// setmodelindex(entity, number of a precache)
void setmodelindex(Vm& vm, GameContext& context) {
  Edict edict = vm.parm_edict(0);
  const std::int32_t number = vm.parm_int(1);
  if (vm.failed()) return;
  Level& level = *context.level;
  if (number < 0 || static_cast<std::size_t>(number) >= level.models.size())
    return vm.skip(fmt::format("setmodelindex: there is no model {}", number));
  const LevelModel& model = level.models[static_cast<std::size_t>(number)];
  edict.set(fields::model, vm.strings().intern(model.name));
  edict.set(fields::modelindex, static_cast<float>(number));
  set_size(vm, level, edict, model.mins, model.maxs);
}

// touchtriggers(entity, where to go before): self, where it is, if both are left out.
void touchtriggers(Vm& vm, GameContext& context) {
  Edict edict = vm.parm_count() > 0 ? vm.parm_edict(0) : vm.self();
  if (vm.failed() || edict.is_world()) return;
  if (vm.parm_count() > 1) edict.set(fields::origin, vm.parm_vector(1));
  const KeepSelfAndOther keep(vm);
  link_edict(*context.level, edict.id(), true);
}

// checkpvs(position, entity): whether the entity may be seen from there.
void checkpvs(Vm& vm, GameContext& context) {
  const EdictId id = vm.parm_entity(1);
  if (vm.failed()) return;
  const formats::Bsp& bsp = *context.level->bsp;
  const auto seen = world::leaf_pvs(bsp, world::pvs_leaf(bsp, vm.parm_vector(0)));
  vm.return_float(context.level->extra(id).leafs.visible_in(seen) ? 1.0f : 0.0f);
}

vec3 zero_if_not_a_number(const vec3& v) {
  return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z) ? vec3(0.0f) : v;
}

void set_trace_globals(Vm& vm, const MoveTrace& trace) {
  vm.set(globals::trace_allsolid, trace.all_solid ? 1.0f : 0.0f);
  vm.set(globals::trace_startsolid, trace.start_solid ? 1.0f : 0.0f);
  vm.set(globals::trace_fraction, trace.fraction);
  vm.set(globals::trace_inwater, trace.in_water ? 1.0f : 0.0f);
  vm.set(globals::trace_inopen, trace.in_open ? 1.0f : 0.0f);
  vm.set(globals::trace_endpos, trace.end_pos);
  vm.set(globals::trace_plane_normal, trace.plane.normal);
  vm.set(globals::trace_plane_dist, trace.plane.distance);
  vm.set(globals::trace_ent, trace.edict.value_or(EdictId::kWorld));
}

// Parameters from `first` on: what kind of move, and whose.
void trace(Vm& vm, GameContext& context, const world::Move& move, int first) {
  const EdictId passed = vm.parm_entity(first + 1);
  if (vm.failed()) return;
  set_trace_globals(vm, sv_move(*context.level, move, static_cast<MoveKind>(vm.parm_int(first)), passed));
}

// traceline(from, to, kind, whom not)
void traceline(Vm& vm, GameContext& context) {
  trace(vm, context,
        {zero_if_not_a_number(vm.parm_vector(0)), vec3(0.0f), vec3(0.0f), zero_if_not_a_number(vm.parm_vector(1))}, 2);
}

// tracebox(from, mins, maxs, to, kind, whom not)
void tracebox(Vm& vm, GameContext& context) {
  trace(vm, context,
        {zero_if_not_a_number(vm.parm_vector(0)), zero_if_not_a_number(vm.parm_vector(1)),
         zero_if_not_a_number(vm.parm_vector(2)), zero_if_not_a_number(vm.parm_vector(3))},
        4);
}

// tracetoss(thing, whom not): where it would come to something if it flew and fell from here as it is, in steps of a
// twentieth of a second, for ten seconds at most (DP_QC_TRACETOSS). It stays where it is.
void tracetoss(Vm& vm, GameContext& context) {
  constexpr double kStep = 0.05;
  constexpr int kMostSteps = 200;
  Level& level = *context.level;
  const Edict thing = vm.parm_edict(0);
  const EdictId ignored = vm.parm_entity(1);
  if (vm.failed()) return;
  const float own = thing.get(level.optional.gravity);
  const double gravity = static_cast<double>((own != 0.0f ? own : 1.0f) * level.cvars.gravity.value());
  vec3 velocity = thing.get(fields::velocity);
  world::Move move{thing.get(fields::origin), thing.get(fields::mins), thing.get(fields::maxs),
                   thing.get(fields::origin)};
  MoveTrace trace;
  for (int step = 0; step < kMostSteps; ++step) {
    velocity.z = static_cast<float>(velocity.z - gravity * kStep);
    move.end = move.start + velocity * static_cast<float>(kStep);
    trace = sv_move(level, move, MoveKind::kNormal, thing.id());
    move.start = trace.end_pos;
    if (trace.edict && (ignored == EdictId::kWorld || *trace.edict != ignored)) break;
  }
  set_trace_globals(vm, trace);
}

}  // namespace

void add_world_builtins(BuiltinTable& table, GameContext& context) {
  const auto set = [&](std::uint32_t number, std::string_view name, void (*builtin)(Vm&, GameContext&)) {
    table.set(number, name, [&context, builtin](Vm& vm) { builtin(vm, context); });
  };
  set(2, "setorigin", setorigin);
  set(3, "setmodel", setmodel);
  set(4, "setsize", setsize);
  set(333, "setmodelindex", setmodelindex);
  set(279, "touchtriggers", touchtriggers);
  set(240, "checkpvs", checkpvs);
  // What copies an entity's place puts the copy there.
  table.set(400, "copyentity", [&context, copy = *table.find(400)](Vm& vm) {
    copy(vm);
    if (!vm.failed()) link_edict(*context.level, vm.returned_edict());
  });
  set(16, "traceline", traceline);
  set(64, "tracetoss", tracetoss);
  table.add_extension("DP_QC_TRACETOSS");
  set(90, "tracebox", tracebox);
  table.add_extension("DP_QC_TRACEBOX");
  set(32, "walkmove", [](Vm& vm, GameContext& in) {
    vm.return_float(walkmove(*in.level, vm.get(globals::self), vm.parm_float(0), vm.parm_float(1)) ? 1.0f : 0.0f);
  });
  set(34, "droptofloor",
      [](Vm& vm, GameContext& in) { vm.return_float(drop_to_floor(*in.level, vm.get(globals::self)) ? 1.0f : 0.0f); });
  set(40, "checkbottom", [](Vm& vm, GameContext& in) {
    const EdictId id = vm.parm_entity(0);
    if (!vm.failed()) vm.return_float(check_bottom(*in.level, id) ? 1.0f : 0.0f);
  });
  set(41, "pointcontents", [](Vm& vm, GameContext& in) {
    vm.return_float(static_cast<float>(point_contents(*in.level, vm.parm_vector(0))));
  });
  set(67, "movetogoal",
      [](Vm& vm, GameContext& in) { move_to_goal(*in.level, vm.get(globals::self), vm.parm_float(0)); });
}

}  // namespace fb::sv
