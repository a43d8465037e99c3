// Coming, signing on, being talked to, changing levels and going.
#include "server/clients/clients.h"

#include <algorithm>

#include "server/clients/split_messages.h"
#include "server/clients/test_clients.h"

namespace fb::sv::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class Signon : public ClientsTest, public ::testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Protocols, Signon, ::testing::Values(15, 666, 999));

TEST_P(Signon, TellsOfTheLevel) {
  start_game(
      "void() main = { lightstyle(3, \"abc\"); total_monsters = 7; found_secrets = 2; world.message = \"Deep\"; "
      "world.sounds = 5; };",
      4, GetParam());
  FakeClient& player = join();
  EXPECT_EQ(player.signon, 3);
  EXPECT_TRUE(slot(0).spawned());
  EXPECT_EQ(player.protocol.version, GetParam());
  const auto info = player.last<svc::ServerInfo>();
  EXPECT_EQ(info.max_clients, 4);
  EXPECT_EQ(info.level_name, "Deep");
  EXPECT_THAT(info.models, ElementsAre("maps/test.bsp", "progs/player.mdl", "progs/box.mdl"));
  EXPECT_THAT(info.sounds, ElementsAre("a.wav"));
  EXPECT_EQ(player.last<svc::CdTrack>().track, 5);
  EXPECT_EQ(player.last<svc::SetView>().entity, 1);
  EXPECT_EQ(player.all<svc::LightStyle>().size(), 64u);
  EXPECT_EQ(player.all<svc::LightStyle>()[3], (svc::LightStyle{3, "abc"}));
  EXPECT_EQ(player.all<svc::UpdateStat>(), (std::vector<svc::UpdateStat>{{11, 0}, {12, 7}, {13, 2}, {14, 0}}));
  EXPECT_THAT(player.all<svc::UpdateName>(), ::testing::Contains(svc::UpdateName{3, ""}));
  EXPECT_EQ(player.last<svc::UpdateName>(), (svc::UpdateName{0, "player"}));
  EXPECT_EQ(player.last<svc::ClientData>().health, 100);
  EXPECT_EQ(number("connects"), 1.0f);
  EXPECT_EQ(number("entries"), 1.0f);
  EXPECT_THAT(player.prints(), Not(HasSubstr("lost")));  // forget_what_was_said
  EXPECT_FALSE(thought_.empty());
}

// Beyond what 16 bits say of a coordinate: protocol 999, so that who is there is seen there. Who asks for 15 gets 15.
TEST_P(Signon, AFarMapIsToldInAProtocolThatReachesIt) {
  for (const float edge : {4096.0f, 6000.0f}) {
    const bool far = edge > 4096.0f;
    bsp_ = std::make_shared<formats::Bsp>(MapBuilder(vec3(-256, -256, 0), vec3(edge, 256, 512)).build());
    const LogWatch log;
    start_game("void() main = { };", 1, GetParam());
    FakeClient& player = join();
    EXPECT_EQ(player.protocol.version, far && GetParam() == 666 ? 999 : GetParam());
    place(1, {edge - 32, 0, 48});
    frame();
    const float seen = player.updates.at(1).origin.x;
    if (far && GetParam() == 15) {
      EXPECT_LT(seen, 4096.0f);
      EXPECT_THAT(log.text(), HasSubstr("the map reaches to 6000 units, and 16 bits to 4096: protocol 15"));
    } else {
      EXPECT_FLOAT_EQ(seen, edge - 32);
      EXPECT_EQ(log.text().find("16 bits") != std::string::npos, far && GetParam() == 666) << log.text();
    }
    fakes_.clear();
    level_.reset();
  }
}

// 666 has no word for it.
TEST_P(Signon, AMapWithScaledEntitiesIsToldInAProtocolThatHasScales) {
  for (const char* scale : {"", "1", "0.5"}) {
    MapBuilder room(vec3(-256, -256, 0), vec3(256, 256, 256));
    room.entities += "{ \"classname\" \"thing\" \"scale\" \"" + std::string(scale) + "\" }";
    bsp_ = std::make_shared<formats::Bsp>(room.build());
    start_game("void() main = { };", 1, GetParam());
    const bool scaled = scale == std::string("0.5");
    EXPECT_EQ(join().protocol.version, scaled && GetParam() == 666 ? 999 : GetParam()) << scale;
    fakes_.clear();
    level_.reset();
  }
}

TEST_P(Signon, IsSplitBetweenMessages) {
  start_game("float i; void() main = { for (i = 0; i < 9000; i = i + 1) ambientsound('1 0 0' * i, \"a.wav\", 1, 3); };",
             1, GetParam());
  FakeClient& player = connect();
  frame(60);
  EXPECT_EQ(player.signon, 3);
  const auto sounds = player.all<svc::SpawnStaticSound>();
  ASSERT_EQ(sounds.size(), 9000u);
  EXPECT_FLOAT_EQ(sounds[2000].origin.x, 2000.0f);
  EXPECT_EQ(sounds[2000].volume, 255);
  EXPECT_EQ(sounds[2000].attenuation, 192);
  EXPECT_LE(*std::max_element(player.sizes.begin(), player.sizes.end()), GetParam() == 15 ? 8000u : 32000u);
}

TEST_P(Signon, EntitiesAreWhereTheyAre) {
  start_game("void() main = {};", 1, GetParam());
  const std::uint32_t before = spawn({100.25f, -200.5f, 30.0f});
  clients_.begin_level(*level_);
  finish_level();
  const std::uint32_t after = spawn({1.0f, 2.0f, 3.0f});
  FakeClient& player = join();
  EXPECT_EQ(player.seen(static_cast<int>(before)).origin, vec3(100.25f, -200.5f, 30.0f));
  EXPECT_EQ(player.updates[static_cast<int>(before)].bits & 0xfffeu & ~net::kUpdateSignal, 0u);  // as its baseline
  EXPECT_EQ(player.seen(static_cast<int>(after)).origin, vec3(1.0f, 2.0f, 3.0f));
  edict(before).set(fields::origin, vec3(-300.125f, -200.5f, 31.0f));
  edict(before).set(fields::angles, vec3(0.0f, 90.0f, 45.0f));
  edict(before).set(fields::frame, 7.0f);
  edict(before).set(fields::skin, 2.0f);
  edict(before).set(fields::effects, 8.0f);
  frame();
  const net::EntityState seen = player.seen(static_cast<int>(before));
  EXPECT_EQ(seen.origin, vec3(-300.125f, -200.5f, 31.0f));
  EXPECT_EQ(seen.angles, vec3(0.0f, 90.0f, 45.0f));
  EXPECT_EQ(seen.frame, 7);
  EXPECT_EQ(seen.skin, 2);
  EXPECT_EQ(seen.effects, 8);
  EXPECT_EQ(seen.model, 3);
  EXPECT_FLOAT_EQ(player.last<svc::Time>().time, static_cast<float>(level_->time));
}

class ClientsBasics : public ClientsTest {};

TEST_F(ClientsBasics, NobodySkipsAStage) {
  start_game();
  FakeClient& player = connect();
  player.answers = false;
  for (const char* command : {"begin", "spawn", "begin"}) {
    player.command(command);
    frame(3);
  }
  EXPECT_FALSE(slot(0).spawned());
  EXPECT_EQ(number("connects"), 0.0f);
  player.command("prespawn");
  frame(3);
  player.command("spawn");
  player.command("spawn");
  frame(3);
  EXPECT_EQ(number("connects"), 1.0f);
  player.command("begin");
  frame(3);
  EXPECT_TRUE(slot(0).spawned());
  player.command("prespawn");
  player.command("spawn");
  frame(3);
  EXPECT_EQ(number("connects"), 1.0f);
}

TEST_F(ClientsBasics, WhoLoadsForLongHearsThatTheServerLives) {
  start_game();
  FakeClient& player = connect();
  player.answers = false;
  frame(2);
  player.forget();
  frame(49);
  EXPECT_EQ(player.all<svc::Nop>().size(), 0u);
  frame(3);
  EXPECT_EQ(player.all<svc::Nop>().size(), 1u);
}

TEST_F(ClientsBasics, TalkReachesWhoItIsFor) {
  start_game(
      "void() shout = { bprint(\"all\"); }; void() whisper = { sprint(self, \"one\"); centerprint(self, \"mid\"); "
      "stuffcmd(self, \"bf\\n\"); };",
      2);
  FakeClient &first = join(), &second = join();
  first.forget();
  second.forget();
  call("shout");
  call("whisper", 2);
  frame(2);
  EXPECT_EQ(first.prints(), "all");
  EXPECT_EQ(second.prints(), "allone");
  EXPECT_EQ(second.last<svc::CenterPrint>().text, "mid");
  EXPECT_EQ(second.last<svc::StuffText>().text, "bf\n");
  EXPECT_TRUE(first.all<svc::StuffText>().empty());
}

TEST_F(ClientsBasics, QuakeCsBytesAreMessages) {
  start_game(R"(
    void(float to) explode = { WriteByte(to, 23); WriteByte(to, 3); WriteCoord(to, 8); WriteCoord(to, 16); WriteCoord(to, -24); };
    void() main = { WriteByte(3, 9); WriteString(3, "welcome"); };
    void() boom = { explode(0); };
    void() boom_one = { msg_entity = self; explode(1); };
    void() boom_all = { explode(2); };
    void() nowhere = { explode(5); };
    void() nobody = { msg_entity = world; explode(1); };
  )",
             2);
  FakeClient &first = join(), &second = join();
  EXPECT_EQ(first.all<svc::StuffText>(), (std::vector<svc::StuffText>{{"welcome"}}));
  const auto count = [&](const FakeClient& fake) { return fake.all<svc::TempEntity>().size(); };
  call("boom");
  frame(2);
  EXPECT_EQ(count(first), 1u);
  EXPECT_EQ(count(second), 1u);
  EXPECT_EQ(first.last<svc::TempEntity>().origin, vec3(8, 16, -24));
  call("boom_one", 2);
  frame(2);
  EXPECT_EQ(count(first), 1u);
  EXPECT_EQ(count(second), 2u);
  call("boom_all");
  frame(2);
  EXPECT_EQ(count(first), 2u);
  EXPECT_EQ(count(second), 3u);
  may_fail_ = true;
  EXPECT_FALSE(clients_.destination(6, EdictId::kWorld));
  EXPECT_FALSE(clients_.destination(1, EdictId::kWorld));
  EXPECT_FALSE(call("nobody"));
}

TEST_F(ClientsBasics, SoundsAndParticles) {
  start_game(
      "void() go = { sound(self, 2, \"a.wav\", 0.5, 2); sound(self, 1, \"b.wav\", 1, 1); particle('1 2 3', "
      "'0 0.5 -20', 73, 20); };");
  FakeClient& player = join();
  place(1, {64, 0, 0});
  call("go", 1);
  frame();
  ASSERT_EQ(player.all<svc::Sound>().size(), 1u);  // the other was not precached
  EXPECT_EQ(player.last<svc::Sound>(), (svc::Sound{1, 2, 1, 127, 128, vec3(64, 0, 0)}));
  EXPECT_EQ(player.last<svc::Particle>(), (svc::Particle{vec3(1, 2, 3), {0, 8, -128}, 20, 73}));
  frame();
  EXPECT_EQ(player.all<svc::Sound>().size(), 1u);
}

TEST_F(ClientsBasics, StaticThingsComeWithTheSignon) {
  start_game();
  const std::uint32_t plain = spawn({1, 2, 3}), glassy = spawn({4, 5, 6}), hidden = spawn({7, 8, 9});
  edict(plain).set(fields::frame, 4.0f);
  edict(plain).set(program_->field<float>("alpha"), 0.5f);  // QuakeC's comes too late
  level_->extra(EdictId{glassy}).alpha = net::encode_alpha(0.5f);
  level_->extra(EdictId{hidden}).alpha = net::kAlphaZero;
  for (const std::uint32_t id : {plain, glassy, hidden}) clients_.make_static(edict(id));
  FakeClient& player = join();
  const auto things = player.all<svc::SpawnStatic>();
  ASSERT_EQ(things.size(), 2u);
  EXPECT_EQ(things[0].state.origin, vec3(1, 2, 3));
  EXPECT_EQ(things[0].state.frame, 4);
  EXPECT_FALSE(things[0].extended);
  EXPECT_TRUE(things[1].extended);
  EXPECT_EQ(things[1].state.alpha, net::encode_alpha(0.5f));
}

// --- going -----------------------------------------------------------------------------------------------------------

TEST_F(ClientsBasics, WhoSaysGoodbyeIsGone) {
  start_game("void() main = {};", 2);
  FakeClient &first = join(), &second = join();
  EXPECT_EQ(clients_.active_count(), 2);
  first.forget();
  second.send(net::clc::Disconnect{});
  frame(3);
  EXPECT_EQ(clients_.active_count(), 1);
  EXPECT_EQ(number("disconnects"), 1.0f);
  EXPECT_EQ(first.last<svc::UpdateName>(), (svc::UpdateName{1, ""}));
  EXPECT_FALSE(second.connection->is_open());
  FakeClient& third = join();
  EXPECT_EQ(third.signon, 3);
  EXPECT_EQ(third.last<svc::SetView>().entity, 2);
}

TEST_F(ClientsBasics, WhoseConnectionEndsIsGone) {
  start_game();
  FakeClient& player = join();
  LogWatch log;
  player.connection->close();
  frame();
  EXPECT_EQ(clients_.active_count(), 0);
  EXPECT_EQ(number("disconnects"), 1.0f);
  EXPECT_THAT(log.text(), HasSubstr("closed by the other side"));
}

TEST_F(ClientsBasics, AFullServerSaysSo) {
  start_game();
  join();
  FakeClient& late = connect();
  frame(2);
  EXPECT_THAT(late.prints(), HasSubstr("full"));
  EXPECT_EQ(late.all<svc::Disconnect>().size(), 1u);
  EXPECT_EQ(clients_.active_count(), 1);
}

TEST_F(ClientsBasics, WhoTakesNothingIsDroppedWithASentence) {
  start_game("void() main = {}; void() talk = { sprint(self, \"0123456789012345678901234567890123456789\"); };", 2);
  FakeClient& listener = join();
  connect();  // never reads: not one of the fakes that frame() asks
  auto deaf = std::move(fakes_.back());
  fakes_.pop_back();
  EXPECT_EQ(clients_.active_count(), 2);
  LogWatch log;
  for (int i = 0; i < 2000 && clients_.active_count() == 2; ++i) {
    call("talk", 2);
    frame();
  }
  EXPECT_EQ(clients_.active_count(), 1);
  EXPECT_THAT(log.text(), HasSubstr("has not taken the 64"));
  EXPECT_TRUE(listener.connection->is_open());
}

TEST_F(ClientsBasics, TheServersEndSaysGoodbye) {
  start_game("void() main = {};", 2);
  FakeClient &first = join(), &second = connect();
  clients_.drop_all(now_);
  first.read(now_);
  second.read(now_);
  EXPECT_EQ(first.all<svc::Disconnect>().size(), 1u);
  EXPECT_EQ(second.all<svc::Disconnect>().size(), 1u);
  EXPECT_EQ(clients_.active_count(), 0);
}

// --- levels ----------------------------------------------------------------------------------------------------------

TEST_F(ClientsBasics, ChangesLevelsWithWhatIsCarried) {
  start_game("void() see = {};");
  FakeClient& player = join();
  EXPECT_EQ(slot(0).spawn_parms[0], 11.0f);
  EXPECT_EQ(slot(0).spawn_parms[15], 16.0f);
  edict(1).set(fields::health, 42.0f);
  frame();
  player.forget();
  clients_.save_spawn_parms();
  clients_.send_reconnect(now_);
  begin_level();
  finish_level();
  EXPECT_FALSE(slot(0).spawned());
  frame(12);
  EXPECT_EQ(player.last<svc::StuffText>().text, "reconnect\n");
  EXPECT_EQ(player.all<svc::ServerInfo>().size(), 1u);
  EXPECT_EQ(player.signon, 3);
  EXPECT_TRUE(slot(0).spawned());
  EXPECT_EQ(level_->vm->get(globals::parm1), 42.0f);
  EXPECT_EQ(number("connects"), 1.0f);  // of this level's QuakeC
  EXPECT_EQ(slot(0).name, "player");
}

TEST_F(ClientsBasics, SavedGamesGoOnAsTheyWere) {
  start_game();
  level_->loaded = true;
  level_->paused = true;
  slot(0).spawn_parms[2] = 33.0f;
  edict(1).set(fields::health, 17.0f);
  FakeClient& player = join();
  EXPECT_TRUE(slot(0).spawned());
  EXPECT_FALSE(level_->paused);
  EXPECT_EQ(number("connects"), 0.0f);
  EXPECT_EQ(player.last<svc::ClientData>().health, 17);
  EXPECT_EQ(slot(0).spawn_parms[2], 33.0f);
}

TEST_F(ClientsBasics, QuakeCGoingWrongIsTheLevelsFault) {
  may_fail_ = true;
  start_game("void() ClientKill_ = {}; void() main = {};");
  join();
  fakes_[0]->command("kill");
  level_->vm->set(program_->global<FunctionId>("ClientKill"), program_->find_function("nothing"));
  frame(2);
  EXPECT_FALSE(level_->failed());  // a null function is no call
}

// --- cutting ---------------------------------------------------------------------------------------------------------

Bytes nops_and_times(int count) {
  net::MessageWriter writer;
  for (int i = 0; i < count; ++i) net::write_server_message(writer, svc::Time{1.0f});
  return writer.bytes();
}

TEST(SplitMessages, CutsBetweenMessages) {
  const Bytes bytes = nops_and_times(7);  // five bytes each
  EXPECT_EQ(whole_messages(bytes, 12, {}), 10u);
  EXPECT_EQ(whole_messages(bytes, 4, {}), 0u);
  EXPECT_EQ(whole_messages(bytes, 35, {}), 35u);
  const auto parts = split_messages(bytes, 12, {});
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].size(), 10u);
  EXPECT_EQ(parts[3].size(), 5u);
  EXPECT_TRUE(split_messages({}, 12, {}).empty());
}

TEST(SplitMessages, WhatCannotBeReadIsNotCut) {
  Bytes bytes = nops_and_times(2);
  bytes.resize(40, 99);  // no such command
  const auto parts = split_messages(bytes, 12, {});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].size(), 10u);
  EXPECT_EQ(parts[1].size(), 30u);
  EXPECT_EQ(whole_messages(bytes, 30, {}), 10u);
}

}  // namespace
}  // namespace fb::sv::testing
