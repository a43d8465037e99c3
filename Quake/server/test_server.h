// A server for tests: progs.dat from QuakeC compiled by fteqcc, maps made in code, files in memory. Skips where there
// is no compiler.
//
//   class MyTest : public ServerTest {};
//   TEST_F(MyTest, Spawns) {
//     start(R"(void() thing = { says(self.classname); };)", R"({ "classname" "thing" })");
//     EXPECT_EQ(said(), "thing ");
//   }
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "base/log.h"
#include "formats/test_bsp.h"
#include "net/loopback.h"
#include "progs/test_qc.h"
#include "server/clients/clients.h"
#include "server/server.h"
#include "server/simulation/test_map.h"

namespace fb::sv::testing {

namespace fields = progs::fields;
namespace globals = progs::globals;

// QuakeC's declarations of the server's builtins, and says(), whose words said() gives.
constexpr const char* kServerSource = R"qc(
float FL_ONGROUND = 512; float SOLID_NOT = 0; float SOLID_TRIGGER = 1; float SOLID_BBOX = 2; float SOLID_SLIDEBOX = 3;
float SOLID_BSP = 4; float MOVETYPE_NONE = 0; float MOVETYPE_STEP = 4; float MOVETYPE_TOSS = 6; float MOVETYPE_PUSH = 7;
void(entity e, vector o) setorigin = #2;
void(entity e, string m) setmodel = #3;
void(entity e, vector low, vector high) setsize = #4;
void(entity e, float channel, string sample, float volume, float attenuation) sound = #8;
void(vector from, vector to, float kind, entity not) traceline = #16;
entity() checkclient = #17;
string(string s) precache_sound = #19;
string(string s) precache_model = #20;
void(entity e, string s) stuffcmd = #21;
entity(vector o, float radius) findradius = #22;
void(entity e, string s, ...) sprint = #24;
float(float yaw, float distance) walkmove = #32;
float() droptofloor = #34;
void(float style, string s) lightstyle = #35;
float(entity e) checkbottom = #40;
float(vector v) pointcontents = #41;
vector(entity e, float speed) aim = #44;
void(vector o, vector d, float color, float count) particle = #48;
void(float to, float f) WriteByte = #52;
void(float to, float f) WriteChar = #53;
void(float to, float f) WriteShort = #54;
void(float to, float f) WriteLong = #55;
void(float to, float f) WriteCoord = #56;
void(float to, float f) WriteAngle = #57;
void(float to, string s) WriteString = #58;
void(float to, entity e) WriteEntity = #59;
void(float step) movetogoal = #67;
string(string s) precache_file = #68;
void(entity e) makestatic = #69;
void(string s) changelevel = #70;
void(entity e, string s, ...) centerprint = #73;
void(vector o, string sample, float volume, float attenuation) ambientsound = #74;
string(string s) precache_model2 = #75;
string(string s) precache_sound2 = #76;
string(string s) precache_file2 = #77;
void(entity e) setspawnparms = #78;
void(vector from, vector low, vector high, vector to, float kind, entity not) tracebox = #90;
float(string name) particleeffectnum = #335;
void(float effect, vector o, vector d, float count) pointparticles = #337;
void(vector low, vector high, vector d, float count, float color) te_particlerain = #409;
void(vector o) te_gunshot = #418;
void(vector o) te_explosion = #421;
void(vector o, float color, float length) te_explosion2 = #427;
void(entity e, vector from, vector to) te_lightning1 = #428;
float(entity e, float s) getsurfacenumpoints = #434;
vector(entity e, float s, float n) getsurfacepoint = #435;
vector(entity e, float s) getsurfacenormal = #436;
string(entity e, float s) getsurfacetexture = #437;
float(entity e, vector p) getsurfacenearpoint = #438;
vector(entity e, float s, vector p) getsurfaceclippedpoint = #439;
string said;
void(string s) says = { said = strzone(strcat(said, s, " ")); };
void(float f) saysf = { says(ftos(f)); };
void(vector v) saysv = { says(sprintf("(%g %g %g)", v_x, v_y, v_z)); };
void(entity e) sayse = { says(sprintf("e%g", num_for_edict(e))); };
)qc";
// What a mod must have besides.
constexpr const char* kModSource = R"(
void() worldspawn = {};
)";

class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    set_log_level(LogLevel::kError);
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
  }
  void TearDown() override { set_log_level(LogLevel::kInfo); }

  static MapBuilder room() { return MapBuilder(vec3(-512, -512, 0), vec3(512, 512, 256)); }

  void put_progs(const std::string& source) {
    const auto compiled = progs::testing::compile(std::string(progs::testing::kBuiltinSource) + kServerSource + source);
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    files_["progs.dat"] = compiled.progs;
  }
  void put_map(const std::string& name, MapBuilder map, const std::string& entities = "") {
    map.entities = "{ \"classname\" \"worldspawn\" \"message\" \"Test\" }\n" + entities;
    files_["maps/" + name + ".bsp"] = formats::testing::write_bsp(map.build());
  }
  void make_server(const ServerOptions& options = {}) {
    server_.reset();
    ServerServices services;
    services.read_file = [this](std::string_view name) -> std::optional<Bytes> {
      const auto found = files_.find(std::string(name));
      return found == files_.end() ? std::nullopt : std::optional(found->second);
    };
    services.write_file = [this](std::string_view name, ByteView data) {
      files_[std::string(name)] = Bytes(data.begin(), data.end());
      return ok_status();
    };
    services.game_index_of = game_index_of_;
    services.game = [] { return std::string("id1"); };
    services.rng = &rng_;
    server_ = std::make_unique<Server>(console_, services, options);
    server_->clients().add_listener(listener_);
  }
  // Compiles, and begins map "test", a room with these entities.
  Status try_start(const std::string& source, const std::string& entities = "", const ServerOptions& options = {}) {
    put_progs(source.find("worldspawn") == std::string::npos ? kModSource + source : source);
    if (HasFatalFailure()) return Error{"QuakeC does not compile"};
    put_map("test", room(), entities);
    make_server(options);
    return server_->map("test");
  }
  void start(const std::string& source, const std::string& entities = "", const ServerOptions& options = {}) {
    const Status status = try_start(source, entities, options);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  // What QuakeC says with `statements` as the function that an entity spawns with; or the error.
  std::string says(const std::string& statements, const std::string& before = "") {
    const Status status = try_start(before + "void() thing = {" + statements + "};", "{ \"classname\" \"thing\" }");
    return status.ok() ? said() : "error: " + status.error().message;
  }

  Level& level() { return *server_->level(); }
  std::string said() { return std::string(level().vm->text(level().vm->get(global<StringId>("said")))); }
  template <typename T>
  progs::Global<T> global(std::string_view name) {
    return level().vm->program().global<T>(name);
  }
  Edict edict(std::uint32_t number) { return level().edict(EdictId{number}); }
  std::string text(StringId id) { return std::string(level().vm->text(id)); }
  void frames(int count, double seconds = 0.1) {
    for (int i = 0; i < count; ++i) server_->frame(seconds, now_ += seconds);
  }

  // A player's side of the loopback: says what a client says until it is in the game.
  struct Player {
    std::unique_ptr<net::Connection> connection;
    Bytes heard;
  };
  void hear(Player& player) {
    while (auto message = player.connection->receive(now_))
      player.heard.insert(player.heard.end(), message->data.begin(), message->data.end());
  }
  void tell(Player& player, const std::string& command) {
    net::MessageWriter writer;
    net::write_client_message(writer, net::clc::StringCommand{command});
    ASSERT_TRUE(player.connection->send_reliable(writer.bytes(), now_).ok());
  }
  Player join() {
    Player player{listener_.connect(now_), {}};
    for (const char* command : {"prespawn", "spawn", "begin"}) {
      for (int i = 0; i < 3; ++i) {
        frames(1);
        hear(player);
      }
      tell(player, command);
    }
    frames(2);
    hear(player);
    return player;
  }

  con::Console console_;
  Rng rng_{1};
  std::map<std::string, Bytes> files_;
  std::function<int(std::string_view)> game_index_of_;  // of files_
  net::LoopbackListener listener_;
  std::unique_ptr<Server> server_;
  double now_ = 0.0;
};

}  // namespace fb::sv::testing
