// Models and sounds that a mod precaches while its level runs: who is told, and what saved games keep.
#include "formats/test_models.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fields = progs::fields;

constexpr const char* kLate = R"(
void() go = { says(precache_model("progs/late.mdl")); precache_sound("late.wav"); precache_sound("late.wav");
  setmodel(self, "progs/late.mdl"); sound(self, 1, "late.wav", 1, 1); };
void() thing = { precache_model("progs/early.mdl"); setorigin(self, '0 0 50'); self.think = go; self.nextthink = time + 4; };
void() PutClientInServer = { self.health = 100; setorigin(self, '100 0 50'); };
)";
constexpr const char* kTold = "//precache model 3 \"progs/late.mdl\"\n";

class LatePrecacheTest : public testing::ServerTest {
 protected:
  void start_late(const std::string& source = kLate) { start(source, "{ \"classname\" \"thing\" }"); }
  // What a player has been told, as text and as messages.
  std::string heard(const Player& player) const { return {player.heard.begin(), player.heard.end()}; }
  template <typename T>
  std::vector<T> all(const Player& player) {
    std::vector<T> found;
    net::ServerMessageReader reader(player.heard, "heard");
    while (!reader.at_end()) {
      auto message = reader.next();
      EXPECT_TRUE(message.ok()) << message.error().message;
      if (!message.ok()) break;
      if (const T* one = std::get_if<T>(&*message)) found.push_back(*one);
    }
    return found;
  }
};

TEST_F(LatePrecacheTest, PlayersAreToldAndTheGameGoesOn) {
  start_late();
  Player player = join();
  EXPECT_THAT(heard(player), Not(HasSubstr("//precache")));
  frames(40);
  hear(player);
  ASSERT_TRUE(server_->active());
  EXPECT_EQ(said(), "progs/late.mdl ");
  EXPECT_THAT(heard(player), HasSubstr(kTold));
  EXPECT_THAT(heard(player), HasSubstr("//precache sound 1 \"late.wav\"\n"));
  EXPECT_EQ(edict(2).get(fields::modelindex), 3.0f);
  EXPECT_EQ(level().models.size(), 4u);
  EXPECT_EQ(level().sounds.size(), 2u);
  const auto sounds = all<net::svc::Sound>(player);
  ASSERT_EQ(sounds.size(), 1u);
  EXPECT_EQ(sounds[0].sound, 1);
  EXPECT_THAT(level().vm->warning(), HasSubstr("\"late.wav\" is precached while the level runs"));
}

TEST_F(LatePrecacheTest, WhoComesLaterHasTheWholeList) {
  start_late();
  frames(45);
  Player player = join();
  const auto infos = all<net::svc::ServerInfo>(player);
  ASSERT_EQ(infos.size(), 1u);
  EXPECT_EQ(infos[0].models, (std::vector<std::string>{"maps/test.bsp", "progs/early.mdl", "progs/late.mdl"}));
  EXPECT_EQ(infos[0].sounds, std::vector<std::string>{"late.wav"});
}

// QuakeSpasm's clients, and those of protocol 15, must find nothing that they do not know.
TEST_F(LatePrecacheTest, OthersAreToldNothingThatEndsTheirGame) {
  console_.execute("set sv_protocol 15");
  start_late(R"(
    void() go = { local float i; for (i = 0; i < 260; i++) precache_model(strcat("m", ftos(i))); precache_model("a\"b");
      precache_model("a\nb"); };
    void() thing = { self.think = go; self.nextthink = time + 4; };)");
  Player player = join();
  frames(40);
  hear(player);
  ASSERT_TRUE(server_->active());
  EXPECT_EQ(level().models.size(), 2u + 262u);
  EXPECT_THAT(heard(player), HasSubstr("//precache model 255 "));
  EXPECT_THAT(heard(player), Not(HasSubstr("//precache model 256 "))) << "no message of protocol 15 names it";
  console_.set("sv_protocol", "666");
  start_late(R"(void() go = { precache_model("a\"b"); precache_model("a\nb"); precache_model("a;b"); };
    void() thing = { self.think = go; self.nextthink = time + 4; };)");
  Player other = join();
  frames(40);
  hear(other);
  for (const auto& stuffed : all<net::svc::StuffText>(other))
    EXPECT_THAT(stuffed.text, ::testing::AnyOf(Not(HasSubstr("//")), "//precache model 4 \"a;b\"\n"));
}

TEST_F(LatePrecacheTest, SavedGamesKeepThem) {
  files_["progs/late.mdl"] = formats::testing::write_mdl(formats::testing::tetrahedron());
  start_late();
  frames(5);
  ASSERT_TRUE(server_->save("before").ok());
  frames(45);
  ASSERT_TRUE(server_->save("after").ok());
  const auto text = [&](const char* name) { return std::string(files_.at(name).begin(), files_.at(name).end()); };
  EXPECT_THAT(text("before.sav"), Not(HasSubstr("precache")));
  EXPECT_THAT(text("after.sav"), ::testing::EndsWith("}\n/*\n// precached while the level ran\nsv.model_precache 3 "
                                                     "\"progs/late.mdl\"\nsv.sound_precache 1 \"late.wav\"\n*/\n"));
  const std::string state = server_->dump();
  ASSERT_TRUE(server_->load("after").ok());
  EXPECT_EQ(server_->dump(), state);
  EXPECT_EQ(level().models.back().name, "progs/late.mdl");
  EXPECT_NE(level().models.back().maxs, vec3(0.0f)) << "its file is read again";
  EXPECT_EQ(level().sounds.back(), "late.wav");
  ASSERT_TRUE(server_->save("again").ok());
  EXPECT_EQ(text("again.sav").substr(text("again.sav").rfind("/*")),
            text("after.sav").substr(text("after.sav").rfind("/*")));
  Player player = join();
  EXPECT_EQ(all<net::svc::ServerInfo>(player).at(0).models.back(), "progs/late.mdl");
}

// Other engines list all of a level's, under the numbers that they have there.
TEST_F(LatePrecacheTest, SavedGamesOfOtherEnginesBringThem) {
  start_late();
  frames(45);
  ASSERT_TRUE(server_->save("ours").ok());
  std::string text(files_.at("ours.sav").begin(), files_.at("ours.sav").end());
  text.replace(text.rfind("/*"), std::string::npos,
               "/*\n// QuakeSpasm extended savegame\nsv.lightstyles 64 \"m\"\nsv.model_precache 1 \"maps/test.bsp\"\n"
               "sv.model_precache 2 \"progs/early.mdl\"\nsv.model_precache 7 \"progs/other.mdl\"\n"
               "sv.model_precache 3 \"progs/late.mdl\"\nsv.model_precache x \"y\"\nsv.model_precache 9\n"
               "sv.sound_precache 4 \"theirs.wav\"\n*/\n");
  files_["theirs.sav"] = Bytes(text.begin(), text.end());
  ASSERT_TRUE(server_->load("theirs").ok());
  ASSERT_EQ(level().models.size(), 5u);
  EXPECT_EQ(level().models[3].name, "progs/other.mdl");
  EXPECT_EQ(level().models[4].name, "progs/late.mdl");
  EXPECT_EQ(edict(2).get(fields::modelindex), 4.0f) << "the thing's model is the same, by its new number";
  EXPECT_EQ(level().sounds.back(), "theirs.wav");
}

}  // namespace
}  // namespace fb::sv
