// A level for tests: QuakeC compiled by fteqcc, a map made in code, and the builtins that moving needs. Skips where
// there is no compiler.
//
//   class PushTest : public LevelTest {};
//   TEST_F(PushTest, LiftsCarry) {
//     MapBuilder map(vec3(-256, -256, 0), vec3(256, 256, 256));
//     start_level("entity ball; void() main = { ball = spawn(); ... };", map);   // main() has run
//     tick(0.1, 5);
//     EXPECT_EQ(named("ball").get(fields::origin), vec3(0, 0, 24));
//   }
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "progs/test_qc.h"
#include "server/simulation/level.h"
#include "server/simulation/level_files.h"
#include "server/simulation/link.h"
#include "server/simulation/physics.h"
#include "server/simulation/steps.h"
#include "server/simulation/test_map.h"

namespace fb::sv::testing {

// QuakeC's declarations of what LevelTest gives, with the numbers of defs.qc.
constexpr const char* kLevelSource = R"(
float MOVETYPE_NONE = 0; float MOVETYPE_WALK = 3; float MOVETYPE_STEP = 4; float MOVETYPE_FLY = 5;
float MOVETYPE_TOSS = 6; float MOVETYPE_PUSH = 7; float MOVETYPE_NOCLIP = 8; float MOVETYPE_FLYMISSILE = 9;
float MOVETYPE_BOUNCE = 10; float MOVETYPE_GIB = 11;
float SOLID_NOT = 0; float SOLID_TRIGGER = 1; float SOLID_BBOX = 2; float SOLID_SLIDEBOX = 3; float SOLID_BSP = 4;
float FL_FLY = 1; float FL_SWIM = 2; float FL_CLIENT = 8; float FL_INWATER = 16; float FL_MONSTER = 32;
float FL_ITEM = 256; float FL_ONGROUND = 512; float FL_PARTIALGROUND = 1024; float FL_WATERJUMP = 2048;
void(entity e, vector o) setorigin = #2;
void(entity e, string m) setmodel = #3;
void(entity e, vector min, vector max) setsize = #4;
void(vector v1, vector v2, float nomonsters, entity forent) traceline = #16;
float(float yaw, float dist) walkmove = #32;
float() droptofloor = #34;
float(entity e) checkbottom = #40;
float(vector v) pointcontents = #41;
void(float step) movetogoal = #67;
)";

struct Sound {
  EdictId source;
  int channel;
  std::string sample;
  float volume, attenuation;
};

class LevelTest : public progs::testing::QcTest, public LevelEvents {
 protected:
  // One client, as edict 1.
  void start_level(const std::string& source, const MapBuilder& map) {
    start_level(source, std::make_shared<formats::Bsp>(map.build()));
  }
  void start_level(const std::string& source, std::shared_ptr<const formats::Bsp> bsp) {
    options_.max_edicts = 1024;
    if (!start(std::string(progs::testing::kBuiltinSource) + kLevelSource + source)) return;
    ASSERT_TRUE(vm_ != nullptr);
    level_ = std::make_unique<Level>("test", std::move(bsp), std::move(vm_), console_, *this, rng_);
    level_->models = map_models("test", level_->bsp, level_->hulls);
    Edict world = level_->world_edict();
    world.set(fields::modelindex, 1.0f);
    world.set(fields::solid, static_cast<float>(kSolidBsp));
    world.set(fields::movetype, static_cast<float>(kMovePush));
    ASSERT_TRUE(call("main")) << level_->error()->message;
    clear_output();
  }
  void TearDown() override {
    if (level_ && level_->failed() && !may_fail_) ADD_FAILURE() << level_->error()->message;
    QcTest::TearDown();
  }

  Level& level() { return *level_; }
  // Runs a function of the test's QuakeC, with the world as self.
  bool call(const std::string& function) {
    return level_->run(level_->vm->program().find_function(function), EdictId::kWorld);
  }
  // The edict that a global of the test's QuakeC holds.
  Edict named(const char* global) {
    return level_->edict(level_->vm->get(level_->vm->program().global<EdictId>(global)));
  }
  float number(const char* global) { return level_->vm->get(level_->vm->program().global<float>(global)); }
  vec3 origin(const char* global) { return named(global).get(fields::origin); }
  vec3 velocity(const char* global) { return named(global).get(fields::velocity); }
  bool on_ground(const char* global) { return named(global).has_flag(fields::flags, kFlagOnGround); }

  void tick(double seconds = 0.1, int count = 1) {
    for (int i = 0; i < count && !level_->failed(); ++i) {
      level_->frame_time = seconds;
      level_->vm->level_time = level_->time;
      level_->vm->set(globals::frametime, static_cast<float>(seconds));
      physics(*level_, [this](EdictId) { return client_is_active_; });
    }
  }

  std::vector<Sound> sounds_;
  bool client_is_active_ = true;
  bool may_fail_ = false;  // the level does so on purpose
  con::Console console_;
  Rng rng_{1};

 private:
  void start_sound(EdictId source, int channel, std::string_view sample, float volume, float attenuation) override {
    sounds_.push_back({source, channel, std::string(sample), volume, attenuation});
  }

  void add_builtins(progs::BuiltinTable& table) override {
    using progs::Vm;
    const auto as_float = [](bool yes) { return yes ? 1.0f : 0.0f; };
    table.set(2, "setorigin", [this](Vm& vm) {
      vm.parm_edict(0).set(fields::origin, vm.parm_vector(1));
      link_edict(*level_, vm.parm_entity(0));
    });
    table.set(3, "setmodel", [this](Vm& vm) {
      Edict edict = vm.parm_edict(0);
      const int number = level_->model_index(vm.parm_string(1));
      edict.set(fields::model, vm.parm_string_id(1));
      edict.set(fields::modelindex, static_cast<float>(number));
      const LevelModel& model = level_->models.at(static_cast<std::size_t>(number));
      set_size(edict, model.mins, model.maxs);
    });
    table.set(4, "setsize", [this](Vm& vm) { set_size(vm.parm_edict(0), vm.parm_vector(1), vm.parm_vector(2)); });
    table.set(16, "traceline", [this](Vm& vm) {
      const world::Move move{vm.parm_vector(0), vec3(0.0f), vec3(0.0f), vm.parm_vector(1)};
      const MoveTrace trace = sv_move(*level_, move, static_cast<MoveKind>(vm.parm_int(2)), vm.parm_entity(3));
      vm.set(globals::trace_fraction, trace.fraction);
      vm.set(globals::trace_endpos, trace.end_pos);
      vm.set(globals::trace_ent, trace.edict.value_or(EdictId::kWorld));
    });
    table.set(32, "walkmove", [=, this](Vm& vm) {
      vm.return_float(as_float(walkmove(*level_, vm.get(globals::self), vm.parm_float(0), vm.parm_float(1))));
    });
    table.set(34, "droptofloor",
              [=, this](Vm& vm) { vm.return_float(as_float(drop_to_floor(*level_, vm.get(globals::self)))); });
    table.set(40, "checkbottom",
              [=, this](Vm& vm) { vm.return_float(as_float(check_bottom(*level_, vm.parm_entity(0)))); });
    table.set(41, "pointcontents",
              [this](Vm& vm) { vm.return_float(static_cast<float>(point_contents(*level_, vm.parm_vector(0)))); });
    table.set(67, "movetogoal", [this](Vm& vm) { move_to_goal(*level_, vm.get(globals::self), vm.parm_float(0)); });
  }
  void set_size(Edict edict, const vec3& mins, const vec3& maxs) {
    edict.set(fields::mins, mins);
    edict.set(fields::maxs, maxs);
    edict.set(fields::size, maxs - mins);
    link_edict(*level_, edict.id());
  }

  std::unique_ptr<Level> level_;
};

}  // namespace fb::sv::testing
