// The client and a server over a simulated network: connecting, playing, timeouts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/log.h"
#include "client/client.h"
#include "client/test_server.h"
#include "console/console.h"
#include "net/datagram_listener.h"
#include "net/test_network.h"

namespace fb::cl {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace svc = net::svc;

TEST(ServerLinkOverUdp, ConnectsPlaysAndTimesOut) {
  net::testing::TestNetwork network(7);
  net::Network& here = network.host(net::ipv4(192, 0, 2, 1, 0));
  net::Network& there = network.host(net::ipv4(192, 0, 2, 2, 0));
  auto listener = net::DatagramListener::open(
      there, 26000, [] { return net::ServerStatus{}; }, 5);
  ASSERT_TRUE(listener.ok()) << listener.error().message;
  (*listener)->set_timeout(3.0);

  auto files = test::game_files();
  con::Console console;
  scene::ModelLibrary library(files.loader());
  Client client(console, library, files.loader());
  client.set_clock([&] { return network.now(); });
  std::string log;
  const int handle = add_log_listener([&](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  console.execute("connect 192.0.2.2");
  EXPECT_THAT(log, HasSubstr("there is no network"));
  client.set_network(here);
  console.execute("connect nowhere.invalid");
  EXPECT_THAT(log, HasSubstr("no such host"));

  test::FakeServer server;
  bool served = true;
  const auto frame = [&] {
    network.advance(0.05);
    console.execute();
    client.look(0.05);
    client.send();
    if (served) {
      if (auto connection = (*listener)->accept(network.now())) server.take(std::move(connection));
      server.frame(0.05, network.now());
    }
    client.advance(0.05);
  };
  console.append("connect 192.0.2.2\n");
  frame();
  EXPECT_TRUE(client.connecting());
  for (int i = 0; i < 200 && !client.active(); ++i) frame();
  ASSERT_TRUE(client.active()) << log;
  console.append("+forward\n");
  server.say({svc::StuffText{"echo obeyed a stranger\n"}});
  for (int i = 0; i < 20; ++i) frame();
  EXPECT_GT(client.player_origin().y, 50.0f);
  EXPECT_THAT(log, Not(HasSubstr("obeyed a stranger")));

  served = false;
  for (int i = 0; i < 20 * 400 && client.connected(); ++i) frame();
  EXPECT_FALSE(client.connected());
  ASSERT_TRUE(client.last_error().has_value());
  EXPECT_EQ(client.last_error()->message, "Lost the connection to 192.0.2.2: timed out");
  (*listener).reset();
  console.append("reconnect\n");
  for (int i = 0; i < 20 * 12; ++i) frame();
  EXPECT_THAT(log, HasSubstr("Cannot connect to 192.0.2.2: no response"));
  remove_log_listener(handle);
}

TEST(ServerLinkOverUdp, AMapStaysInViewWhileNobodyAnswers) {
  net::testing::TestNetwork network(7);
  auto files = test::game_files();
  con::Console console;
  scene::ModelLibrary library(files.loader());
  Client client(console, library, files.loader());
  client.set_clock([&] { return network.now(); });
  client.set_network(network.host(net::ipv4(192, 0, 2, 1, 0)));
  ASSERT_TRUE(client.map_view("test").ok());
  for (const bool again : {false, true}) {
    ASSERT_TRUE(client.connect("192.0.2.2").ok()) << again;
    EXPECT_TRUE(client.connecting());
    for (int i = 0; i < 20 * 12; ++i) {
      EXPECT_TRUE(client.active());
      network.advance(0.05);
      client.advance(0.05);
    }
    EXPECT_FALSE(client.connecting());
    EXPECT_TRUE(client.last_error().has_value());
  }
  const double time = client.time();
  client.advance(0.5);
  EXPECT_EQ(client.time(), time + 0.5);
}

}  // namespace
}  // namespace fb::cl
