#include "net/loopback.h"

#include <gtest/gtest.h>

namespace fb::net {
namespace {

const Bytes kHello = {1, 2, 3}, kWorld = {4, 5};

TEST(Loopback, KeepsOrderOfBothKinds) {
  auto [client, server] = make_loopback(1.5);
  EXPECT_TRUE(client->is_local());
  EXPECT_EQ(client->address(), "LOCAL");
  EXPECT_EQ(client->connect_time(), 1.5);
  ASSERT_TRUE(client->send_unreliable(kWorld, 0).ok());
  ASSERT_TRUE(client->send_reliable(kHello, 0).ok());
  ASSERT_TRUE(client->send_unreliable(kHello, 0).ok());
  EXPECT_FALSE(client->receive(0).has_value()) << "not to itself";
  auto first = server->receive(0), second = server->receive(0), third = server->receive(0);
  ASSERT_TRUE(first && second && third);
  EXPECT_FALSE(first->reliable);
  EXPECT_EQ(first->data, kWorld);
  EXPECT_TRUE(second->reliable);
  EXPECT_EQ(second->data, kHello);
  EXPECT_FALSE(third->reliable);
  EXPECT_FALSE(server->receive(0).has_value());
}

TEST(Loopback, OneReliableMessageAtATime) {
  auto [client, server] = make_loopback(0);
  EXPECT_TRUE(client->can_send());
  ASSERT_TRUE(client->send_reliable(kHello, 0).ok());
  EXPECT_FALSE(client->can_send());
  EXPECT_TRUE(server->can_send()) << "each direction for itself";
  EXPECT_FALSE(client->send_reliable(kWorld, 0).ok());
  ASSERT_TRUE(server->receive(0).has_value());
  EXPECT_TRUE(client->can_send());
  EXPECT_FALSE(server->receive(0).has_value()) << "the refused one was not sent";
}

TEST(Loopback, UnreliableIsDroppedWhenTooMuchWaits) {
  auto [client, server] = make_loopback(0);
  const Bytes big(30000);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(client->send_unreliable(big, 0).ok());
  EXPECT_TRUE(client->send_reliable(Bytes(kMaxMessage), 0).ok()) << "the reliable one always has room";
  int unreliable = 0, reliable = 0;
  while (auto message = server->receive(0)) ++(message->reliable ? reliable : unreliable);
  EXPECT_EQ(unreliable, 2);
  EXPECT_EQ(reliable, 1);
}

TEST(Loopback, RefusesBadMessages) {
  auto [client, server] = make_loopback(0);
  EXPECT_FALSE(client->send_reliable({}, 0).ok());
  EXPECT_FALSE(client->send_unreliable({}, 0).ok());
  EXPECT_FALSE(client->send_reliable(Bytes(kMaxMessage + 1), 0).ok());
  EXPECT_TRUE(client->can_send());
  EXPECT_EQ(client->unreliable_limit(), kMaxMessage);
}

TEST(Loopback, Closing) {
  auto [client, server] = make_loopback(0);
  ASSERT_TRUE(server->send_reliable(kHello, 0).ok());
  EXPECT_EQ(client->close_reason(), "");
  server.reset();
  EXPECT_FALSE(client->is_open());
  EXPECT_EQ(client->close_reason(), "closed by the other side");
  EXPECT_FALSE(client->can_send());
  EXPECT_FALSE(client->send_unreliable(kHello, 0).ok());
  EXPECT_TRUE(client->receive(0).has_value()) << "the last words still arrive";
  client->close();
  EXPECT_EQ(client->close_reason(), "closed");
}

TEST(LoopbackListener, HandsOutEndsInTurn) {
  LoopbackListener listener;
  EXPECT_EQ(listener.accept(0), nullptr);
  auto a = listener.connect(0);
  auto b = listener.connect(0);
  ASSERT_TRUE(a->send_reliable(kHello, 0).ok());
  auto server_a = listener.accept(0), server_b = listener.accept(0);
  ASSERT_TRUE(server_a && server_b);
  EXPECT_EQ(listener.accept(0), nullptr);
  EXPECT_EQ(server_a->receive(0)->data, kHello);
  EXPECT_FALSE(server_b->receive(0).has_value());
}

}  // namespace
}  // namespace fb::net
