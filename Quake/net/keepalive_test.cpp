#include "net/keepalive.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "net/datagram_connection.h"
#include "net/test_network.h"

namespace fb::net {
namespace {

TEST(SilenceWatch, SpeaksWhereNobodyElseHas) {
  SilenceWatch watch;
  std::uint64_t sent = 3;
  const auto look = [&] {
    const bool speaks = watch.look(sent, 100);
    sent += speaks ? 1 : 0;
    return speaks;
  };
  EXPECT_FALSE(look()) << "three packets since the start";
  EXPECT_TRUE(look());
  EXPECT_TRUE(look()) << "its own packet is nobody else's word";
  ++sent;
  EXPECT_FALSE(look());
  EXPECT_TRUE(look());
}

TEST(SilenceWatch, AClientThatHangsIsGivenUp) {
  SilenceWatch watch;
  std::uint64_t sent = 0;
  int spoken = 0;
  for (int i = 0; i < 20; ++i)
    if (watch.look(sent, 5)) ++spoken, ++sent;
  EXPECT_EQ(spoken, 5);
  ++sent;
  EXPECT_FALSE(watch.look(sent, 5));
  EXPECT_TRUE(watch.look(sent, 5)) << "it has come round";
}

TEST(Keepalive, WhatSaysNothingIsHeardAndNoMessage) {
  testing::TestNetwork network;
  const Address a = ipv4(192, 0, 2, 1, 10), b = ipv4(192, 0, 2, 2, 20);
  const auto connection = [&](const Address& at, const Address& to) {
    return DatagramConnection(std::move(*network.host(at).open(Family::kIpv4, at.port)), to, 0.0, 10.0);
  };
  DatagramConnection client = connection(a, b), server = connection(b, a);
  ASSERT_TRUE(client.send_unreliable(Bytes{3}, 0.0).ok());
  for (int i = 1; i <= 100; ++i) {
    network.advance(5.0);
    const std::uint64_t before = client.packets_sent();
    client.say_nothing();
    EXPECT_EQ(client.packets_sent(), before + 1);
    const auto first = server.receive(network.now());
    ASSERT_TRUE(first.has_value());
    if (i == 1) {
      EXPECT_EQ(first->data, Bytes{3});
    }
    while (const auto more = server.receive(network.now())) EXPECT_EQ(more->data, Bytes{1}) << "clc_nop";
    ASSERT_TRUE(server.is_open()) << server.close_reason();
  }
  EXPECT_EQ(server.statistics().stale + server.statistics().unreliable_lost, 0u) << "in one sequence with the others";
}

// Over the machine's own sockets, while the client's thread says things as well and while it says nothing.
TEST(Keepalive, ASilentClientIsHeard) {
  const auto network = system_network();
  ASSERT_TRUE(network->any_thread());
  auto there = network->open(Family::kIpv4, 0), here = network->open(Family::kIpv4, 0);
  if (!there.ok() || !here.ok()) {
    std::printf("no sockets here: skipped\n");
    return;
  }
  const Address server_at = ipv4(127, 0, 0, 1, (*there)->port()), client_at = ipv4(127, 0, 0, 1, (*here)->port());
  DatagramConnection server(std::move(*there), client_at, 0.0), client(std::move(*here), server_at, 0.0);
  const auto heard = [&] {  // within a minute, which a thread gets its turn in
    for (int i = 0; i < 6000; ++i) {
      if (const auto message = server.receive(0.0)) return message->data == Bytes{1};
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  };
  {
    const Keepalive keepalive(client, 0.01);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(heard());
    for (int i = 0; i < 1000; ++i) {
      (void)client.send_unreliable(Bytes{1}, 0.0);
      (void)client.receive(0.0);
      (void)server.receive(0.0);
    }
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(heard());
  }
  while (server.receive(0.0)) {}
  const std::uint64_t sent = client.packets_sent();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(client.packets_sent(), sent) << "it ends with its owner";
}

}  // namespace
}  // namespace fb::net
