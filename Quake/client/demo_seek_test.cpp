// Seeks in demos: whatever moment is gone to, from wherever, is the one that playing on to it leads to. The moments are
// compared by a number of all that the client knows and shows (test_moment_hash.h).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <numeric>
#include <string>
#include <vector>

#include "base/rng.h"
#include "client/keyframes.h"
#include "client/sources/demo.h"
#include "client/test_demo.h"
#include "client/test_demo_player.h"

namespace fb::cl {
namespace {

using test::DemoBuilder;
using test::DemoPlayer;
using test::Moment;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace svc = net::svc;

svc::TempEntity temp_entity(net::TempEntityType type, const vec3& origin) {
  svc::TempEntity message;
  message.type = type;
  message.origin = origin;
  message.entity = 1;
  message.end = origin + vec3(200, 30, 0);
  return message;
}

// A level in which something happens all the time: `seconds` of it in messages a tenth of a second apart.
void add_level(DemoBuilder& demo, int seconds, float start, int seed) {
  Rng rng(static_cast<std::uint64_t>(seed));
  demo.add({svc::SpawnStaticSound{vec3(8, 0, 0), 1, 255, 64, false}, svc::CdTrack{2 + seed, 2}});
  for (int i = 0; i < 10 * seconds; ++i) {
    const float x = 3.0f * static_cast<float>(i % 20);
    std::vector<net::ServerMessage> more;
    const auto place = [&] { return vec3(rng.uniform(-40, 40), rng.uniform(-40, 40), 8); };
    // A monster that walks in steps, is away now and then, and comes back with another frame.
    svc::EntityUpdate monster = test::update(2, 3, vec3(x, 16, 8), vec3(0, 4.0f * x, 0), net::kUpdateStep);
    monster.bits |= net::kUpdateFrame | net::kUpdateEffects;
    monster.frame = i % 3;
    monster.effects = i % 7 == 0 ? 2 : i % 31 == 0 ? 1 : i % 5 == 0 ? 8 : 0;
    if (i % 40 < 33) more.emplace_back(monster);
    if (i % 4 == 0) more.emplace_back(test::update(3, 4, place()));
    if (i % 6 == 0) more.emplace_back(svc::Particle{place(), {1, 2, 3}, 20, 73});
    if (i % 17 == 0) more.emplace_back(temp_entity(net::TempEntityType::kExplosion, place()));
    if (i % 11 == 0) more.emplace_back(temp_entity(net::TempEntityType::kLightning1, place()));
    if (i % 13 == 0) more.emplace_back(temp_entity(net::TempEntityType::kSpike, place()));
    if (i % 9 == 0) more.emplace_back(svc::Sound{2, i % 4, 1, 255, 64, place()});
    if (i % 23 == 0) more.emplace_back(svc::Damage{5, 10 + i % 7, place()});
    if (i % 19 == 0) more.emplace_back(svc::StuffText{i % 2 ? "bf\n" : "v_cshift 1 2 3 4\nfog 0.2 0.1 0.2 0.3 2\n"});
    if (i % 29 == 0) more.emplace_back(svc::LightStyle{1, i % 2 ? "abc" : "zmm"});
    if (i % 31 == 0) more.emplace_back(svc::UpdateStat{net::kStatSecrets, i});
    if (i % 37 == 0) more.emplace_back(svc::CenterPrint{"look " + std::to_string(i)});
    if (i % 43 == 0) more.emplace_back(svc::Print{"said " + std::to_string(i) + "\n"});
    if (i % 47 == 0) more.emplace_back(svc::CdTrack{1 + i % 3, 1});
    const float stairs = 16.0f * static_cast<float>(i / 8 % 4);
    demo.moment(start + 0.1f * static_cast<float>(i), x, more, 24.0f + stairs);
  }
}

// Two levels, of 24 and 9 seconds.
const Bytes& eventful_demo() {
  static const Bytes bytes = [] {
    DemoBuilder demo;
    add_level(demo, 24, 100.0f, 1);
    demo.add({svc::StuffText{"reconnect\n"}}).level();
    add_level(demo, 9, 1.0f, 2);
    demo.add({svc::Disconnect{}});
    return demo.bytes();
  }();
  return bytes;
}

struct DemoSeek : testing::Test {
  DemoSeek() : files(test::game_files()) { files.files["long.dem"] = eventful_demo(); }
  scene::test::TestFiles files;
};

TEST_F(DemoSeek, LeadsWherePlayingOnLeads) {
  std::vector<Moment> moments;
  {
    DemoPlayer player(files.loader());
    moments = test::play_through(player, "long", 0.5);
  }
  ASSERT_GT(moments.size(), 60u);
  std::vector<std::uint64_t> all;
  for (const Moment& m : moments) all.push_back(m.then);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::unique(all.begin(), all.end()), all.end()) << "moments that cannot be told apart prove nothing";

  DemoPlayer player(files.loader());
  ASSERT_TRUE(player.client.start_demo("long", DemoMode::kPlay).ok());
  for (const Moment& m : moments) test::expect_moment(player, m, "forwards");
  for (auto m = moments.rbegin(); m != moments.rend(); ++m) test::expect_moment(player, *m, "backwards");
  std::vector<std::size_t> order(moments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Rng rng(5);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[rng.below(static_cast<std::uint32_t>(i))]);
  for (const std::size_t i : order) test::expect_moment(player, moments[i], "to and fro");
  for (const std::size_t i : {std::size_t{0}, order[0], moments.size() - 1}) {
    DemoPlayer fresh(files.loader());
    ASSERT_TRUE(fresh.client.start_demo("long", DemoMode::kPlay).ok());
    test::expect_moment(fresh, moments[i], "at once");
  }
}

TEST_F(DemoSeek, StaysInTheDemo) {
  DemoPlayer player(files.loader());
  EXPECT_FALSE(player.client.seek_demo(1.0)) << "nothing plays";
  EXPECT_FALSE(player.client.demo_status());
  ASSERT_TRUE(player.client.start_demo("long", DemoMode::kPlay).ok());
  EXPECT_NEAR(player.client.demo_status()->length, 23.9 + 8.9, 1e-3);
  EXPECT_TRUE(player.client.seek_demo(1e6));
  EXPECT_TRUE(player.client.playing());
  EXPECT_NEAR(player.seconds(), 32.8, 0.05) << "its last frames";
  EXPECT_TRUE(player.client.seek_demo(-5.0));
  EXPECT_NEAR(player.seconds(), 0.0, 0.02);
  EXPECT_FALSE(player.client.seek_demo(std::nan("")));
  ASSERT_TRUE(player.client.start_demo("long", DemoMode::kTime).ok());
  player.client.advance(0.0);
  EXPECT_FALSE(player.client.seek_demo(3.0)) << "a timedemo is measured";
  EXPECT_FALSE(player.client.demo_status());
}

TEST_F(DemoSeek, HasTheSoundsOfItsMomentAndNoOthers) {
  DemoPlayer player(files.loader());
  DemoBuilder demo;
  demo.add({svc::SpawnStaticSound{vec3(8, 0, 0), 1, 255, 64, false}, svc::CdTrack{5, 5}});
  for (int i = 0; i < 100; ++i) {
    std::vector<net::ServerMessage> more;
    if (i % 2 == 0) more.emplace_back(svc::Sound{2, 1, 1, 255, 64, vec3(static_cast<float>(i), 0, 0)});
    if (i == 10) more.emplace_back(svc::Sound{3, 2, 1, 255, 64, vec3(7, 0, 0)});
    if (i == 20) more.emplace_back(svc::Sound{4, 2, 1, 255, 64, vec3(9, 0, 0)});
    if (i == 30) more.emplace_back(svc::StopSound{4, 2});
    if (i == 60) more.emplace_back(svc::CdTrack{6, 6});
    if (i % 50 == 0) more.emplace_back(svc::Print{"\001said\n"});
    demo.moment(1.0f + 0.1f * static_cast<float>(i), 0.0f, more);
  }
  files.files["sounds.dem"] = demo.bytes();
  ASSERT_TRUE(player.client.start_demo("sounds", DemoMode::kPlay).ok());
  player.client.advance(test::kFrame);
  player.heard.clear();
  player.log.clear();
  ASSERT_TRUE(player.client.seek_demo(5.55));
  EXPECT_THAT(player.log, Not(HasSubstr("said"))) << "what is passed over says nothing";
  std::vector<std::string> kinds;
  std::vector<float> places;
  for (const scene::SoundEvent& event : player.heard) {
    if (std::holds_alternative<scene::SoundLevel>(event)) kinds.emplace_back("level");
    if (std::holds_alternative<scene::SoundLoop>(event)) kinds.emplace_back("loop");
    if (std::holds_alternative<scene::SoundTrack>(event)) kinds.emplace_back("track");
    if (const auto* start = std::get_if<scene::SoundStart>(&event)) {
      kinds.emplace_back("start");
      places.push_back(start->origin.x);
      // A message is read, and heard, when the one before it has been reached.
      EXPECT_NEAR(start->age, 5.55 - (start->origin.x == 7.0f ? 0.9 : 5.5), 0.02) << start->origin.x;
    }
  }
  EXPECT_THAT(kinds, ElementsAre("level", "loop", "start", "start")) << "the music plays on";
  EXPECT_THAT(places, ElementsAre(7.0f, 56.0f)) << "the latest of each channel that nothing has stopped";
  player.heard.clear();
  ASSERT_TRUE(player.client.seek_demo(8.0));
  ASSERT_TRUE(!player.heard.empty() && std::holds_alternative<scene::SoundTrack>(player.heard.back()));
  EXPECT_EQ(std::get<scene::SoundTrack>(player.heard.back()).track, 6);
}

TEST_F(DemoSeek, NothingIsHeardWhileItStandsOrGoesBack) {
  DemoPlayer player(files.loader());
  ASSERT_TRUE(player.client.start_demo("long", DemoMode::kPlay).ok());
  ASSERT_TRUE(player.client.seek_demo(10.0));
  player.client.advance(test::kFrame);
  player.heard.clear();
  player.run("demo_pause");
  for (int i = 0; i < 30; ++i) player.client.advance(test::kFrame);
  ASSERT_EQ(player.heard.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<scene::SoundLevel>(player.heard.front())) << "everything stops";
  EXPECT_TRUE(player.client.sound_scene().paused);
  player.run("demo_pause");
  player.run("demo_setspeed -100");
  for (int i = 0; i < 200; ++i) player.client.advance(test::kFrame);
  EXPECT_EQ(player.heard.size(), 1u);
  player.run("demo_setspeed 100");
  player.client.advance(test::kFrame);
  EXPECT_GT(player.heard.size(), 2u);
  EXPECT_FALSE(player.client.sound_scene().paused);
}

TEST_F(DemoSeek, APauseChangesNothing) {
  DemoPlayer player(files.loader()), other(files.loader());
  for (DemoPlayer* p : {&player, &other}) {
    ASSERT_TRUE(p->client.start_demo("long", DemoMode::kPlay).ok());
    for (int i = 0; i < 500; ++i) p->client.advance(test::kFrame);
  }
  const std::uint64_t before = player.hash();
  player.run("demo_pause");
  for (int i = 0; i < 100; ++i) player.client.advance(test::kFrame);
  EXPECT_EQ(player.hash(), before);
  for (const scene::Instance& i : player.snapshot.instances)
    EXPECT_EQ(i.prev_transform, i.transform) << "what stands still has no motion: " << i.id;
  player.run("demo_pause");
  for (DemoPlayer* p : {&player, &other})
    for (int i = 0; i < 100; ++i) p->client.advance(test::kFrame);
  EXPECT_EQ(player.hash(), other.hash());
}

TEST_F(DemoSeek, APauseBeforeTheFirstMomentWaitsForIt) {
  DemoPlayer player(files.loader());
  player.run("playdemo long; demo_pause");
  for (int i = 0; i < 10; ++i) player.client.advance(test::kFrame);
  EXPECT_TRUE(player.client.active());
  EXPECT_EQ(player.seconds(), 0.0);
}

TEST_F(DemoSeek, PlaysBackwardsThroughTheSameMoments) {
  DemoPlayer player(files.loader());
  ASSERT_TRUE(player.client.start_demo("long", DemoMode::kPlay).ok());
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 72 * 26; ++i) {
    player.client.advance(test::kFrame);
    seen.insert(test::hash_of(player.client.session()));
  }
  player.run("demo_setspeed -100");
  const double from = player.seconds();
  double before = from;
  int moved = 0, known = 0;
  for (int i = 0; i < 72 * 20; ++i) {
    player.client.advance(test::kFrame);
    ASSERT_LE(player.seconds(), before + 1e-9);
    moved += player.seconds() < before;
    before = player.seconds();
    known += static_cast<int>(seen.count(test::hash_of(player.client.session())));
  }
  EXPECT_EQ(known, 72 * 20);
  EXPECT_NEAR(before, from - 20.0, 1e-3);
  EXPECT_EQ(moved, 72 * 20);
  EXPECT_TRUE(player.client.active());
  for (int i = 0; i < 72 * 10; ++i) player.client.advance(test::kFrame);
  EXPECT_EQ(player.seconds(), 0.0) << "it waits at its beginning";
  EXPECT_TRUE(player.client.playing());
}

TEST_F(DemoSeek, Commands) {
  DemoPlayer player(files.loader());
  player.run("demo_jump 3");
  EXPECT_THAT(player.log, HasSubstr("demo_jump: no demo is playing"));
  player.run("playdemo long\n");
  player.client.advance(test::kFrame);
  const auto jump = [&](const char* where) {
    player.run(std::string("demo_jump ") + where);
    return player.seconds();
  };
  EXPECT_NEAR(jump("7.5"), 7.5, 0.02);
  EXPECT_NEAR(jump("+5"), 12.5, 0.04);
  EXPECT_NEAR(jump("-10.5"), 2.0, 0.06);
  EXPECT_NEAR(jump("0:30"), 30.0, 0.02) << "in the second level";
  EXPECT_NEAR(jump("-0:20"), 10.0, 0.04) << "and back";
  const double here = player.seconds();
  for (const char* wrong : {"", "x", "1:x", "-", "1:-5", "--3", "1e999", "1 2"}) {
    player.log.clear();
    EXPECT_EQ(jump(wrong), here) << wrong;
    EXPECT_THAT(player.log, HasSubstr("demo_jump [+|-][minutes:]seconds")) << wrong;
  }

  const auto rate = [&] { return player.client.demo_status()->rate; };
  player.run("demo_setspeed 50");
  EXPECT_EQ(rate(), 0.5);
  player.client.advance(0.1);
  EXPECT_NEAR(player.seconds(), here + 0.05, 1e-6);
  player.run("demo_faster; demo_faster");
  EXPECT_EQ(rate(), 2.0);
  for (int i = 0; i < 10; ++i) player.run("demo_faster");
  EXPECT_EQ(rate(), 32.0);
  for (int i = 0; i < 10; ++i) player.run("demo_slower");
  EXPECT_EQ(rate(), 1.0 / 32.0);
  player.run("demo_slower");
  EXPECT_EQ(rate(), 0.0) << "below the slowest it pauses";
  player.run("demo_faster");
  EXPECT_EQ(rate(), 1.0 / 32.0);
  player.run("demo_setspeed 100; +demo_forward");
  EXPECT_EQ(rate(), 5.0);
  player.run("-demo_forward; demo_pause; +demo_rewind");
  EXPECT_EQ(rate(), -5.0);
  player.run("-demo_rewind");
  EXPECT_EQ(rate(), 0.0);
  player.run("demo_setspeed 0; demo_setspeed -1e9");
  EXPECT_EQ(rate(), -32.0);
  player.run("demo_setspeed 100");

  const double from = player.seconds();
  player.run("demo_nudge");
  EXPECT_NEAR(player.seconds(), from + test::kFrame, 1e-3);
  EXPECT_TRUE(player.client.demo_status()->paused);
  player.run("demo_nudge +3; demo_nudge -2");
  EXPECT_NEAR(player.seconds(), from + 2 * test::kFrame, 0.8 * test::kFrame);
}

TEST_F(DemoSeek, NextAndPreviousOfTheList) {
  for (const char* name : {"a.dem", "b.dem", "c.dem"}) files.files[name] = eventful_demo();
  DemoPlayer player(files.loader());
  player.run("demo_next");
  EXPECT_THAT(player.log, HasSubstr("No demos listed with startdemos"));
  player.run("startdemos a b c");
  EXPECT_EQ(player.client.demo_name(), "a.dem");
  player.run("demo_next");
  EXPECT_EQ(player.client.demo_name(), "b.dem");
  player.run("demo_prev; demo_prev");
  EXPECT_EQ(player.client.demo_name(), "c.dem") << "before the first is the last";
  player.run("demo_next");
  EXPECT_EQ(player.client.demo_name(), "a.dem");
  player.run("demo_setspeed 3200");
  for (int i = 0; i < 50 && player.client.demo_name() == "a.dem"; ++i) {
    player.client.advance(0.05);
    player.console.execute();
  }
  EXPECT_EQ(player.client.demo_name(), "b.dem") << "the loop goes on from there";
  EXPECT_EQ(player.client.demo_status()->rate, 1.0) << "each demo begins at its own speed";
  player.run("playdemo long; demo_next");
  EXPECT_EQ(player.client.demo_name(), "a.dem") << "from outside the list to its beginning";
  player.run("stopdemo; demos");
  EXPECT_EQ(player.client.demo_name(), "b.dem") << "as in Quake, a loop that was ended goes on with its second demo";
}

TEST_F(DemoSeek, ABrokenDemoEndsWhereItBreaks) {
  Bytes cut = eventful_demo();
  cut.resize(cut.size() / 2);
  files.files["cut.dem"] = cut;
  DemoPlayer player(files.loader());
  ASSERT_TRUE(player.client.start_demo("cut", DemoMode::kPlay).ok());
  const double length = player.client.demo_status()->length;
  EXPECT_GT(length, 8.0);
  EXPECT_LT(length, 20.0);
  EXPECT_TRUE(player.client.seek_demo(length)) << "as far as it is whole";
  for (int i = 0; i < 72 && player.client.playing(); ++i) player.client.advance(test::kFrame);
  EXPECT_FALSE(player.client.playing());
  ASSERT_TRUE(player.client.last_error());
  EXPECT_THAT(player.client.last_error()->message, HasSubstr("cut.dem"));
}

TEST(DemoIndex, AddsUpItsLevels) {
  const DemoIndex index = read_demo_index(eventful_demo(), "long.dem");
  ASSERT_EQ(index.levels.size(), 2u);
  EXPECT_NEAR(index.levels[0].first_time, 100.0, 1e-4);
  EXPECT_NEAR(index.levels[0].seconds(), 23.9, 1e-4);
  EXPECT_NEAR(index.levels[1].first_time, 1.0, 1e-4);
  EXPECT_NEAR(index.levels[1].begins, 23.9, 1e-4);
  EXPECT_EQ(index.moment_at(-1.0).level, 0u);
  EXPECT_NEAR(index.moment_at(-1.0).time, 100.0, 1e-4);
  EXPECT_NEAR(index.moment_at(20.0).time, 120.0, 1e-4);
  EXPECT_EQ(index.moment_at(25.0).level, 1u);
  EXPECT_NEAR(index.moment_at(25.0).time, 2.1, 1e-3);
  EXPECT_NEAR(index.seconds_at({1, 2.1}), 25.0, 1e-3);
  EXPECT_NEAR(index.seconds_at({1, 1000.0}), 32.8, 1e-3);
  EXPECT_EQ(index.seconds_at({7, 3.0}), 0.0);
}

TEST(DemoIndex, EndsWhereTheDemoDoes) {
  EXPECT_THAT(read_demo_index({}, "").levels, IsEmpty());
  DemoBuilder demo;
  demo.moment(1.0f, 0.0f).moment(3.0f, 0.0f).add({svc::Disconnect{}}).moment(9.0f, 0.0f);
  EXPECT_NEAR(read_demo_index(demo.bytes(), "").seconds(), 2.0, 1e-6);
  DemoBuilder nonsense;
  nonsense.moment(1.0f, 0.0f).add({svc::Time{std::nanf("")}}).moment(9.0f, 0.0f);
  EXPECT_EQ(read_demo_index(nonsense.bytes(), "").seconds(), 0.0);
}

TEST(Keyframes, ThinOutAndKeepTheFirstOfEachLevel) {
  Keyframes keyframes(8);
  const auto add = [&](std::size_t level, double time) {
    if (!keyframes.wants({level, time})) return;
    auto keyframe = std::make_unique<Keyframe>();
    keyframe->moment = {level, time};
    keyframes.add(std::move(keyframe));
  };
  for (std::size_t level = 0; level < 3; ++level)
    for (int i = 0; i < 400; ++i) add(level, 1.0 + i);
  EXPECT_LE(keyframes.count(), 8u);
  EXPECT_GT(keyframes.spacing(), 50.0);
  for (std::size_t level = 0; level < 3; ++level) {
    ASSERT_TRUE(keyframes.before({level, 1.0})) << level;
    EXPECT_EQ(keyframes.before({level, 1.0})->moment.time, 1.0) << level;
    EXPECT_EQ(keyframes.before({level, 0.5}), nullptr) << level;
    EXPECT_EQ(keyframes.before({level, 1e3})->moment.level, level);
  }
  EXPECT_FALSE(keyframes.wants({0, 1.5}));
  EXPECT_TRUE(keyframes.wants({5, 1.5}));
}

}  // namespace
}  // namespace fb::cl
