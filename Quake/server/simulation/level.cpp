#include "server/simulation/level.h"

#include <algorithm>

#include "base/log.h"

namespace fb::sv {
namespace {

const con::Cvar& cvar(con::Console& console, std::string name, std::string value, std::string help,
                      unsigned flags = con::kCvarPlain) {
  if (const con::Cvar* known = console.find_cvar(name)) return *known;
  return console.add_cvar(std::move(name), std::move(value), std::move(help), flags);
}

}  // namespace

Cvars::Cvars(con::Console& console)
    : gravity(cvar(console, "sv_gravity", "800", "gravity, units per second squared")),
      max_velocity(cvar(console, "sv_maxvelocity", "2000", "largest velocity along each axis, units a second")),
      friction(cvar(console, "sv_friction", "4", "ground friction of players, 1/s")),
      edge_friction(cvar(console, "edgefriction", "2", "factor on sv_friction at the edge of a drop")),
      stop_speed(
          cvar(console, "sv_stopspeed", "100", "below this speed friction stays that of this speed, units a second")),
      max_speed(cvar(console, "sv_maxspeed", "320", "largest running speed, units a second")),
      accelerate(cvar(console, "sv_accelerate", "10", "acceleration of players on the ground, 1/s")),
      no_step(cvar(console, "sv_nostep", "0", "1: players cannot climb stairs")),
      aim(cvar(console, "sv_aim", "1", "auto-aim: cosine of the angle within which shots turn to a target; 1: off",
               con::kCvarArchive)),
      ideal_pitch_scale(
          cvar(console, "sv_idealpitchscale", "0.8", "how far the view pitches to follow slopes and stairs")),
      skill(cvar(console, "skill", "1", "0 easy, 1 normal, 2 hard, 3 nightmare; takes effect at the next level")),
      deathmatch(cvar(console, "deathmatch", "0", "1 or more: deathmatch; takes effect at the next level")),
      coop(cvar(console, "coop", "0", "1: cooperative play; takes effect at the next level")),
      teamplay(cvar(console, "teamplay", "0", "team rules of deathmatch, as the mod defines them")),
      nomonsters(
          cvar(console, "nomonsters", "0", "1: levels start without monsters (entities whose class is monster_*)")),
      pausable(cvar(console, "pausable", "1", "1: players may pause the game")),
      max_edicts(cvar(console, "max_edicts", "32000", "most edicts of a level; takes effect at the next level")),
      alt_noclip(cvar(console, "sv_altnoclip", "1", "1: noclip moves along the view direction", con::kCvarArchive)),
      freeze_nonclients(cvar(console, "sv_freezenonclients", "0", "1: only players move")),
      roll_angle(cvar(console, "cl_rollangle", "2.0", "most roll of the view when moving sideways, degrees")),
      roll_speed(
          cvar(console, "cl_rollspeed", "200", "sideways speed at which the view's roll is full, units a second")),
      clear_liquids(
          cvar(console, "sv_clearliquids", "-1",
               "what is sent in maps whose visibility takes liquids for opaque: 0 what it lets through, 1 what is "
               "behind surfaces of water and slime, too, -1: 1 in a game played alone")),
      elevators(
          cvar(console, "sv_gameplayfix_elevators", "2",
               "whom lifts and doors do not stop at, nor crush, for a rounding error where nothing is in the way: "
               "0 nobody, as in QuakeSpasm, 1 players, 2 everything",
               con::kCvarArchive)) {}

OptionalFields::OptionalFields(const progs::Program& program)
    : gravity(program.field<float>("gravity")),
      alpha(program.field<float>("alpha")),
      scale(program.field<float>("scale")),
      items2(program.field<float>("items2")) {}

Level::Level(std::string map_name, std::shared_ptr<const formats::Bsp> map, std::unique_ptr<progs::Vm> machine,
             con::Console& console, LevelEvents& events, Rng& rng)
    : map_name(std::move(map_name)),
      bsp(std::move(map)),
      hulls(std::make_shared<world::MapHulls>(*bsp)),
      liquid_windows(*bsp),
      areas(bsp->models.at(0).mins - vec3(1.0f), bsp->models.at(0).maxs + vec3(1.0f)),  // as QuakeSpasm spreads models
      vm(std::move(machine)),
      autocvars(*vm, console),
      cvars(console),
      optional(vm->program()),
      localization(console.localization()),
      events(events),
      rng(rng) {
  vm->edicts().set_listener(this);
}
Level::~Level() { vm->edicts().set_listener(nullptr); }

std::string_view Level::title() const {
  return localization.text(vm->text(vm->edict(EdictId::kWorld).get(progs::fields::message)));
}

int Level::model_index(std::string_view name) const {
  if (name.empty()) return 0;
  for (std::size_t i = 1; i < models.size(); ++i)
    if (models[i].name == name) return static_cast<int>(i);
  return 0;
}

int Level::sound_index(std::string_view name) const {
  for (std::size_t i = 1; i < sounds.size(); ++i)
    if (sounds[i] == name) return static_cast<int>(i);
  return 0;
}

void Level::warn_once(const std::string& sentence) {
  if (warnings_.insert(sentence).second) log_warning("{}", sentence);
}

EdictExtra& Level::extra(EdictId id) {
  if (index(id) >= extra_.size()) extra_.resize(std::max<std::size_t>(index(id) + 1, edicts().count()));
  return extra_[index(id)];
}

bool Level::run(FunctionId function, EdictId self, EdictId other) { return run_at(function, self, other, time); }

bool Level::run_at(FunctionId function, EdictId self, EdictId other, double at) {
  if (failed()) return false;
  if (function == FunctionId::kNull) return true;
  vm->set(progs::globals::self, self);
  vm->set(progs::globals::other, other);
  vm->set(progs::globals::time, static_cast<float>(at));
  if (Status status = vm->execute(function); !status) fail(status.error().message);
  return !failed();
}

void Level::fail(std::string cause) {
  if (!error_) error_ = Error{std::move(cause)};
}

void Level::edict_cleared(EdictId id) {
  areas.unlink(static_cast<int>(index(id)));
  EdictExtra fresh;
  fresh.baseline = extra(id).baseline;  // clients keep what they were told as they came, whoever has the number now
  extra(id) = fresh;
}
void Level::edict_freed(EdictId id) { areas.unlink(static_cast<int>(index(id))); }

}  // namespace fb::sv
