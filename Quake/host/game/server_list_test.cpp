#include "host/game/server_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "net/datagram_listener.h"
#include "net/test_network.h"

namespace fb::host {
namespace {

using net::testing::TestNetwork;
using testing::HasSubstr;

TEST(ServerTable, ALineAServer) {
  EXPECT_EQ(server_table({}), "No Quake servers found.");
  const std::string table =
      server_table({{net::ipv4(192, 0, 2, 1, 26000), "A rather long name of a server", "start", 1, 8, true},
                    {net::ipv4(192, 0, 2, 2, 26001), "bad\x01\nname", "e1m1", 0, 16, false}});
  EXPECT_EQ(table,
            "Server          Map             Users\n--------------- --------------- -----\n"
            "A rather long n start            1/ 8  192.0.2.1:26000\n"
            "badname         e1m1             0/16  192.0.2.2:26001 (speaks another version)\n== end list ==");
}

TEST(ServerList, AsksTheLocalNetworkAndPrintsWhoAnswers) {
  TestNetwork network;
  const net::Address at = net::ipv4(192, 0, 2, 1, net::kDefaultPort);
  auto server = net::DatagramListener::open(
      network.host(at), at.port,
      [] {
        return net::ServerStatus{"here", "start", 4, {}, {}};
      },
      1);
  ASSERT_TRUE(server.ok());
  con::Console console;
  ServerList list(console, network.host(net::ipv4(192, 0, 2, 9, 0)));
  std::string log;
  const int listener = add_log_listener([&](LogLevel, std::string_view line) { log.append(line) += '\n'; });
  EXPECT_FALSE(list.searching());
  console.execute("slist");
  EXPECT_TRUE(list.searching());
  for (int i = 0; i < 40 && list.searching(); ++i) {
    network.advance(0.05);
    list.poll(network.now());
    (void)(*server)->accept(network.now());
  }
  EXPECT_FALSE(list.searching());
  EXPECT_THAT(log, HasSubstr("here            start            0/ 4  192.0.2.1:26000"));
  console.execute("slist nobody.example");
  EXPECT_FALSE(list.searching());
  EXPECT_THAT(log, HasSubstr("no such host"));
  remove_log_listener(listener);
}

}  // namespace
}  // namespace fb::host
