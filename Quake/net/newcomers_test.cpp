// Who is let in by a listener, in whose place, and who is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "net/packet.h"
#include "net/test_listener.h"

namespace fb::net {
namespace {

using testing::kClient;
using testing::kServer;
using testing::kVictim;
using testing::ListenerTest;

TEST_F(ListenerTest, AskingAgainGetsTheSamePort) {
  const auto socket = open_socket(kClient.with_port(7));
  const auto first = ask(*socket, ccreq::Connect{});
  const auto second = ask(*socket, ccreq::Connect{});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

TEST_F(ListenerTest, TwoPlayersOfOneHost) {
  auto a = connect(kClient), b = connect(kClient);
  ASSERT_TRUE(a && b);
  for (int i = 0; i < 100; ++i) {
    (void)a->receive(network.now());
    (void)b->receive(network.now());
    frame();
  }
  ASSERT_EQ(accepted.size(), 2u);
  EXPECT_TRUE(accepted[0]->is_open() && accepted[1]->is_open());
}

TEST_F(ListenerTest, BackFromACrash) {
  auto client = connect(kClient);
  ASSERT_NE(client, nullptr);
  frame();
  ASSERT_EQ(accepted.size(), 1u);
  client.reset();
  frames(11.0);
  auto again = connect(kClient);
  ASSERT_NE(again, nullptr);
  frame();
  frame();
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0]->close_reason(), "connected anew");
  EXPECT_EQ(accepted.size(), 1u);
}

// However soon: the first try waits until it is clear that the one before has gone.
TEST_F(ListenerTest, BackFromACrashToAFullServer) {
  status.max_players = 1;
  for (const double after : {1.5, 5.0, 9.0, 40.0}) {
    auto client = connect(kClient);
    ASSERT_NE(client, nullptr) << after;
    frames(0.1);
    ASSERT_EQ(accepted.size(), 1u);
    client.reset();
    frames(after);
    gone.clear();
    ConnectAttempt attempt(network.host(kClient), kServer);
    while (attempt.poll(network.now()) == ConnectAttempt::State::kTrying) frame();
    ASSERT_EQ(attempt.failure(), "") << after;
    EXPECT_EQ(attempt.tries(), 1) << after;
    client = attempt.take();
    frames(11.0);
    ASSERT_EQ(gone.size(), 1u) << after;
    EXPECT_EQ(gone[0]->close_reason(), "connected anew");
    ASSERT_EQ(accepted.size(), 1u) << after;
    ASSERT_TRUE(accepted[0]->send_reliable(Bytes{7}, network.now()).ok()) << "the new one plays";
    const auto heard = client->receive(network.now());
    ASSERT_TRUE(heard.has_value());
    EXPECT_EQ(heard->data, Bytes{7});
    client.reset();
    frames(11.0);
    accepted.clear();
    status.players.clear();
  }
}

TEST_F(ListenerTest, BackAtItsOwnPort) {
  status.max_players = 1;
  const auto speak = [&](Socket& socket, const ccrep::Accept& to) {
    socket.send_to(kServer.with_port(static_cast<std::uint16_t>(to.port)),
                   write_packet({PacketKind::kUnreliable, false, 0, Bytes{1}}));
    frames(0.1);
  };
  const auto socket = open_socket(kClient.with_port(7));
  const auto first = ask(*socket, ccreq::Connect{});
  ASSERT_TRUE(first.has_value());
  speak(*socket, std::get<ccrep::Accept>(*first));
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_FALSE(ask(*socket, ccreq::Connect{}).has_value()) << "a late repetition of the request";
  frames(1.5);
  const auto second = ask(*socket, ccreq::Connect{});
  ASSERT_TRUE(second.has_value());
  EXPECT_NE(*second, *first);
  EXPECT_TRUE(accepted[0]->is_open()) << "nothing is proven yet";
  speak(*socket, std::get<ccrep::Accept>(*second));
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0]->close_reason(), "connected anew");
  EXPECT_EQ(accepted.size(), 1u);
}

// Behind one router: who is there speaks every five seconds, if only to say nothing.
TEST_F(ListenerTest, AFullServerKeepsThePlayerOfWhomAnotherSharesTheAddress) {
  status.max_players = 1;
  auto client = connect(kClient);
  ASSERT_NE(client, nullptr);
  frames(4.9);
  auto other = connect(kClient);
  ASSERT_NE(other, nullptr);
  std::string heard;
  for (int second = 0; second < 12; ++second) {
    if (second % 5 == 1) client->say_nothing();
    frames(1.0);
    (void)client->receive(network.now());
    while (const auto message = other->receive(network.now())) heard.append(message->data.begin(), message->data.end());
  }
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_TRUE(gone.empty());
  EXPECT_THAT(heard, ::testing::HasSubstr("Server is full."));
}

TEST_F(ListenerTest, OneHostMayHaveHalfTheSlotsSignOnAtATime) {
  status.max_players = 8;
  std::vector<std::unique_ptr<Connection>> clients;
  for (int i = 0; i < 6; ++i) clients.push_back(connect(kClient));
  frames(1.0);
  EXPECT_EQ(accepted.size(), 4u);
  EXPECT_NE(connect(ipv4(192, 0, 2, 51, 0)), nullptr);
  frames(0.1);
  EXPECT_EQ(accepted.size(), 5u) << "another host";
  accepted[0]->set_signed_on();
  frames(0.1);
  EXPECT_EQ(accepted.size(), 6u) << "the next of those that wait";
  // What waits too long is told so.
  for (int i = 0; i < 35; ++i) {
    for (const auto& client : clients) client->say_nothing();
    frames(1.0);
  }
  EXPECT_EQ(accepted.size(), 6u);
  std::string heard;
  while (const auto message = clients[5]->receive(network.now()))
    heard.append(message->data.begin(), message->data.end());
  EXPECT_THAT(heard, ::testing::HasSubstr("Server is full."));
}

TEST_F(ListenerTest, AHostMayBeLimited) {
  status.max_players = 8;
  listener->set_most_per_host(3);
  std::vector<std::unique_ptr<Connection>> clients;
  std::string heard;
  for (int i = 0; i < 5; ++i) {
    clients.push_back(connect(kClient));
    frames(0.2);
    for (const auto& connection : accepted) connection->set_signed_on();
    for (const auto& client : clients) client->say_nothing();
  }
  EXPECT_EQ(accepted.size(), 3u);
  for (int i = 0; i < 12; ++i) {
    for (const auto& client : clients) client->say_nothing();
    frames(1.0);
  }
  while (const auto message = clients[4]->receive(network.now()))
    heard.append(message->data.begin(), message->data.end());
  EXPECT_THAT(heard, ::testing::HasSubstr("Too many players of your address"));
  EXPECT_NE(connect(ipv4(192, 0, 2, 51, 0)), nullptr);
  frames(0.2);
  EXPECT_EQ(accepted.size(), 4u);
}

TEST_F(ListenerTest, NobodyIsThrownOutByAForgedRequest) {
  Address client_address;
  network.watch = [&](const Address& from, const Address& to, ByteView) {
    if (to.same_host(kServer)) client_address = from;
  };
  auto client = connect(kClient);
  ASSERT_NE(client, nullptr);
  for (int i = 0; i < 72 * 20; ++i) {
    (void)client->receive(network.now());
    if (i % 72 == 0) {
      ASSERT_TRUE(client->send_unreliable(Bytes{3}, network.now()).ok());
    }
    network.forge(client_address, kServer, write_control(ControlRequest(ccreq::Connect{})));
    network.forge(client_address.with_port(9), kServer, write_control(ControlRequest(ccreq::Connect{})));
    frame();
    ASSERT_EQ(accepted.size(), 1u);
    ASSERT_TRUE(accepted[0]->is_open()) << i;
  }
}

// Nor who says nothing for long: it is for packets from where it is to say that it has begun anew.
TEST_F(ListenerTest, AForgedRequestDropsNobodyHoweverSilent) {
  status.max_players = 2;
  Address client_address;
  network.watch = [&](const Address& from, const Address& to, ByteView) {
    if (to.same_host(kServer)) client_address = from;
  };
  auto client = connect(kClient);
  ASSERT_NE(client, nullptr);
  frames(0.1);
  const Bytes request = write_control(ControlRequest(ccreq::Connect{}));
  for (const int slots : {2, 1}) {
    status.max_players = slots;
    for (int i = 0; i < 100; ++i) {
      network.forge(client_address, kServer, request);
      network.forge(client_address.with_port(9), kServer, request);
      frames(1.0);
      ASSERT_EQ(accepted.size(), 1u);
      ASSERT_TRUE(accepted[0]->is_open()) << i;
    }
  }
  ASSERT_TRUE(client->send_unreliable(Bytes{3}, network.now()).ok());
  frames(0.1);
  EXPECT_EQ(received.back(), Bytes{3});
}

// A flood in one host's name takes the places of that host's requests alone.
TEST_F(ListenerTest, AFloodOfOneInventedSenderLeavesRoom) {
  const Bytes request = write_control(ControlRequest(ccreq::Connect{}));
  const auto socket = open_socket(kClient.with_port(7));  // far away: it speaks after three seconds
  const auto reply = ask(*socket, ccreq::Connect{});
  ASSERT_TRUE(reply.has_value());
  for (int i = 0; i < 72 * 5; ++i) {
    network.forge(kVictim.with_port(static_cast<std::uint16_t>(1000 + i)), kServer, request);
    frame();
  }
  EXPECT_TRUE(accepted.empty());
  socket->send_to(kServer.with_port(static_cast<std::uint16_t>(std::get<ccrep::Accept>(*reply).port)),
                  write_packet({PacketKind::kUnreliable, false, 0, Bytes{1}}));
  frames(0.1);
  EXPECT_EQ(accepted.size(), 1u);
}

// The server itself stood still, while a level was read or its host's shaders were compiled.
TEST_F(ListenerTest, AStallOfTheServerMakesNobodySilent) {
  auto client = connect(kClient);
  ASSERT_NE(client, nullptr);
  frames(0.1);
  auto other = connect(kClient);  // its first packet is on its way
  ASSERT_NE(other, nullptr);
  for (int i = 0; i < 100; ++i) {
    network.advance(5.0);
    client->say_nothing();
    other->say_nothing();
  }
  frames(1.0);
  EXPECT_EQ(accepted.size(), 2u);
  EXPECT_TRUE(gone.empty());
}

}  // namespace
}  // namespace fb::net
