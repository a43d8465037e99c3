// Lifts, trains and doors against what they carry and push, at many speeds, places, directions and ticks: where nothing
// is in the way, rounding must not make them stop and crush. sv_gameplayfix_elevators 0 is QuakeSpasm's way, which
// does.
//
// As in maps, a lift's model is where the lift is and its origin near 0: so what it carries, far from 0, is rounded
// more coarsely than the lift, in each tick by the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "server/simulation/test_level.h"
#include "server/simulation/test_things.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

// All kinds of riders on a lift whose top is at `place`, and a flying monster before the face that goes ahead.
constexpr const char* kRide = R"(
entity lift, monster, corpse, item, crate, block, pushed;
float blocks, by_player, by_pushed;
void() count_block = {
  blocks = blocks + 1;
  if (other == player) by_player = by_player + 1;
  if (other == pushed) by_pushed = by_pushed + 1;
};
vector place, ahead;
entity(entity e, float how) rider = { e.solid = how; setorigin(e, e.origin); return e; };
entity(float kind, float how, vector org) man = { return rider(make_man(kind, place + org), how); };
void() set_out = {
  if (lift) {
    remove(lift); remove(monster); remove(corpse); remove(item); remove(crate); remove(block); remove(pushed);
  }
  blocks = by_player = by_pushed = 0;
  lift = make_pusher("*1", '0 0 0');
  lift.blocked = count_block;
  lift.nextthink = 100000;
  monster = man(MOVETYPE_STEP, SOLID_SLIDEBOX, '80 80 25');
  corpse = man(MOVETYPE_TOSS, SOLID_NOT, '-80 80 25');
  crate = man(MOVETYPE_STEP, SOLID_BBOX, '80 -80 25');
  item = man(MOVETYPE_TOSS, SOLID_TRIGGER, '0 80 25');
  item.flags = FL_ITEM;
  block = make_man(MOVETYPE_TOSS, place + '0 -90 2');
  setmodel(block, "*2");
  rider(block, SOLID_BSP);
  make_player(place + '-80 -80 25');
  player.flags = FL_CLIENT;
  player.velocity = '0 0 0';
  pushed = man(MOVETYPE_FLY, SOLID_SLIDEBOX, ahead);
};
void() main = {};
)";

struct Ride {
  int lift;
  vec3 velocity;
  double tick;
};
constexpr vec3 kHalf(128.0f, 128.0f, 16.0f);
constexpr float kWay = 600.0f;  // units

class LiftRidersTest : public LevelTest {
 protected:
  // Lifts "*3" and on, each at a place of its own, far from the room's walls.
  void start_rides(const std::vector<vec3>& tops) {
    MapBuilder map(vec3(-8000), vec3(8000));
    map.model(vec3(0), vec3(1));
    map.model(vec3(-8, -8, 0), vec3(8, 8, 16));
    for (const vec3& top : tops) map.model(top - vec3(kHalf.x, kHalf.y, kHalf.z), top + vec3(kHalf.x, kHalf.y, 0.0f));
    tops_ = tops;
    start_level(testing::kThingsSource + std::string(kRide), map);
  }
  template <typename T>
  void set(const char* name, const T& value) {
    level().vm->set(level().vm->program().global<T>(name), value);
  }
  // How often the lift was blocked on its way.
  int ride(const Ride& ride) {
    const vec3 way = glm::normalize(ride.velocity);
    set("place", tops_.at(static_cast<std::size_t>(ride.lift)));
    // Before the face that goes ahead: above or below, or beside the lift's height of 16.
    const auto sign = [](float v) { return std::fabs(v) < 0.1f ? 0.0f : v > 0.0f ? 1.0f : -1.0f; };
    vec3 ahead(sign(way.x) * (kHalf.x + 16.0f + gap_), 0.0f, -16.0f);
    if (ahead.x == 0.0f) ahead.y = sign(way.y) * (kHalf.y + 16.0f + gap_);
    if (ahead.x == 0.0f && ahead.y == 0.0f) ahead.z = way.z > 0.0f ? 24.0f + gap_ : -48.0f - gap_;
    set("ahead", ahead);
    EXPECT_TRUE(call("set_out"));
    Edict lift = named("lift");
    const int index_of_model = level().model_index(fmt::format("*{}", ride.lift + 3));
    const LevelModel& model = level().models.at(static_cast<std::size_t>(index_of_model));
    lift.set(fields::modelindex, static_cast<float>(index_of_model));
    lift.set(fields::mins, model.mins);
    lift.set(fields::maxs, model.maxs);
    link_edict(level(), lift.id());
    tick(0.05, 8);
    lift.set(fields::velocity, ride.velocity);
    tick(ride.tick, static_cast<int>(kWay / glm::length(ride.velocity) / ride.tick));
    return static_cast<int>(number("blocks"));
  }
  float gap_ = 0.3f;  // between the face that goes ahead and what it pushes
  std::vector<vec3> tops_;
};

struct Blocked {
  int rides = 0, by_player = 0, by_others = 0, flattened = 0;
};

// Half of them straight up and slow, in many ticks; the others in all directions, where what stands at the edge does
// not come as far in a tick as what the lift has yet to push.
std::vector<Ride> random_rides(Rng& rng, int count, int lifts) {
  constexpr std::array<double, 4> kTicks = {1.0 / 72.0, 1.0 / 60.0, 0.05, 0.1};
  std::vector<Ride> rides;
  for (int n = 0; n < count; ++n) {
    if (n % 2 == 0) {
      rides.push_back({n / 2 % lifts, vec3(0.0f, 0.0f, rng.uniform(40.0f, 200.0f)), kTicks[0]});
      continue;
    }
    vec3 way(0.0f);
    while (way == vec3(0.0f))
      for (int axis = 0; axis < 3; ++axis) way[axis] = static_cast<float>(rng.below(3)) - 1.0f;
    rides.push_back({n / 2 % lifts, rng.uniform(40.0f, 300.0f) * glm::normalize(way), kTicks[rng.below(4)]});
  }
  return rides;
}

TEST_F(LiftRidersTest, NothingInTheWayIsNothingInTheWay) {
  constexpr int kLifts = 60;
  Rng rng(7);
  std::vector<vec3> tops;
  for (int i = 0; i < kLifts; ++i) {
    const float height = rng.uniform(2100, 3800);
    tops.emplace_back(rng.uniform(-4000, 4000), rng.uniform(-4000, 4000), i % 2 == 0 ? height : -height);
  }
  const std::vector<Ride> rides = random_rides(rng, 240, kLifts);
  start_rides(tops);
  std::array<Blocked, 3> blocked;
  for (std::size_t whom = 0; whom < blocked.size(); ++whom) {
    console_.execute(fmt::format("sv_gameplayfix_elevators {}", whom));
    Blocked& sum = blocked[whom];
    for (const Ride& one : rides) {
      const int blocks = ride(one), by_player = static_cast<int>(number("by_player"));
      sum.rides += blocks > 0 ? 1 : 0;
      sum.by_player += by_player;
      sum.by_others += blocks - by_player;
      for (const char* who : {"corpse", "item"}) sum.flattened += named(who).get(fields::mins).x == 0.0f ? 1 : 0;
      if (whom < 2) continue;
      const std::string at = fmt::format("lift {}, velocity {} {} {}, tick {}", one.lift, one.velocity.x,
                                         one.velocity.y, one.velocity.z, one.tick);
      EXPECT_EQ(blocks, 0) << at;
      for (const char* who : {"monster", "corpse", "crate", "item", "player"}) {
        const vec3 place = origin(who) - origin("lift") - tops[static_cast<std::size_t>(one.lift)];
        EXPECT_NEAR(place.z, 24.0f + 1.0f / 32.0f, 1.0f / 16.0f) << who << ", " << at;
        EXPECT_TRUE(on_ground(who)) << who << ", " << at;
      }
    }
  }
  EXPECT_GT(blocked[0].rides, 0) << "QuakeSpasm's way: else these rides test nothing";
  EXPECT_GT(blocked[0].by_player, 0);
  EXPECT_GT(blocked[0].by_others, 0);
  EXPECT_GT(blocked[0].flattened, 0);
  EXPECT_EQ(blocked[1].by_player, 0);
  EXPECT_GT(blocked[1].by_others, 0);
  EXPECT_EQ(blocked[2].flattened, 0);
}

// A door that goes sideways pushes what stands at its face by as much as it moves, and rounds otherwise.
TEST_F(LiftRidersTest, DoorsPushWithoutStopping) {
  gap_ = 0.002f;
  Rng rng(3);
  std::vector<vec3> tops;
  for (int i = 0; i < 24; ++i)
    tops.emplace_back(rng.uniform(2100, 4000), rng.uniform(-4000, -2100), rng.uniform(-500, 500));
  start_rides(tops);
  constexpr std::array<vec3, 5> kWaysOfDoors = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}}};
  std::array<float, 3> blocked{};
  for (std::size_t whom = 0; whom < blocked.size(); ++whom) {
    console_.execute(fmt::format("sv_gameplayfix_elevators {}", whom));
    for (int i = 0; i < 24; ++i) {
      ride({i, (60.0f + 7.3f * static_cast<float>(i)) * kWaysOfDoors[static_cast<std::size_t>(i % 5)], 1.0 / 72.0});
      blocked[whom] += number("by_pushed");
    }
  }
  EXPECT_GT(blocked[0], 0.0f);
  EXPECT_GT(blocked[1], 0.0f);
  EXPECT_EQ(blocked[2], 0.0f);
}

// What is really in the way stops a lift, also one that is slower than 1/32 of a unit in a tick.
class ObstacleTest : public LevelTest {
 protected:
  // A rider on a lift that rises with this speed under a ceiling 100 above it, and whether it ever got through.
  void rise(float speed, double seconds) {
    MapBuilder map(vec3(-512, -512, 0), vec3(512, 512, 116));
    map.model(vec3(-64, -64, 0), vec3(64, 64, 16));
    start_level(testing::kThingsSource + std::string(R"(
entity lift, rider;
float blocks;
void() count_block = { blocks = blocks + 1; };
void() main = {
  lift = make_pusher("*1", '0 0 0');
  lift.blocked = count_block;
  rider = make_man(MOVETYPE_STEP, '0 0 60');
  make_player('40 40 40.03125');
};)"),
                map);
    tick(0.05, 10);
    named("lift").set(fields::velocity, vec3(0, 0, speed));
    tick(1.0 / 72.0, static_cast<int>(seconds * 72.0));
  }
};

TEST_F(ObstacleTest, ACeilingBlocksAndCrushes) {
  for (const float speed : {1.0f, 60.0f, 1000.0f}) {
    rise(speed, speed < 10.0f ? 60.0 : 4.0);
    EXPECT_GT(number("blocks"), 20.0f) << speed;
    // The room above the lift is 100, a rider's height 56: the lift may rise by 44.
    EXPECT_LE(origin("lift").z, 44.0f + 1e-3f) << speed;
    EXPECT_GE(origin("lift").z, 44.0f - 1.0f / 16.0f - speed / 72.0f) << speed;
    for (const char* who : {"rider", "player"}) EXPECT_LE(origin(who).z, 84.0f) << who << ' ' << speed;
  }
}

// A door that closes on somebody at a wall does not squeeze past.
TEST_F(ObstacleTest, AWallBehindBlocks) {
  for (const float speed : {1.0f, 60.0f}) {
    MapBuilder map(vec3(-512, -512, 0), vec3(200, 512, 256));
    map.model(vec3(-64, -64, 0), vec3(64, 64, 128));
    start_level(testing::kThingsSource + std::string(R"(
entity lift;
float blocks;
void() count_block = { blocks = blocks + 1; };
void() main = {
  lift = make_pusher("*1", '88 0 0');
  lift.blocked = count_block;
  make_player('180 0 24.03125');
};)"),
                map);
    named("lift").set(fields::velocity, vec3(speed, 0, 0));
    tick(1.0 / 72.0, speed < 10.0f ? 3600 : 200);
    EXPECT_GT(number("blocks"), 20.0f) << speed;
    EXPECT_LE(origin("lift").x, 104.0f + 1e-3f) << speed;  // 136 are between, 32 are the player's
    EXPECT_LE(origin("player").x, 184.0f) << speed;
  }
}

// QuakeC that is touched on the ride may take the rider elsewhere: it stays there.
TEST_F(ObstacleTest, ATeleporterOnTheWayTakesARiderOff) {
  MapBuilder map(vec3(-512, -512, 0), vec3(512, 512, 512));
  map.model(vec3(-64, -64, 0), vec3(64, 64, 16));
  start_level(testing::kThingsSource + std::string(R"(
entity lift, rider, gate;
float blocks;
void() count_block = { blocks = blocks + 1; };
void() go = { if (other == rider) { other.flags = 0; setorigin(other, '300 300 24.03125'); } };
void() main = {
  lift = make_pusher("*1", '0 0 0');
  lift.blocked = count_block;
  lift.velocity = '0 0 60';
  rider = make_man(MOVETYPE_STEP, '0 0 40.03125');
  gate = spawn();
  gate.solid = SOLID_TRIGGER;
  gate.touch = go;
  setsize(gate, '-64 -64 0', '64 64 16');
  setorigin(gate, '0 0 200');
};)"),
              map);
  tick(1.0 / 72.0, 300);
  EXPECT_EQ(number("blocks"), 0.0f);
  EXPECT_NEAR(origin("rider").z, 24.0f, 0.1f);
  EXPECT_EQ(origin("rider").x, 300.0f);
  EXPECT_NEAR(origin("lift").z, 250.0f, 0.1f);
}

// DP_SV_ROTATINGBMODEL.
TEST_F(ObstacleTest, ATurntableCarriesWithoutStopping) {
  MapBuilder map(vec3(-8000), vec3(8000));
  const vec3 top(3000.3f, -3500.7f, 2900.9f);
  map.model(top - vec3(200, 200, 16), top + vec3(200, 200, 0));
  start_level(testing::kThingsSource + std::string(R"(
entity lift, one, two;
float blocks;
void() count_block = { blocks = blocks + 1; };
void() main = {
  lift = make_pusher("*1", '0 0 0');
  lift.blocked = count_block;
  one = make_man(MOVETYPE_STEP, '3050 -3500 2926');
  two = make_man(MOVETYPE_TOSS, '2950 -3550 2926');
  make_player('3050 -3600 2926');
};)"),
              map);
  level().asked.rotating_pushers = true;
  tick(0.05, 8);
  named("lift").set(fields::avelocity, vec3(0, 1, 0));
  named("lift").set(fields::velocity, vec3(0, 0, 40));
  tick(1.0 / 72.0, 720);
  EXPECT_EQ(number("blocks"), 0.0f);
  EXPECT_NEAR(origin("lift").z, 400.0f, 0.1f);
  for (const char* who : {"one", "two", "player"}) EXPECT_NEAR(origin(who).z, 400.0f + top.z + 24.0f, 0.1f) << who;
}

}  // namespace
}  // namespace fb::sv
