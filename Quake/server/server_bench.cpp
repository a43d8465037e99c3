// A tick of the server: 500 monsters that walk, turn and look ahead, each in every tick, on lq_e1m7; and what of it is
// linking and moving alone. FULLBRIGHT_TEST_DATA (../shared/librequake) names the data.
#include <benchmark/benchmark.h>

#include <memory>
#include <optional>

#include "base/librequake.h"
#include "fs/filesystem.h"
#include "progs/builtins/builtins.h"
#include "progs/builtins/test_builtins.h"
#include "progs/test_compile.h"
#include "server/simulation/link.h"
#include "server/simulation/physics.h"
#include "server/simulation/steps.h"

namespace fb::sv {
namespace {

constexpr const char* kSource = R"(
void(entity e, vector o) setorigin = #2;
void(entity e, vector min, vector max) setsize = #4;
void(vector v1, vector v2, float nomonsters, entity forent) traceline = #16;
float(float yaw, float dist) walkmove = #32;
float() droptofloor = #34;
float(vector v) pointcontents = #41;

float walked, asked;
void() stroll = {
  makevectors(self.angles);
  traceline(self.origin, self.origin + v_forward * 512, 0, self);
  if (trace_fraction < 0.05) self.ideal_yaw = self.ideal_yaw + 90;
  changeyaw();
  asked = asked + 1;
  if (walkmove(self.angles_y, 8)) walked = walked + 1;
  else self.ideal_yaw = random() * 360;
  self.nextthink = time + 0.1;
};
void() main = {
  local vector v;
  local float count;
  local entity e;
  while (count < 500) {
    v_x = random() * 4096 - 1400;
    v_y = random() * 4096 - 1400;
    v_z = random() * 2048 - 2048;
    if (pointcontents(v) == -1) {
      e = spawn();
      self = e;
      e.movetype = 4;
      e.solid = 3;
      e.flags = 32;
      e.yaw_speed = 20;
      e.modelindex = 1;
      setsize(e, '-16 -16 -24', '16 16 40');
      setorigin(e, v);
      if (droptofloor()) {
        e.think = stroll;
        e.nextthink = 1.05;
        count = count + 1;
      } else remove(e);
    }
  }
};
)";

// What the QuakeC above needs of a server.
class Game final : public LevelEvents {
 public:
  static std::unique_ptr<Game> make() {
    fs::FsOptions options;
    options.base_dir = librequake_folder();
    options.user_dir = "";
    const auto files = fs::FileSystem::open(options);
    if (!files) return nullptr;
    const auto bytes = files->load("maps/lq_e1m7.bsp");
    if (!bytes) return nullptr;
    auto bsp = formats::parse_bsp(*bytes, "lq_e1m7");
    const auto compiled = progs::testing::compile(std::string(progs::testing::kBuiltinSource) + kSource, "-O2");
    auto program = progs::load_program(compiled.progs, "bench.dat");
    if (!bsp || !program) return nullptr;
    auto game = std::make_unique<Game>();
    progs::Services services;
    services.rng = &game->rng_;
    progs::BuiltinTable table = progs::standard_builtins(services);
    game->add_builtins(table);
    auto vm = progs::Vm::create(std::make_shared<progs::Program>(std::move(*program)), std::move(table), {});
    if (!vm) return nullptr;
    (*vm)->edicts().start_level(1);
    game->level = std::make_unique<Level>("bench", std::make_shared<formats::Bsp>(std::move(*bsp)), std::move(*vm),
                                          game->console_, *game, game->rng_);
    game->level->run(game->level->vm->program().find_function("main"), EdictId::kWorld);
    return game;
  }
  float number(const char* global) { return level->vm->get(level->vm->program().global<float>(global)); }
  std::unique_ptr<Level> level;

 private:
  void start_sound(EdictId, int, std::string_view, float, float) override {}
  void add_builtins(progs::BuiltinTable& table) {
    using progs::Vm;
    table.set(2, "setorigin", [this](Vm& vm) {
      vm.parm_edict(0).set(fields::origin, vm.parm_vector(1));
      link_edict(*level, vm.parm_entity(0));
    });
    table.set(4, "setsize", [](Vm& vm) {
      vm.parm_edict(0).set(fields::mins, vm.parm_vector(1));
      vm.parm_edict(0).set(fields::maxs, vm.parm_vector(2));
      vm.parm_edict(0).set(fields::size, vm.parm_vector(2) - vm.parm_vector(1));
    });
    table.set(16, "traceline", [this](Vm& vm) {
      const world::Move move{vm.parm_vector(0), vec3(0.0f), vec3(0.0f), vm.parm_vector(1)};
      const MoveTrace trace = sv_move(*level, move, MoveKind::kNormal, vm.parm_entity(3));
      vm.set(globals::trace_fraction, trace.fraction);
    });
    table.set(32, "walkmove", [this](Vm& vm) {
      vm.return_float(walkmove(*level, vm.get(globals::self), vm.parm_float(0), vm.parm_float(1)) ? 1.0f : 0.0f);
    });
    table.set(34, "droptofloor",
              [this](Vm& vm) { vm.return_float(drop_to_floor(*level, vm.get(globals::self)) ? 1.0f : 0.0f); });
    table.set(41, "pointcontents",
              [this](Vm& vm) { vm.return_float(static_cast<float>(point_contents(*level, vm.parm_vector(0)))); });
  }

  con::Console console_;
  Rng rng_{1};
};

void tick(benchmark::State& state) {
  const auto game = Game::make();
  if (!game || game->level->failed()) return state.SkipWithError("no LibreQuake data, or no fteqcc");
  Level& level = *game->level;
  for (auto _ : state) physics(level, [](EdictId) { return false; });
  if (level.failed()) state.SkipWithError(level.error()->message.c_str());
  const auto ticks = static_cast<double>(state.iterations());
  state.counters["thinks"] = game->number("asked") / ticks;
  state.counters["steps"] = game->number("walked") / ticks;
  state.counters["statements"] = static_cast<double>(level.vm->statements_executed()) / ticks;
}
BENCHMARK(tick)->Unit(benchmark::kMillisecond);

// Of one monster, in a level with 500.
void link_one(benchmark::State& state) {
  const auto game = Game::make();
  if (!game || game->level->failed()) return state.SkipWithError("no LibreQuake data, or no fteqcc");
  for (auto _ : state) link_edict(*game->level, EdictId{100}, true);
}
BENCHMARK(link_one);

void move_one(benchmark::State& state) {
  const auto game = Game::make();
  if (!game || game->level->failed()) return state.SkipWithError("no LibreQuake data, or no fteqcc");
  const vec3 end = game->level->edict(EdictId{100}).get(fields::origin) + vec3(8, 0, 0);
  for (auto _ : state) benchmark::DoNotOptimize(move_edict(*game->level, EdictId{100}, end));
}
BENCHMARK(move_one);

}  // namespace
}  // namespace fb::sv
