// The 2021 re-release's QuakeC, as each of its updates declares what it calls, and its texts in the player's language.
#include "fs/test_log.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Before its first update: Quake's own prints, and numbers behind Quake's last.
constexpr const char* kFirstRelease = R"(
void(string s, ...) bprint = #23;
void(entity client, string s, ...) sprint = #24;
void(entity client, string s, ...) centerprint = #73;
float() finaleFinished = #79;
void(entity client, string s) localsound = #80;
void(vector point, float colormap, float lifetime, float depthtest) draw_point = #81;
void(string s, vector origin, float size, float lifetime, float depthtest) draw_worldtext = #87;
float(entity player) CheckPlayerEXFlags = #90;
float(float distance, vector goal) walkpathtogoal = #91;
float(entity bot, vector point) bot_movetopoint = #92;
float(entity bot, entity goal) bot_followentity = #92;
)";
// The first update's prints.
constexpr const char* kFirstUpdate = R"(
#define CheckPlayerEXFlags ex_CheckPlayerEXFlags
#define walkpathtogoal ex_walkpathtogoal
#define bot_movetopoint ex_bot_movetopoint
#define bot_followentity ex_bot_followentity
void(entity client, string s, ...) centerprint = #90;
void(string s, ...) bprint = #91;
void(entity client, string s, ...) sprint = #92;
float() finaleFinished = #79;
void(entity client, string s) localsound = #80;
void(vector point, float colormap, float lifetime, float depthtest) draw_point = #81;
void(string s, vector origin, float size, float lifetime, float depthtest) draw_worldtext = #87;
float(entity player) ex_CheckPlayerEXFlags = #0;
float(float distance, vector goal) ex_walkpathtogoal = #0;
float(entity bot, vector point) ex_bot_movetopoint = #0;
float(entity bot, entity goal) ex_bot_followentity = #0;
)";
// The third update's: all by name.
constexpr const char* kThirdUpdate = R"(
#define centerprint ex_centerprint
#define bprint ex_bprint
#define sprint ex_sprint
#define finaleFinished ex_finaleFinished
#define localsound ex_localsound
#define draw_point ex_draw_point
#define draw_worldtext ex_draw_worldtext
#define CheckPlayerEXFlags ex_CheckPlayerEXFlags
#define walkpathtogoal ex_walkpathtogoal
#define bot_movetopoint ex_bot_movetopoint
#define bot_followentity ex_bot_followentity
void(entity client, string s, ...) ex_centerprint = #0;
void(string s, ...) ex_bprint = #0;
void(entity client, string s, ...) ex_sprint = #0;
float() ex_finaleFinished = #0;
void(entity client, string s) ex_localsound = #0;
void(vector point, float colormap, float lifetime, float depthtest) ex_draw_point = #0;
void(string s, vector origin, float size, float lifetime, float depthtest) ex_draw_worldtext = #0;
float(entity player) ex_CheckPlayerEXFlags = #0;
float(float distance, vector goal) ex_walkpathtogoal = #0;
float(entity bot, vector point) ex_bot_movetopoint = #0;
float(entity bot, entity goal) ex_bot_followentity = #0;
)";

constexpr const char* kRereleaseGame = R"(
string(string s) precache_sound = #19;
entity(entity e) nextent = #47;
void(float to, float f) WriteByte = #52;
void(float to, string s) WriteString = #58;
void(string s, ...) error = #10;
float sum;
void() StartFrame = {};
void() PlayerPreThink = {};
void() PlayerPostThink = {};
void() ClientKill = {};
void() ClientConnect = {};
void() PutClientInServer = { self.health = 100; };
void() ClientDisconnect = {};
void() SetNewParms = {};
void() SetChangeParms = {};
void() worldspawn = { precache_sound("misc/secret.wav"); };
void() go = {
  local entity p;
  p = nextent(world);
  bprint("$qc_entered", "Ranger");
  bprint("plain ", "$qc_item", "\n");
  sprint(p, "You got ", "$qc_item", "\n");
  centerprint(p, "centre {0}", "$qc_item");
  localsound(p, "misc/secret.wav");
  draw_point('0 0 0', 1, 1, 0);
  draw_worldtext("words", '0 0 0', 1, 1, 0);
  sum = finaleFinished() + CheckPlayerEXFlags(p) + walkpathtogoal(8, '1 2 3') + bot_movetopoint(p, '1 2 3') +
        bot_followentity(p, p) + 1;
  WriteByte(2, 52);
  WriteString(2, "ACH_NONE");
  WriteByte(2, 31);
  WriteString(2, "$qc_finale");
};
)";

class RereleaseTest : public testing::ServerTest {
 protected:
  // Plays `go`, and returns what the player hears of it.
  std::vector<net::ServerMessage> play(const std::string& declarations) {
    const auto compiled = progs::testing::compile(declarations + kRereleaseGame);
    EXPECT_FALSE(compiled.progs.empty()) << compiled.output;
    files_["progs.dat"] = compiled.progs;
    auto map = room();
    map.entities = "{ \"classname\" \"worldspawn\" \"message\" \"$m_title\" }\n";
    files_["maps/test.bsp"] = formats::testing::write_bsp(map.build());
    make_server();
    const Status status = server_->map("test");
    EXPECT_TRUE(status.ok()) << status.error().message;
    if (!status.ok()) return {};
    Player player = join();
    const std::vector<net::ServerMessage> signon = messages(player.heard, {});
    title = std::get<net::svc::ServerInfo>(*std::find_if(signon.begin(), signon.end(), [](const auto& message) {
              return std::holds_alternative<net::svc::ServerInfo>(message);
            })).level_name;
    player.heard.clear();
    fs::LogLines log;
    set_log_level(LogLevel::kWarning);
    EXPECT_TRUE(level().run(level().vm->program().find_function("go"), EdictId::kWorld)) << level().error()->message;
    set_log_level(LogLevel::kError);
    EXPECT_THAT(log.lines, IsEmpty());
    EXPECT_EQ(level().vm->get(global<float>("sum")), 1.0f);
    frames(2);
    hear(player);
    return messages(player.heard, server_->clients().protocol());
  }
  std::vector<net::ServerMessage> messages(const Bytes& bytes, const net::Protocol& protocol) {
    std::vector<net::ServerMessage> all;
    net::ServerMessageReader reader(bytes, "heard", protocol);
    while (!reader.at_end()) {
      auto message = reader.next();
      EXPECT_TRUE(message.ok()) << message.error().message;
      if (!message.ok()) break;
      all.push_back(std::move(*message));
    }
    return all;
  }
  template <typename T>
  static std::vector<T> all_of(const std::vector<net::ServerMessage>& messages) {
    std::vector<T> found;
    for (const auto& message : messages)
      if (const T* one = std::get_if<T>(&message)) found.push_back(*one);
    return found;
  }
  static std::string prints(const std::vector<net::ServerMessage>& messages) {
    std::string text;
    for (const auto& print : all_of<net::svc::Print>(messages)) text += print.text;
    return text;
  }
  void speak(const std::string& texts) {
    const auto added =
        console_.localization().add({reinterpret_cast<const std::uint8_t*>(texts.data()), texts.size()}, "loc.txt");
    ASSERT_TRUE(added.ok());
  }
  std::string title;
};

TEST_F(RereleaseTest, EveryUpdatesProgramPlays) {
  speak(
      "qc_entered = \"{0} entered the game\\n\"\nqc_item = \"a nailgun\"\nqc_finale = \"The end\"\nm_title = \"A "
      "title\"\n");
  for (const char* declarations : {kFirstRelease, kFirstUpdate, kThirdUpdate}) {
    const auto heard = play(declarations);
    EXPECT_EQ(prints(heard), "Ranger entered the game\nplain a nailgun\nYou got a nailgun\n") << declarations;
    EXPECT_THAT(all_of<net::svc::CenterPrint>(heard), ElementsAre(net::svc::CenterPrint{"centre a nailgun"}));
    EXPECT_THAT(all_of<net::svc::Achievement>(heard), ElementsAre(net::svc::Achievement{"ACH_NONE"}));
    EXPECT_THAT(all_of<net::svc::Finale>(heard), ElementsAre(net::svc::Finale{"The end"}));
    const auto sounds = all_of<net::svc::Sound>(heard);
    ASSERT_EQ(sounds.size(), 1u) << declarations;
    EXPECT_EQ(sounds[0].entity, 1);
    EXPECT_EQ(sounds[0].volume, 255);
    EXPECT_EQ(sounds[0].attenuation, 0);
    EXPECT_EQ(level().sounds.at(static_cast<std::size_t>(sounds[0].sound)), "misc/secret.wav");
    EXPECT_EQ(title, "A title");
  }
}

TEST_F(RereleaseTest, WithoutTextsKeysStay) {
  const auto heard = play(kThirdUpdate);
  EXPECT_EQ(prints(heard), "$qc_enteredRangerplain $qc_item\nYou got $qc_item\n");
  EXPECT_THAT(all_of<net::svc::CenterPrint>(heard), ElementsAre(net::svc::CenterPrint{"centre {0}$qc_item"}));
  EXPECT_EQ(title, "$m_title");
}

TEST_F(RereleaseTest, SavesHaveTheLevelsName) {
  speak("m_title = \"A title\"\n");
  (void)play(kThirdUpdate);
  ASSERT_TRUE(server_->save("s").ok());
  const Bytes& save = files_["s.sav"];
  EXPECT_THAT(std::string(save.begin(), save.end()), HasSubstr("\nA_title____"));
}

// The same numbers under other names are other engines'.
TEST_F(RereleaseTest, OtherEnginesNumbersStay) {
  EXPECT_EQ(says("tracebox('0 0 50', '-8 -8 -8', '8 8 8', '0 0 -50', 0, self); saysf(rint(trace_endpos_z));"
                 "saysf(vlen(randomvec()) > 0); saysf(stof(\"7\"));"
                 "saysf(builtin_find(\"ex_bprint\")); saysf(checkbuiltin(tracebox));"),
            "8 1 7 23 1 ");
}

TEST_F(RereleaseTest, WhatOnlyReturnsNothingIsNotThere) {
  EXPECT_EQ(says("saysf(checkbuiltin(ex_walkpathtogoal)); saysf(checkbuiltin(ex_bprint)); saysf(checkbuiltin(ex_none));"
                 "saysf(builtin_find(\"finaleFinished\")); saysf(checkbuiltin(particleeffectnum));",
                 "float(float d, vector g) ex_walkpathtogoal = #0; void(string s, ...) ex_bprint = #0;"
                 "void() ex_none = #0;"),
            "0 1 0 0 0 ");
}

}  // namespace
}  // namespace fb::sv
