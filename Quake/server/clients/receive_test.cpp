// What players may say, and what happens to those who say what they may not.
#include "server/clients/test_clients.h"

#include <algorithm>

namespace fb::sv::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ReceiveTest : public ClientsTest {};

TEST_F(ReceiveTest, MovesReachTheEdict) {
  for (const int protocol : {15, 666, 999}) {
    start_game("void() main = {};", 1, protocol);
    FakeClient& player = join();
    player.send(net::clc::Move{static_cast<float>(level_->time) - 0.25f, vec3(10, 90, 0), 400, -350, 200, 3, 7});
    frame();
    EXPECT_EQ(slot(0).move.forward, 400);
    EXPECT_EQ(slot(0).move.side, -350);
    EXPECT_EQ(slot(0).move.up, 200);
    EXPECT_NEAR(edict(1).get(fields::v_angle).x, 10.0f, protocol == 15 ? 0.71f : 0.003f);
    EXPECT_EQ(edict(1).get(fields::v_angle).y, 90.0f);
    EXPECT_EQ(edict(1).get(fields::button0), 1.0f);
    EXPECT_EQ(edict(1).get(fields::button2), 1.0f);
    EXPECT_EQ(edict(1).get(fields::impulse), 7.0f);
    EXPECT_NEAR(slot(0).average_ping(), 0.25f, 1e-5f);
    clients_.drop_all(now_);
    fakes_.clear();
  }
}

TEST_F(ReceiveTest, ThinksAfterItsMessagesInOrderOfSlots) {
  start_game("void() main = {};", 3);
  join();
  connect().answers = false;
  join();
  frame(10);
  thought_.clear();
  frame();
  EXPECT_THAT(thought_, ::testing::ElementsAre(0, 2));
}

TEST_F(ReceiveTest, NonsenseEndsItsSendersGame) {
  const std::vector<Bytes> nonsense = {
      {77}, {3, 1, 2}, {4, 'h', 'i'}, {3, 0, 0, 0xc0, 0x7f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
  for (const Bytes& bytes : nonsense) {
    LogWatch log;
    start_game("void() main = {};", 2);
    FakeClient& bad = join();
    join();
    EXPECT_TRUE(bad.connection->send_unreliable(bytes, now_));
    frame();
    EXPECT_EQ(clients_.active_count(), 1);
    EXPECT_THAT(log.text(), HasSubstr("a client's command"));
    clients_.drop_all(now_);
    fakes_.clear();
  }
}

TEST_F(ReceiveTest, NothingReachesTheConsole) {
  int ran = 0;
  console_.add_command("quit", "", [&](const con::Args&) { ++ran; });
  start_game();
  FakeClient& player = join();
  for (const char* text :
       {"quit", "sv_gravity 0", "say hi; quit", "kill;quit", "map start", "", "   ", "\"", "god\nquit"})
    player.command(text);
  frame(4);
  console_.execute();
  EXPECT_EQ(ran, 0);
  EXPECT_EQ(level_->cvars.gravity.value(), 800.0f);
  EXPECT_TRUE(slot(0).spawned());
}

TEST_F(ReceiveTest, FloodsAreNotHeard) {
  start_game("void() main = {};", 2);
  FakeClient& listener = join();
  FakeClient& flooder = join(true);
  listener.forget();
  for (int i = 0; i < 1000; ++i) flooder.command("say spam");
  frame(4);
  const std::string heard = listener.prints();
  const auto lines = std::count(heard.begin(), heard.end(), '\n');
  EXPECT_GT(lines, 0);
  EXPECT_LT(lines, 20);
  EXPECT_THAT(flooder.prints(), HasSubstr("too fast"));
  frame(50);  // five seconds of silence
  listener.forget();
  flooder.command("say sorry");
  frame(3);
  EXPECT_THAT(listener.prints(), HasSubstr("player: sorry"));
}

// --- commands --------------------------------------------------------------------------------------------------------

TEST_F(ReceiveTest, NamesAndColours) {
  start_game("void() main = {};", 2);
  FakeClient &first = join(), &second = join();
  second.forget();
  first.command("name \"a name that is much too long\"");
  first.command("color 15 2");
  frame(3);
  EXPECT_EQ(slot(0).name, "a name that is ");
  EXPECT_EQ(second.last<svc::UpdateName>(), (svc::UpdateName{0, "a name that is "}));
  EXPECT_EQ(second.last<svc::UpdateColors>(), (svc::UpdateColors{0, 13 * 16 + 2}));
  EXPECT_EQ(edict(1).get(fields::team), 3.0f);
  EXPECT_EQ(level_->vm->text(edict(1).get(fields::netname)), "a name that is ");
  first.command("name \"evil\nServer: obey\"");
  frame(3);
  EXPECT_EQ(slot(0).name, "evilServer: ob");
}

TEST_F(ReceiveTest, SayingAndTelling) {
  start_game("void() main = {};", 3);
  FakeClient &first = join(), &second = join(), &third = join();
  second.command("name bob");
  frame(3);
  for (FakeClient* fake : {&first, &second, &third}) fake->forget();
  first.command("say \"hello there\"");
  frame(3);
  for (FakeClient* fake : {&first, &second, &third}) EXPECT_EQ(fake->prints(), "\x01player: hello there\n");
  first.command("tell bob the door is open");
  frame(3);
  EXPECT_THAT(second.prints(), HasSubstr("player: the door is open\n"));
  EXPECT_THAT(third.prints(), Not(HasSubstr("door")));
  console_.set("teamplay", "1");
  edict(3).set(fields::team, 9.0f);
  first.command("say_team secret");
  frame(3);
  EXPECT_THAT(second.prints(), HasSubstr("secret"));
  EXPECT_THAT(third.prints(), Not(HasSubstr("secret")));
}

TEST_F(ReceiveTest, WhoPlaysHereReadsEverythingOnce) {
  start_game("void() main = {};", 3);
  FakeClient& remote = join(true);
  LogWatch log;
  remote.command("say is anybody there");
  frame(3);
  EXPECT_EQ(log.text(), "player: is anybody there\n") << "a server's own console says it where nobody plays";
  FakeClient& host = join();
  EXPECT_THAT(log.text(), HasSubstr("player entered the game"));
  const std::size_t before = log.text().size();
  FakeClient& third = join(true);
  third.command("name carol");
  frame(3);
  host.forget();
  remote.command("say hello");
  host.command("say welcome");
  frame(3);
  EXPECT_THAT(host.prints(), HasSubstr("\x01player: hello\n"));
  EXPECT_THAT(host.prints(), HasSubstr("\x01player: welcome\n"));
  console_.set("teamplay", "1");
  edict(2).set(fields::team, 9.0f);
  remote.command("say_team secret");
  frame(3);
  EXPECT_THAT(third.prints(), HasSubstr("secret"));
  EXPECT_THAT(host.prints(), Not(HasSubstr("secret")));
  EXPECT_EQ(log.text().substr(before), "player renamed to carol\n") << "nothing twice, and nothing of the other team's";
}

TEST_F(ReceiveTest, KillAsksQuakeC) {
  start_game();
  FakeClient& player = join();
  player.command("kill");
  frame(2);
  EXPECT_EQ(number("kills"), 1.0f);
  edict(1).set(fields::health, 0.0f);
  player.command("kill");
  frame(2);
  EXPECT_EQ(number("kills"), 1.0f);
  EXPECT_THAT(player.prints(), HasSubstr("already dead"));
}

TEST_F(ReceiveTest, PauseTellsAll) {
  start_game("void() main = {};", 2);
  FakeClient &first = join(), &second = join();
  first.command("pause");
  frame(3);
  EXPECT_TRUE(level_->paused);
  EXPECT_TRUE(second.last<svc::SetPause>().paused);
  EXPECT_THAT(second.prints(), HasSubstr("player paused the game"));
  console_.set("pausable", "0");
  first.command("pause");
  frame(3);
  EXPECT_TRUE(level_->paused);
}

TEST_F(ReceiveTest, CheatsAreNotForDeathmatch) {
  start_game();
  FakeClient& player = join();
  player.command("god");
  player.command("give 7");
  player.command("give h 250");
  player.command("give a 120");
  player.command("notarget 1");
  frame(3);
  EXPECT_TRUE(edict(1).has_flag(fields::flags, kFlagGodMode));
  EXPECT_TRUE(edict(1).has_flag(fields::flags, kFlagNoTarget));
  EXPECT_THAT(player.prints(), HasSubstr("godmode ON"));
  EXPECT_EQ(edict(1).get(fields::health), 250.0f);
  EXPECT_EQ(edict(1).get(fields::items), 32.0f + 16384.0f);
  EXPECT_EQ(edict(1).get(fields::armortype), 0.6f);
  player.command("noclip");
  frame(3);
  EXPECT_EQ(edict(1).get(fields::movetype), static_cast<float>(kMoveNoClip));
  player.command("noclip");
  player.command("setpos 10 20 30 5 6 7");
  frame(3);
  EXPECT_EQ(edict(1).get(fields::origin), vec3(10, 20, 30));
  EXPECT_EQ(edict(1).get(fields::movetype), static_cast<float>(kMoveNoClip));
  EXPECT_EQ(player.last<svc::SetAngle>().angles.y, 5.625f);  // to the nearest 256th of a turn
  for (const char* wrong : {"give h abc", "give a nan", "setpos nan 0 0", "setpos 0 inf 0", "setpos 0 0 1e9"})
    player.command(wrong);
  frame(3);
  EXPECT_EQ(edict(1).get(fields::health), 250.0f);
  EXPECT_EQ(edict(1).get(fields::origin), vec3(10, 20, 30));
  EXPECT_THAT(player.prints(), HasSubstr("give h abc: a number from -1000000 to 1000000 is wanted"));
  EXPECT_THAT(player.prints(), HasSubstr("setpos 1e9: a number from -1000000 to 1000000 is wanted"));
  level_->vm->set(globals::deathmatch, 1.0f);
  player.command("god 0");
  frame(3);
  EXPECT_TRUE(edict(1).has_flag(fields::flags, kFlagGodMode));
}

TEST_F(ReceiveTest, StatusShowsAddressesToTheHostAlone) {
  start_game("void() main = {};", 3);
  FakeClient& host = join();
  FakeClient& guest = join(true);
  for (FakeClient* fake : {&host, &guest}) {
    fake->command("status");
    fake->command("ping");
  }
  frame(3);
  EXPECT_THAT(host.prints(), HasSubstr("players: 2 active (3 max)"));
  EXPECT_THAT(host.prints(), HasSubstr("192.0.2.1"));
  EXPECT_THAT(guest.prints(), HasSubstr("players: 2 active (3 max)"));
  EXPECT_THAT(guest.prints(), Not(HasSubstr("192.0.2.1")));
  EXPECT_THAT(guest.prints(), HasSubstr("Client ping times:"));
  const net::ServerStatus status = clients_.status(now_);
  EXPECT_EQ(status.map, "test");
  ASSERT_EQ(status.players.size(), 2u);
  EXPECT_EQ(status.players[0].colors, 4 * 16 + 3);
}

TEST_F(ReceiveTest, OnlyTheHostKicks) {
  start_game("void() main = {};", 3);
  FakeClient& host = join();
  FakeClient &guest = join(true), &other = join(true);
  guest.command("name guest");
  other.command("name other");
  frame(3);
  guest.command("kick other");
  frame(3);
  EXPECT_EQ(clients_.active_count(), 3);
  host.command("kick other too loud");
  host.command("kick player");
  frame(3);
  EXPECT_EQ(clients_.active_count(), 2);
  EXPECT_THAT(other.prints(), HasSubstr("Kicked by player: too loud"));
  EXPECT_TRUE(clients_.console_command(con::Args("kick # 2"), now_));
  EXPECT_EQ(clients_.active_count(), 1);
  EXPECT_FALSE(clients_.console_command(con::Args("quit"), now_));
}

// --- signing on ---

TEST_F(ReceiveTest, WhoNeverSignsOnHoldsNoSlot) {
  start_game("void() main = {};", 2);
  frame();
  FakeClient& fake = connect(true);
  fake.answers = false;
  frame(580);
  EXPECT_TRUE(slot(0).active());
  now_ += 400.0;  // the server stands still, and nobody can sign on
  frame(5);
  EXPECT_TRUE(slot(0).active()) << "58 s, a pause that counts one, and 0.4 s";
  const LogWatch log;
  frame(10);
  EXPECT_FALSE(slot(0).active());
  EXPECT_THAT(log.text(), HasSubstr("192.0.2.1:26001 has not signed on within 60 s"));
  EXPECT_THAT(fake.prints(), HasSubstr("You have not signed on in time."));
}

TEST_F(ReceiveTest, SigningOnTakesAsLongAsTheServerLets) {
  start_game("void() main = {};", 2);
  frame();
  console_.set("sv_signontime", "5");
  connect(true).answers = false;
  frame(49);
  EXPECT_TRUE(slot(0).active());
  frame(3);
  EXPECT_FALSE(slot(0).active());
  console_.set("sv_signontime", "0");
  connect(true).answers = false;
  frame(1000);
  EXPECT_TRUE(slot(0).active());
}

// A level may be long to load; and nobody shuts the player of the server's own program out.
TEST_F(ReceiveTest, WhoHasPlayedAndWhoIsHereMayTakeLonger) {
  start_game("void() main = {};", 2);
  FakeClient& played = join(true);
  ASSERT_TRUE(slot(0).spawned());
  played.answers = false;
  connect().answers = false;
  begin_level();
  finish_level();
  frame(1000);
  EXPECT_TRUE(slot(0).active());
  EXPECT_FALSE(slot(0).spawned());
  EXPECT_TRUE(slot(1).active());
}

}  // namespace
}  // namespace fb::sv::testing
