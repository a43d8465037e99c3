#include <gtest/gtest.h>

#include <cstdio>

#include "net/network.h"

namespace fb::net {
namespace {

TEST(Address, FromAndToText) {
  const auto text = [](std::string_view from) {
    const auto address = parse_address(from);
    return address ? address->to_string() : "none";
  };
  EXPECT_EQ(text("192.0.2.1"), "192.0.2.1:26000");
  EXPECT_EQ(text("192.0.2.1:26001"), "192.0.2.1:26001");
  EXPECT_EQ(text("::1"), "[::1]:26000");
  EXPECT_EQ(text("[::1]"), "[::1]:26000");
  EXPECT_EQ(text("[2001:db8::2]:7"), "[2001:db8::2]:7");
  EXPECT_EQ(text("192.0.2.1:"), "192.0.2.1:26000");
  for (const char* bad : {"192.0.2.1:0", "192.0.2.1:65536", "192.0.2.1:12x", "", "localhost", "256.1.1.1", "1.2.3", ":",
                          "[", "[::1", "[]:1", "::g"})
    EXPECT_EQ(text(bad), std::string_view(bad) == "[::1" ? "[::1]:26000" : "none") << bad;
}

TEST(Address, SplitsNames) {
  EXPECT_EQ(split_port("quake.example:26005")->host, "quake.example");
  EXPECT_EQ(split_port("quake.example:26005")->port, 26005);
  EXPECT_EQ(split_port("quake.example", 5)->port, 5);
  for (const char* wrong : {"abc", "0", "-1", "65536", "1e3", "5x"}) {
    const auto refused = split_port(std::string("quake.example:") + wrong);
    ASSERT_FALSE(refused.ok()) << wrong;
    EXPECT_EQ(refused.error().message,
              std::string("quake.example: port ") + wrong + ": a whole number from 1 to 65535 is wanted");
  }
}

TEST(Address, SameHost) {
  const Address a = ipv4(192, 0, 2, 1, 1), b = ipv4(192, 0, 2, 1, 2), c = ipv4(192, 0, 2, 2, 1);
  EXPECT_TRUE(a.same_host(b));
  EXPECT_NE(a, b);
  EXPECT_FALSE(a.same_host(c));
  EXPECT_EQ(a.with_port(2), b);
}

// The machine's own sockets, among themselves.
TEST(SystemNetwork, DatagramsComeAndGo) {
  const auto network = system_network();
  for (const Family family : {Family::kIpv4, Family::kIpv6}) {
    auto a = network->open(family, 0), b = network->open(family, 0);
    if (!a || !b) {
      std::printf("no %s here: %s\n", family == Family::kIpv4 ? "IPv4" : "IPv6", (a ? b : a).error().message.c_str());
      continue;
    }
    EXPECT_NE((*a)->port(), 0);
    EXPECT_FALSE((*b)->receive_from().has_value()) << "does not block";
    const Address there = *parse_address(family == Family::kIpv4 ? "127.0.0.1" : "::1", (*b)->port());
    const Bytes sent(1432, 42);
    (*a)->send_to(there, sent);
    std::optional<Socket::Datagram> got;
    for (int i = 0; i < 100000 && !got; ++i) got = (*b)->receive_from();
    if (!got) GTEST_SKIP() << "nothing comes through the loopback interface";
    EXPECT_EQ(Bytes(got->data.begin(), got->data.end()), sent);
    EXPECT_EQ(got->from, there.with_port((*a)->port()));
    (*b)->send_to(ipv4(127, 0, 0, 1, 1), Bytes(70000));  // too long, or of another family: lost
    EXPECT_FALSE(network->open(family, (*b)->port()).ok()) << "taken";
  }
}

TEST(SystemNetwork, Resolves) {
  const auto network = system_network();
  const auto numbers = network->resolve("127.0.0.1:5");
  ASSERT_TRUE(numbers.ok());
  EXPECT_EQ(numbers->to_string(), "127.0.0.1:5");
  EXPECT_FALSE(network->resolve("").ok());
  EXPECT_FALSE(network->resolve("no-such-host.invalid").ok());
  if (const auto name = network->resolve("localhost:26007")) {
    EXPECT_EQ(name->port, 26007);
  }
}

TEST(SystemNetwork, WhatIsSwitchedOffSaysSo) {
  const auto none = system_network({.ipv4 = false, .ipv6 = false});
  EXPECT_EQ(none->open(Family::kIpv4, 0).error().message, "network: it is switched off by the command line");
  const auto no_ipv6 = system_network({.ipv6 = false});
  EXPECT_TRUE(no_ipv6->open(Family::kIpv4, 0).ok());
  EXPECT_EQ(no_ipv6->open(Family::kIpv6, 0).error().message, "network: IPv6 is switched off by the command line");
  if (const auto name = no_ipv6->resolve("localhost")) {
    EXPECT_EQ(name->family, Family::kIpv4);
  }
  const auto no_ipv4 = system_network({.ipv4 = false});
  EXPECT_FALSE(no_ipv4->open(Family::kIpv4, 0).ok());
  if (const auto name = no_ipv4->resolve("localhost")) {
    EXPECT_EQ(name->family, Family::kIpv6);
  }
}

// All of 127.0.0.0/8 is this machine, on Linux.
TEST(SystemNetwork, SocketsHaveTheAddressThatIsAskedFor) {
  const auto network = system_network({.own_address = ipv4(127, 0, 0, 2, 0)});
  auto socket = network->open(Family::kIpv4, 0);
  if (!socket) GTEST_SKIP() << socket.error().message;
  auto other = system_network()->open(Family::kIpv4, 0);
  ASSERT_TRUE(other.ok());
  const auto arrives_at = [&](const Address& to) {
    (*other)->send_to(to, Bytes(4, 1));
    for (int i = 0; i < 20000; ++i)
      if ((*socket)->receive_from()) return true;
    return false;
  };
  EXPECT_TRUE(arrives_at(ipv4(127, 0, 0, 2, (*socket)->port())));
  EXPECT_FALSE(arrives_at(ipv4(127, 0, 0, 1, (*socket)->port()))) << "it listens at its own address alone";
  EXPECT_FALSE(network->open(Family::kIpv6, 0).ok());
  const auto nowhere = system_network({.own_address = ipv4(192, 0, 2, 1, 0)})->open(Family::kIpv4, 26000);
  ASSERT_FALSE(nowhere.ok()) << "an address of the documentation's network, which no machine has";
  EXPECT_NE(nowhere.error().message.find("192.0.2.1:26000"), std::string::npos) << nowhere.error().message;
}

TEST(Address, AHostChoosesItsOwnHalfOfAnIpv6Address) {
  const auto at = [](const char* text) { return *parse_address(text, 0); };
  EXPECT_TRUE(at("192.0.2.1:1").same_site(at("192.0.2.1:2")));
  EXPECT_FALSE(at("192.0.2.1").same_site(at("192.0.2.2")));
  EXPECT_TRUE(at("2001:db8::1").same_site(at("2001:db8::ffff:1")));
  EXPECT_FALSE(at("2001:db8::1").same_site(at("2001:db8:0:1::1")));
  EXPECT_FALSE(at("fe80::1").same_site(at("fe80::2"))) << "a local network's machines";
  EXPECT_FALSE(at("192.0.2.1").same_site(at("2001:db8::1")));
}

}  // namespace
}  // namespace fb::net
