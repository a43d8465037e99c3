// What edicts and moves meet, and in which order triggers are touched.
#include "server/simulation/link.h"

#include "server/simulation/test_level.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

MapBuilder room() { return MapBuilder(vec3(-512, -512, 0), vec3(512, 512, 512)); }

constexpr const char* kBoxes = R"(
entity(vector org, float kind, vector least, vector most) make = {
  local entity e;
  e = spawn();
  e.solid = kind;
  setsize(e, least, most);
  setorigin(e, org);
  return e;
};
)";

class LinkTest : public LevelTest {
 protected:
  void start_with(const std::string& source) { start_level(std::string(kBoxes) + source, room()); }
  MoveTrace point_move(const vec3& start, const vec3& end, MoveKind kind = MoveKind::kNormal,
                       std::optional<EdictId> pass = std::nullopt) {
    return sv_move(level(), {start, vec3(0.0f), vec3(0.0f), end}, kind, pass);
  }
};

TEST_F(LinkTest, LinkedBoxesAreAUnitWiderAndItemsFifteenToTheSides) {
  start_with(R"(
entity thing, item;
void() main = {
  thing = make('10 20 30', SOLID_BBOX, '-1 -2 -3', '1 2 3');
  item = make('10 20 30', SOLID_TRIGGER, '-1 -2 -3', '1 2 3');
  item.flags = FL_ITEM;
  setorigin(item, '10 20 30');
};)");
  EXPECT_EQ(named("thing").get(fields::absmin), vec3(8, 17, 26));
  EXPECT_EQ(named("thing").get(fields::absmax), vec3(12, 23, 34));
  EXPECT_EQ(named("item").get(fields::absmin), vec3(-6, 3, 27));
  EXPECT_EQ(named("item").get(fields::absmax), vec3(26, 37, 33));
}

TEST_F(LinkTest, LeafsAreThoseOfTheBoxAndOnlyWithAModel) {
  start_with(R"(
entity plain, modelled;
void() main = {
  plain = make('0 0 100', SOLID_NOT, '-8 -8 -8', '8 8 8');
  modelled = make('0 0 100', SOLID_NOT, '-8 -8 -8', '8 8 8');
  modelled.modelindex = 1;
  setorigin(modelled, '0 0 100');
};)");
  EXPECT_EQ(level().extra(named("plain").id()).leafs.count, 0u);
  EXPECT_EQ(level().extra(named("modelled").id()).leafs.count, 1u);
}

TEST_F(LinkTest, MovesMeetTheWorldAndWhatIsSolid) {
  start_with("entity a; void() main = { a = make('100 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16'); };");
  const MoveTrace hit = point_move(vec3(0, 0, 100), vec3(200, 0, 100));
  EXPECT_FLOAT_EQ(hit.end_pos.x, 84.0f - 1.0f / 32.0f);
  EXPECT_EQ(hit.edict, named("a").id());
  EXPECT_EQ(hit.plane.normal, vec3(-1, 0, 0));
  const MoveTrace floor = point_move(vec3(0, 0, 100), vec3(0, 0, -100));
  EXPECT_EQ(floor.edict, EdictId::kWorld);
  EXPECT_FLOAT_EQ(floor.end_pos.z, 1.0f / 32.0f);
  EXPECT_EQ(point_move(vec3(0, 0, 100), vec3(0, 200, 100)).edict, std::nullopt);
  EXPECT_EQ(point_move(vec3(100, 0, 100), vec3(200, 0, 100)).edict, named("a").id());  // starts in it
}

TEST_F(LinkTest, NoMonstersPassesBoxesAndTriggersNeverBlock) {
  start_with(R"(
entity a, t;
void() main = {
  a = make('100 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
  t = make('50 0 100', SOLID_TRIGGER, '-16 -16 -16', '16 16 16');
};)");
  EXPECT_EQ(point_move(vec3(0, 0, 100), vec3(200, 0, 100)).edict, named("a").id());
  EXPECT_EQ(point_move(vec3(0, 0, 100), vec3(200, 0, 100), MoveKind::kNoMonsters).fraction, 1.0f);
  // QuakeC changed what it is and has not linked it: no harm.
  named("a").set(fields::solid, static_cast<float>(kSolidTrigger));
  EXPECT_EQ(point_move(vec3(0, 0, 100), vec3(200, 0, 100)).fraction, 1.0f);
}

TEST_F(LinkTest, OwnersAndTheirMissilesPass) {
  start_with(R"(
entity shooter, missile, other_one;
void() main = {
  shooter = make('0 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
  missile = make('0 0 100', SOLID_BBOX, '0 0 0', '0 0 0');
  other_one = make('100 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
  missile.owner = shooter;
};)");
  const vec3 start(0, 0, 100), end(200, 0, 100);
  EXPECT_EQ(point_move(start, end, MoveKind::kNormal, named("missile").id()).edict, named("other_one").id());
  EXPECT_EQ(point_move(start, end, MoveKind::kNormal, named("other_one").id()).edict, named("shooter").id());
  named("other_one").set(fields::owner, named("missile").id());
  EXPECT_EQ(point_move(start, end, MoveKind::kNormal, named("missile").id()).fraction, 1.0f);
}

// A traceline that passes the world meets nothing without an owner, as everything else is the world's own.
TEST_F(LinkTest, WhatNobodyOwnsIsTheWorldsOwn) {
  start_with(R"(
entity a;
float fraction, owned_fraction;
void() main = {
  a = make('100 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
  traceline('0 0 100', '200 0 100', 0, world);
  fraction = trace_fraction;
  a.owner = nextent(world);
  traceline('0 0 100', '200 0 100', 0, world);
  owned_fraction = trace_fraction;
};)");
  EXPECT_EQ(number("fraction"), 1.0f);
  EXPECT_LT(number("owned_fraction"), 1.0f);
}

TEST_F(LinkTest, PointsDoNotMeetEachOtherAndMissilesAreWideToMonsters) {
  start_with(R"(
entity box, point, monster;
void() main = {
  box = make('0 0 100', SOLID_BBOX, '-8 -8 -8', '8 8 8');
  point = make('100 0 100', SOLID_BBOX, '0 0 0', '0 0 0');
  monster = make('0 100 100', SOLID_BBOX, '-16 -16 -24', '16 16 40');
  monster.flags = FL_MONSTER;
};)");
  EXPECT_EQ(move_edict(level(), named("box").id(), vec3(200, 0, 100)).fraction, 1.0f);
  // 28 to the side of the monster's middle: 12 from its box.
  const vec3 start(28, 0, 100), end(28, 200, 100);
  EXPECT_EQ(point_move(start, end).fraction, 1.0f);
  EXPECT_EQ(point_move(start, end, MoveKind::kMissile).edict, named("monster").id());
  named("monster").set(fields::flags, 0.0f);
  EXPECT_EQ(point_move(start, end, MoveKind::kMissile).fraction, 1.0f);
}

TEST_F(LinkTest, MapModelsBlockWhereTheyStand) {
  MapBuilder map = room();
  map.model(vec3(-32, -32, 0), vec3(32, 32, 64));
  start_level(R"(
entity door;
void() main = {
  door = spawn();
  door.solid = SOLID_BSP;
  door.movetype = MOVETYPE_PUSH;
  setmodel(door, "*1");
  setorigin(door, '100 0 0');
};)",
              map);
  const MoveTrace hit = point_move(vec3(0, 0, 32), vec3(200, 0, 32));
  EXPECT_FLOAT_EQ(hit.end_pos.x, 68.0f - 1.0f / 32.0f);
  EXPECT_EQ(hit.edict, named("door").id());
  EXPECT_EQ(point_move(vec3(0, 0, 32), vec3(200, 0, 32), MoveKind::kNoMonsters).edict, named("door").id());
  // A box of the player's size stops where its side would touch.
  const world::Move box{vec3(0, 0, 32), vec3(-16, -16, -24), vec3(16, 16, 32), vec3(200, 0, 32)};
  EXPECT_FLOAT_EQ(sv_move(level(), box, MoveKind::kNormal, std::nullopt).end_pos.x, 52.0f - 1.0f / 32.0f);
}

TEST_F(LinkTest, ASolidBspWithoutAModelBlocksAsItsBox) {
  start_with("entity a; void() main = { a = make('100 0 100', SOLID_BSP, '-16 -16 -16', '16 16 16'); };");
  const MoveTrace hit = point_move(vec3(0, 0, 100), vec3(200, 0, 100));
  EXPECT_FALSE(level().failed());
  EXPECT_EQ(hit.edict, named("a").id());
  EXPECT_FLOAT_EQ(hit.end_pos.x, 84.0f - 1.0f / 32.0f);
}

TEST_F(LinkTest, ContentsAreTheWorlds) {
  MapBuilder map = room();
  map.box(vec3(-512, -512, 0), vec3(0, 512, 64), formats::kContentsWater);
  start_level("float c; void() main = { c = pointcontents('-10 0 10'); };", map);
  EXPECT_EQ(number("c"), -3.0f);
  EXPECT_EQ(point_contents(level(), vec3(10, 0, 10)), formats::kContentsEmpty);
  EXPECT_EQ(point_contents(level(), vec3(10, 0, -10)), formats::kContentsSolid);
}

// --- triggers ---

constexpr const char* kTriggers = R"(
entity mover;
void() say_name = { puts(self.netname); pute(other); };
entity(string name, void() what) trigger = {
  local entity e;
  e = make('0 0 100', SOLID_TRIGGER, '-32 -32 -32', '32 32 32');
  e.netname = name;
  e.touch = what;
  return e;
};
)";

class TriggerTest : public LinkTest {
 protected:
  void start_with_triggers(const std::string& main) { start_with(std::string(kTriggers) + main); }
  std::string touched() {
    clear_output();
    link_edict(level(), named("mover").id(), true);
    return output();
  }
};

TEST_F(TriggerTest, AreTouchedInTheOrderInWhichTheyWereLinked) {
  start_with_triggers(R"(
entity one;
void() main = {
  one = trigger("one", say_name);
  trigger("two", say_name);
  trigger("three", say_name);
  mover = make('0 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
};)");
  EXPECT_EQ(touched(), "[one] e5 [two] e5 [three] e5");
  link_edict(level(), named("one").id());
  EXPECT_EQ(touched(), "[two] e5 [three] e5 [one] e5");
  // Who is not solid is in no list and touches nothing.
  named("mover").set(fields::solid, 0.0f);
  EXPECT_EQ(touched(), "");
}

TEST_F(TriggerTest, WhatIsRemovedOrLeftBehindIsNotTouched) {
  start_with_triggers(R"(
entity two;
void() remove_two = { puts(self.netname); remove(two); };
void() send_away = { puts(self.netname); setorigin(other, '0 0 300'); };
void() main = {
  trigger("one", remove_two);
  two = trigger("two", say_name);
  trigger("three", send_away);
  trigger("four", say_name);
  mover = make('0 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
};)");
  EXPECT_EQ(touched(), "[one] [three]");
  EXPECT_EQ(origin("mover"), vec3(0, 0, 300));
}

TEST_F(TriggerTest, SelfAndOtherAreWhatTheyWereBefore) {
  start_with_triggers(R"(
void() main = {
  trigger("one", say_name);
  mover = make('0 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
  mover.flags = FL_FLY;
  self = mover;
  other = nextent(world);
};
void() step = { walkmove(0, 1); pute(self); pute(other); };)");
  progs::Vm& vm = *level().vm;
  vm.set(globals::self, named("mover").id());
  vm.set(globals::other, EdictId{1});
  ASSERT_TRUE(vm.execute(vm.program().find_function("step")).ok());
  EXPECT_EQ(output(), "[one] e3 e3 e1");
}

TEST_F(TriggerTest, TimeIsTheLevels) {
  start_with_triggers(R"(
float at;
void() note_time = { at = time; };
void() main = {
  trigger("one", note_time);
  mover = make('0 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
};)");
  level().time = 7.25;
  touched();
  EXPECT_EQ(number("at"), 7.25f);
}

TEST_F(TriggerTest, AnErrorOfQuakeCStopsTheTouching) {
  start_with_triggers(R"(
void() fail = { error("broken"); };
void() main = {
  trigger("one", fail);
  trigger("two", say_name);
  mover = make('0 0 100', SOLID_BBOX, '-16 -16 -16', '16 16 16');
};)");
  may_fail_ = true;
  EXPECT_EQ(touched(), "");
  EXPECT_TRUE(level().failed());
}

}  // namespace
}  // namespace fb::sv
