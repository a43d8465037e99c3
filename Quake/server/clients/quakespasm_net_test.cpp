// A client of ours on a server of QuakeSpasm's: connecting, the signon with its long messages, play, and queries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <algorithm>

#include "net/client_messages.h"
#include "net/connect_attempt.h"
#include "net/server_messages.h"
#include "net/server_query.h"
#include "progs/test_qc.h"
#include "server/test_quakespasm.h"

namespace fb::sv {
namespace {

constexpr const char* kSoundsSource = R"(
string(string s) precache_sound = #19;
string(string s) precache_model = #20;
void(entity e, string m) setmodel = #3;
void() main = {};
void() worldspawn = { precache_model("progs/player.mdl"); SOUNDS };
void() barrel_explode = {};
void() StartFrame = {};
void() PlayerPreThink = {};
void() PlayerPostThink = {};
void() ClientKill = {};
void() ClientConnect = {};
void() PutClientInServer = { setmodel(self, "progs/player.mdl"); self.view_ofs = '0 0 22'; };
void() ClientDisconnect = {};
void() SetNewParms = {};
void() SetChangeParms = {};
)";

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
// Until `done` says so, or time is up; whether it did.
template <typename Done>
bool wait_for(double most, Done&& done) {
  const double end = seconds() + most;
  while (seconds() < end) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

class QuakeSpasmNet : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    // A list of sounds that makes the first message longer than any piece of ours.
    std::string source = kSoundsSource, sounds;
    for (int i = 0; i < 100; ++i) sounds += fmt::format("precache_sound(\"a/rather/long/name/of/a/sound/{}.wav\");", i);
    source.replace(source.find("SOUNDS"), 6, sounds);
    const progs::testing::Compiled compiled = progs::testing::compile(source);
    if (!compiled.has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    server.emplace(compiled.progs, "lq_e0m1");
    address = net::ipv4(127, 0, 0, 1, static_cast<std::uint16_t>(server->port()));
    ASSERT_TRUE(wait_for(20.0, [&] { return answers(); })) << server->output();
  }
  bool answers() {
    net::ServerInquiry inquiry(*network, address);
    return wait_for(0.2, [&] {
      inquiry.poll(seconds());
      return inquiry.answered();
    });
  }
  net::ServerStatus inquire() {
    net::ServerInquiry inquiry(*network, address);
    wait_for(4.0, [&] {
      listen();
      return !inquiry.poll(seconds());
    });
    return inquiry.status();
  }
  void say(const net::ClientMessage& message) {
    net::MessageWriter writer;
    net::write_client_message(writer, message);
    ASSERT_TRUE(wait_for(5.0, [&] {
      listen();
      return connection->can_send();
    }));
    ASSERT_TRUE(connection->send_reliable(writer.bytes(), seconds()).ok());
  }
  void listen() {
    while (auto message = connection->receive(seconds())) {
      (message->reliable ? reliable : unreliable)++;
      longest = std::max(longest, message->data.size());
      net::ServerMessageReader reader(message->data, "message", protocol);
      while (!reader.at_end()) {
        auto read = reader.next();
        ASSERT_TRUE(read.ok()) << read.error().message;
        if (const auto* info = std::get_if<net::svc::ServerInfo>(&*read)) level = info->level_name;
        if (const auto* signon = std::get_if<net::svc::SignonNum>(&*read)) signon_number = signon->signon;
        if (const auto* time = std::get_if<net::svc::Time>(&*read)) server_time = time->time;
      }
      protocol = reader.protocol();
    }
  }

  std::unique_ptr<net::Network> network = net::system_network();
  std::optional<testing::QuakeSpasmServer> server;
  net::Address address;
  std::unique_ptr<net::Connection> connection;
  net::Protocol protocol;
  int reliable = 0, unreliable = 0, signon_number = 0;
  std::size_t longest = 0;
  std::string level;
  float server_time = 0.0f;
};

TEST_F(QuakeSpasmNet, OurClientPlaysOnItsServer) {
  net::ConnectAttempt attempt(*network, address);
  ASSERT_TRUE(wait_for(8.0, [&] { return attempt.poll(seconds()) != net::ConnectAttempt::State::kTrying; }));
  connection = attempt.take();
  ASSERT_NE(connection, nullptr) << attempt.failure();
  const auto reach = [&](int number) {
    return wait_for(5.0, [&] {
      listen();
      return signon_number >= number;
    });
  };
  ASSERT_TRUE(reach(1)) << server->output();
  EXPECT_FALSE(level.empty());
  EXPECT_GT(longest, 3000u);
  EXPECT_EQ(protocol.version, net::kProtocolFitzQuake);
  say(net::clc::StringCommand{"prespawn"});
  ASSERT_TRUE(reach(2));
  say(net::clc::StringCommand{"name \"fullbright\"\n"});
  say(net::clc::StringCommand{"spawn "});
  ASSERT_TRUE(reach(3));
  say(net::clc::StringCommand{"begin"});
  unreliable = 0;
  EXPECT_TRUE(wait_for(5.0, [&] {
    listen();
    return unreliable >= 50;
  })) << "updates every frame";
  EXPECT_GT(server_time, 0.0f);

  const net::ServerStatus status = inquire();
  EXPECT_EQ(status.map, "lq_e0m1");
  EXPECT_EQ(status.max_players, 4);
  ASSERT_EQ(status.players.size(), 1u);
  EXPECT_EQ(status.players[0].name, "fullbright");
  EXPECT_THAT(status.rules, ::testing::Contains(::testing::Pair("sv_gravity", ::testing::StartsWith("800"))));

  say(net::clc::Disconnect{});
  EXPECT_TRUE(wait_for(5.0, [&] { return inquire().players.empty(); }));
}

}  // namespace
}  // namespace fb::sv
