// Connecting, being asked, and being attacked, over a network in memory.
#include "net/datagram_listener.h"

#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "net/connect_attempt.h"
#include "net/server_query.h"
#include "net/test_listener.h"

namespace fb::net {
namespace {

using ::testing::ElementsAre;
using testing::kClient;
using testing::kFrame;
using testing::kServer;
using testing::kVictim;
using testing::ListenerTest;
using ::testing::Pair;

TEST_F(ListenerTest, ConnectsOnAPortOfItsOwn) {
  auto client = connect(kClient);
  ASSERT_NE(client, nullptr);
  for (int i = 0; i < 10; ++i) {
    (void)client->receive(network.now());
    frame();
  }
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_NE(client->address(), kServer.to_string());
  EXPECT_EQ(client->address().substr(0, 10), "192.0.2.1:");
  EXPECT_FALSE(client->is_local());
  EXPECT_THAT(received, ElementsAre(Bytes{1})) << "clc_nop, which opens the way back through a NAT";

  ASSERT_TRUE(client->can_send());
  ASSERT_TRUE(client->send_reliable(Bytes{1, 2, 3}, network.now()).ok());
  ASSERT_TRUE(accepted[0]->can_send());
  ASSERT_TRUE(accepted[0]->send_reliable(Bytes{4, 5}, network.now()).ok());
  const auto got = client->receive(network.now());
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->data, (Bytes{4, 5}));
  frame();
  EXPECT_EQ(received.back(), (Bytes{1, 2, 3}));
}

TEST_F(ListenerTest, ConnectsInBadWeather) {
  network.weather = {0.2f, 0.2f, 0.02, 0.2};
  status.max_players = 100;
  int connected = 0;
  for (std::uint8_t i = 0; i < 30; ++i) {
    auto client = connect(ipv4(192, 0, 2, i, 0).with_port(0), 8.0);
    if (client == nullptr) continue;
    ++connected;
    for (int k = 0; k < 200; ++k) {
      (void)client->receive(network.now());
      frame();
    }
  }
  EXPECT_GE(connected, 27) << "three tries, each with a chance of 0.64";
  EXPECT_EQ(static_cast<int>(accepted.size()), connected);
}

TEST_F(ListenerTest, NobodyThere) {
  listener.reset();
  ConnectAttempt attempt(network.host(kClient), kServer);
  while (attempt.poll(network.now()) == ConnectAttempt::State::kTrying) network.advance(kFrame);
  EXPECT_EQ(attempt.failure(), "no response");
  EXPECT_EQ(attempt.tries(), 3);
  EXPECT_NEAR(network.now(), 7.5, 0.1);
}

TEST_F(ListenerTest, Rejects) {
  status.max_players = 0;
  EXPECT_EQ(connect(kClient), nullptr);
  EXPECT_EQ(failure, "Server is full.");
  status.max_players = 4;
  const auto socket = open_socket(kClient.with_port(7));
  const auto reply = ask(*socket, ccreq::Connect{"QUAKE", 4});
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(*reply, ControlReply(ccrep::Reject{"Incompatible version.\n"}));
  EXPECT_FALSE(ask(*socket, ccreq::Connect{"QUAKE2", 3}).has_value());
}

TEST_F(ListenerTest, TheClientMindsWhoAnswers) {
  ConnectAttempt attempt(network.host(kClient), kServer);
  Address client = kClient;
  network.watch = [&](const Address& from, const Address&, ByteView) { client = from; };
  listener.reset();
  (void)attempt.poll(network.now());
  network.forge(kVictim, client, write_control(ControlReply(ccrep::Accept{1234})));
  network.forge(kServer.with_port(1), client, write_control(ControlReply(ccrep::Reject{"go away"})));
  for (const std::int32_t port : {0, -1, 65536})
    network.forge(kServer, client, write_control(ControlReply(ccrep::Accept{port})));
  network.forge(kServer, client, Bytes{1, 2, 3});
  EXPECT_EQ(attempt.poll(network.now()), ConnectAttempt::State::kTrying);
  network.forge(kServer, client, write_control(ControlReply(ccrep::Accept{65535})));
  EXPECT_EQ(attempt.poll(network.now()), ConnectAttempt::State::kConnected);
  EXPECT_EQ(attempt.take()->address(), "192.0.2.1:65535");
}

// An engine that waits for the server to speak: the byte that it must acknowledge lets it in.
TEST_F(ListenerTest, ClientsThatDoNotSpeakFirst) {
  const auto socket = open_socket(kClient.with_port(7));
  const auto reply = ask(*socket, ccreq::Connect{});
  ASSERT_TRUE(reply.has_value());
  const auto port = static_cast<std::uint16_t>(std::get<ccrep::Accept>(*reply).port);
  std::optional<Socket::Datagram> datagram;
  for (int i = 0; i < 72 && !datagram; ++i) {
    frame();
    datagram = socket->receive_from();
  }
  ASSERT_TRUE(datagram.has_value());
  EXPECT_TRUE(accepted.empty());
  EXPECT_EQ(datagram->from, kServer.with_port(port));
  const auto packet = parse_packet(datagram->data);
  ASSERT_TRUE(packet.ok());
  EXPECT_EQ(packet->kind, PacketKind::kData);
  EXPECT_EQ(Bytes(packet->payload.begin(), packet->payload.end()), Bytes{1}) << "svc_nop";
  socket->send_to(kServer.with_port(port), write_packet({PacketKind::kAck, false, packet->sequence, {}}));
  frame();
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_TRUE(accepted[0]->can_send());
}

// The same over the machine's own sockets.
TEST(SystemListener, ConnectsOverTheLoopbackInterface) {
  const auto network = system_network();
  for (const char* host : {"127.0.0.1", "::1"}) {
    auto listener = DatagramListener::open(
        *network, 0,
        [] {
          return ServerStatus{"here", "start", 2, {}, {}};
        },
        1);
    ASSERT_TRUE(listener.ok()) << listener.error().message;
    ConnectAttempt attempt(*network, *parse_address(host, (*listener)->port()));
    std::unique_ptr<Connection> client, server;
    double now = 0.0;  // a thousandth a turn, whatever the real clock says
    for (int i = 0; i < 7000 && (!client || !server); ++i, now += 0.001) {
      if (!client && attempt.poll(now) == ConnectAttempt::State::kConnected) client = attempt.take();
      if (!server) server = (*listener)->accept(now);
    }
    if (!client || !server) {
      std::printf("no connection to %s: %s\n", host, attempt.failure().c_str());
      continue;
    }
    const Bytes sent(10000, 5);
    ASSERT_TRUE(server->send_reliable(sent, now).ok());
    std::optional<ReceivedMessage> got;
    for (int i = 0; i < 7000 && !got; ++i, now += 0.001) {
      (void)server->receive(now);
      got = client->receive(now);
    }
    ASSERT_TRUE(got.has_value()) << host;
    EXPECT_EQ(got->data, sent);
  }
}

// --- attacks ---

TEST_F(ListenerTest, InventedSendersGetLittleAndTakeNoPlace) {
  const Bytes request = write_control(ControlRequest(ccreq::Connect{}));
  network.forge(kVictim, kServer, request);
  for (int i = 0; i < 72 * 20; ++i) frame();
  EXPECT_TRUE(accepted.empty());
  EXPECT_EQ(victim_bytes, 9u + 5 * 9u) << "where to go on, and five times a byte to acknowledge";
  EXPECT_LE(victim_bytes, DatagramListener::kMostReply * request.size());
  // Nor does anybody else wait for it.
  EXPECT_NE(connect(kClient), nullptr);
}

TEST_F(ListenerTest, AFloodOfInventedSendersLeavesRoom) {
  const Bytes request = write_control(ControlRequest(ccreq::Connect{}));
  Rng rng(2);
  for (int i = 0; i < 72; ++i) {
    for (int k = 0; k < 2; ++k) {
      Address from = kVictim;
      for (std::size_t b = 0; b < 4; ++b) from.bytes[b] = static_cast<std::uint8_t>(rng.next());
      network.forge(from, kServer, request);
    }
    frame();
  }
  EXPECT_TRUE(accepted.empty());
  EXPECT_NE(connect(kClient), nullptr);
  frame();
  EXPECT_EQ(accepted.size(), 1u);
}

// Whatever is asked, however the server names itself, no reply is longer than so many times the request.
TEST_F(ListenerTest, NoReplyIsMuchLongerThanItsRequest) {
  status.name = std::string(2000, 'n');
  status.map = std::string(2000, 'm');
  status.rules = {{std::string(100, 'r'), "too long a name"}, {"a", std::string(2000, 'v')}, {"b", "2"}};
  status.players = {{std::string(2000, 'p'), 1, 2, 3.0}};
  const auto socket = open_socket(kClient.with_port(7));
  const std::vector<ControlRequest> requests = {ccreq::Connect{},     ccreq::Connect{"QUAKE", 9}, ccreq::ServerInfo{},
                                                ccreq::PlayerInfo{0}, ccreq::RuleInfo{},          ccreq::RuleInfo{"a"}};
  for (const ControlRequest& request : requests) {
    const Bytes bytes = write_control(request);
    socket->send_to(kServer, bytes);
    accept_all();
    const auto reply = socket->receive_from();
    ASSERT_TRUE(reply.has_value()) << request.index();
    EXPECT_LE(reply->data.size(), DatagramListener::kMostReply * bytes.size()) << request.index();
    EXPECT_TRUE(parse_control_reply(reply->data).ok());
  }
  EXPECT_EQ(std::get<ccrep::RuleInfo>(*ask(*socket, ccreq::RuleInfo{})).name, "a");
  EXPECT_EQ(*ask(*socket, ccreq::RuleInfo{"a"}), ControlReply(ccrep::RuleInfo{"b", "2"}));
  EXPECT_EQ(*ask(*socket, ccreq::RuleInfo{"b"}), ControlReply(ccrep::RuleInfo{}));
  EXPECT_FALSE(ask(*socket, ccreq::RuleInfo{"no such rule"}).has_value());
  EXPECT_FALSE(ask(*socket, ccreq::PlayerInfo{1}).has_value());
}

TEST_F(ListenerTest, RepliesAreRationed) {
  const Bytes request = write_control(ControlRequest(ccreq::ServerInfo{}));
  std::uint64_t replies = 0;
  network.watch = [&](const Address& from, const Address&, ByteView) { replies += from == kServer ? 1 : 0; };
  for (int i = 0; i < 10000; ++i) network.forge(kVictim.with_port(static_cast<std::uint16_t>(i)), kServer, request);
  for (int i = 0; i < 1000; ++i) accept_all();
  EXPECT_EQ(replies, 40u) << "ports make no difference";
  network.advance(1.0);
  for (int i = 0; i < 1000; ++i) network.forge(kVictim, kServer, request);
  for (int i = 0; i < 100; ++i) accept_all();
  EXPECT_EQ(replies, 60u);
  network.advance(100.0);
  for (int i = 0; i < 10000; ++i)
    network.forge(ipv4(203, 0, static_cast<std::uint8_t>(i / 256), static_cast<std::uint8_t>(i), 1), kServer, request);
  for (int i = 0; i < 1000; ++i) accept_all();
  EXPECT_EQ(replies, 460u) << "all together";
}

TEST_F(ListenerTest, RubbishGetsNothing) {
  Rng rng(4);
  std::uint64_t replies = 0;
  network.watch = [&](const Address& from, const Address&, ByteView) { replies += from == kServer ? 1 : 0; };
  for (int i = 0; i < 100000; ++i) {
    Bytes bytes(rng.below(24));
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(rng.next());
    if (bytes.size() >= 5) {
      bytes[0] = 0x80;
      bytes[1] = bytes[2] = 0;
      bytes[3] = static_cast<std::uint8_t>(bytes.size());
      bytes[4] = static_cast<std::uint8_t>(rng.below(2) == 0 ? 1 : 0x80 + rng.below(8));
    }
    network.forge(kVictim, kServer, bytes);
    if (i % 32 == 0) accept_all();
  }
  accept_all();
  EXPECT_EQ(replies, 0u);
}

// --- queries ---

TEST_F(ListenerTest, SearchFindsEverybody) {
  ServerStatus other = status;
  other.name = "other";
  other.players.resize(2);
  const Address there = ipv4(192, 0, 2, 99, kServer.port);
  auto second = DatagramListener::open(
      network.host(there), there.port, [&] { return other; }, 2);
  ASSERT_TRUE(second.ok());
  ServerSearch search(network.host(kClient), {broadcast(kServer.port)});
  while (search.poll(network.now())) {
    (void)(*second)->accept(network.now());
    frame();
  }
  ASSERT_EQ(search.found().size(), 2u);
  const auto& found = search.found();
  const auto& mine = found[0].address == kServer ? found[0] : found[1];
  const auto& others = found[0].address == kServer ? found[1] : found[0];
  EXPECT_EQ(mine.name, "test server");
  EXPECT_EQ(mine.map, "start");
  EXPECT_EQ(mine.max_players, 4);
  EXPECT_EQ(others.address, there);
  EXPECT_EQ(others.players, 2);
  EXPECT_TRUE(others.compatible);
}

TEST_F(ListenerTest, InquiryGetsPlayersAndRulesInBadWeather) {
  network.weather = {0.15f, 0.1f, 0.01, 0.05};
  status.max_players = 16;
  for (int i = 0; i < 16; ++i) status.players.push_back({"player " + std::to_string(i), i, -i, 60.0 * i});
  ServerInquiry inquiry(network.host(kClient), kServer);
  while (inquiry.poll(network.now())) frame();
  EXPECT_TRUE(inquiry.answered());
  const ServerStatus told = inquiry.status();
  EXPECT_EQ(told.name, "test server");
  EXPECT_THAT(told.rules, ElementsAre(Pair("sv_gravity", "800"), Pair("sv_maxspeed", "320"), Pair("teamplay", "0")));
  ASSERT_EQ(told.players.size(), 16u);
  EXPECT_EQ(told.players[5].name, "player 5");
  EXPECT_EQ(told.players[5].frags, -5);
  EXPECT_EQ(told.players[5].seconds, 300.0);
}

TEST_F(ListenerTest, InquiryOfNobody) {
  listener.reset();
  ServerInquiry inquiry(network.host(kClient), kServer);
  while (inquiry.poll(network.now())) network.advance(kFrame);
  EXPECT_FALSE(inquiry.answered());
  EXPECT_NEAR(network.now(), 3.0, 0.1);
}

// Two clients and a server exchange messages like a game for a minute: no connection drops.
TEST_F(ListenerTest, AMinuteOfPlay) {
  network.weather = {0.1f, 0.02f, 0.02, 0.06};
  std::vector<std::unique_ptr<Connection>> clients;
  for (int i = 0; i < 2; ++i) {
    auto client = connect(kClient);
    while (client == nullptr) client = connect(kClient);
    clients.push_back(std::move(client));
  }
  std::vector<int> got(2), sent(2);
  int updates = 0;
  const double end = network.now() + 60.0;
  while (network.now() < end) {
    for (std::size_t i = 0; i < 2; ++i) {
      while (auto message = clients[i]->receive(network.now())) {
        if (message->data == Bytes{1}) continue;
        if (!message->reliable) {
          ++updates;
          continue;
        }
        EXPECT_EQ(message->data.size(), 2000u + static_cast<std::size_t>(got[i]));
        ++got[i];
      }
      EXPECT_TRUE(clients[i]->send_unreliable(Bytes(20, 3), network.now()).ok());
    }
    for (std::size_t i = 0; i < accepted.size() && i < 2; ++i) {
      EXPECT_TRUE(accepted[i]->send_unreliable(Bytes(1200, 9), network.now()).ok());
      if (!accepted[i]->can_send()) continue;
      EXPECT_TRUE(accepted[i]->send_reliable(Bytes(2000 + static_cast<std::size_t>(sent[i]++), 8), network.now()).ok());
    }
    frame();
  }
  ASSERT_EQ(accepted.size(), 2u);
  EXPECT_TRUE(clients[0]->is_open() && clients[1]->is_open() && accepted[0]->is_open() && accepted[1]->is_open());
  EXPECT_GT(got[0], 20);
  EXPECT_GE(got[0] + 1, sent[0]);
  EXPECT_GT(updates, 2 * 60 * 72 / 2);
}

}  // namespace
}  // namespace fb::net
