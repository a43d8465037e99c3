// The transport over a network in memory: what a bad one does to it, and what hostile packets do not.
#include "net/datagram_connection.h"

#include <gtest/gtest.h>

#include "net/test_network.h"

namespace fb::net {
namespace {

using testing::TestNetwork;
using testing::Weather;

const Address kA = ipv4(192, 0, 2, 1, 1000), kB = ipv4(192, 0, 2, 2, 2000), kStranger = ipv4(198, 51, 100, 9, 2000);
constexpr double kFrame = 1.0 / 72.0;

struct Pair {
  explicit Pair(TestNetwork& network)
      : a(std::move(*network.host(kA).open(Family::kIpv4, kA.port)), kB, network.now()),
        b(std::move(*network.host(kB).open(Family::kIpv4, kB.port)), kA, network.now()) {}
  DatagramConnection a, b;
};

Bytes message_of(std::size_t size, std::uint32_t seed) {
  Rng rng(seed);
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(rng.next());
  return bytes;
}

TEST(Datagram, MessagesOfAnySize) {
  TestNetwork network;
  Pair pair(network);
  for (const std::size_t size : {1, 1023, 1024, 1025, 2048, 2049, 63999, 64000}) {
    const Bytes sent = message_of(size, static_cast<std::uint32_t>(size));
    ASSERT_TRUE(pair.a.send_reliable(sent, network.now()).ok());
    EXPECT_FALSE(pair.a.can_send());
    EXPECT_FALSE(pair.a.send_reliable(sent, network.now()).ok()) << "one at a time";
    std::optional<ReceivedMessage> got;
    for (int i = 0; i < 200 && !got; ++i) {
      got = pair.b.receive(network.now());
      EXPECT_FALSE(pair.a.receive(network.now()).has_value());
      network.advance(kFrame);
    }
    ASSERT_TRUE(got.has_value()) << size;
    EXPECT_TRUE(got->reliable);
    EXPECT_EQ(got->data, sent);
    EXPECT_TRUE(pair.a.can_send());
  }
  EXPECT_EQ(pair.a.statistics().packets_resent, 0u);
  EXPECT_FALSE(pair.a.send_reliable({}, 0).ok());
  EXPECT_FALSE(pair.a.send_reliable(Bytes(kMaxMessage + 1), 0).ok());
  EXPECT_FALSE(pair.a.send_unreliable(Bytes(kMaxMessage + 1), 0).ok());
}

// Both directions at once, in weather that loses a tenth, repeats some and lets most overtake each other.
TEST(Datagram, ReliableMessagesArriveOnceAndInOrder) {
  TestNetwork network(17, {0.1f, 0.05f, 0.01, 0.15});
  Pair pair(network);
  constexpr std::uint32_t kMessages = 2000;
  const auto message = [](std::uint32_t number, std::uint32_t salt) {
    Bytes bytes = message_of(1 + (number * 37 + salt) % (number % 50 == 0 ? 5000 : 300), number + salt);
    bytes[0] = static_cast<std::uint8_t>(number);
    return bytes;
  };
  std::uint32_t sent_a = 0, sent_b = 0, got_a = 0, got_b = 0;
  while ((got_a < kMessages || got_b < kMessages) && network.now() < 20000.0) {
    const double now = network.now();
    while (auto got = pair.a.receive(now)) {
      ASSERT_TRUE(got->reliable);
      ASSERT_EQ(got->data, message(got_a, 1)) << got_a;
      ++got_a;
    }
    while (auto got = pair.b.receive(now)) {
      ASSERT_EQ(got->data, message(got_b, 2)) << got_b;
      ++got_b;
    }
    if (pair.a.can_send() && sent_a < kMessages) {
      ASSERT_TRUE(pair.a.send_reliable(message(sent_a++, 2), now).ok());
    }
    if (pair.b.can_send() && sent_b < kMessages) {
      ASSERT_TRUE(pair.b.send_reliable(message(sent_b++, 1), now).ok());
    }
    network.advance(kFrame);
  }
  EXPECT_EQ(got_a, kMessages);
  EXPECT_EQ(got_b, kMessages);
  EXPECT_GT(network.lost, kMessages / 5) << "else this was no weather";
  EXPECT_GT(pair.a.statistics().packets_resent, kMessages / 10);
  EXPECT_GT(pair.b.statistics().duplicates, kMessages / 20);
}

TEST(Datagram, UnreliableNeverGoesBack) {
  TestNetwork network(5, {0.1f, 0.1f, 0.01, 0.1});
  Pair pair(network);
  int last = -1, got = 0;
  constexpr int kMessages = 20000;
  for (int i = 0; i < kMessages; ++i) {
    Bytes bytes = {1, static_cast<std::uint8_t>(i & 255), static_cast<std::uint8_t>(i >> 8)};
    ASSERT_TRUE(pair.a.send_unreliable(bytes, network.now()).ok());
    while (auto message = pair.b.receive(network.now())) {
      EXPECT_FALSE(message->reliable);
      const int number = message->data[1] + 256 * message->data[2];
      ASSERT_GT(number, last) << "once, and never an older one";
      last = number;
      ++got;
    }
    network.advance(0.05);
  }
  EXPECT_GT(got, kMessages / 2);
  EXPECT_GT(pair.b.statistics().stale, 100u);
  EXPECT_GT(pair.b.statistics().unreliable_lost, static_cast<std::uint64_t>(kMessages) / 20);
}

TEST(Datagram, ResendsEverySecond) {
  TestNetwork network(1, {1.0f, 0, 0, 0});
  Pair pair(network);
  ASSERT_TRUE(pair.a.send_reliable(Bytes{1}, network.now()).ok());
  for (int i = 0; i < 1000; ++i, network.advance(0.01)) (void)pair.a.receive(network.now());
  EXPECT_EQ(pair.a.statistics().packets_sent, 10u);
}

TEST(Datagram, TimesOut) {
  TestNetwork network;
  Pair pair(network);
  pair.a.set_timeout(30.0);
  network.advance(29.0);
  (void)pair.a.receive(network.now());
  EXPECT_TRUE(pair.a.is_open());
  ASSERT_TRUE(pair.b.send_unreliable(Bytes{1}, network.now()).ok());
  EXPECT_TRUE(pair.a.receive(network.now()).has_value());
  network.advance(29.0);
  (void)pair.a.receive(network.now());
  EXPECT_TRUE(pair.a.is_open()) << "it has heard something";
  network.advance(2.0);
  EXPECT_FALSE(pair.a.receive(network.now()).has_value());
  EXPECT_FALSE(pair.a.is_open());
  EXPECT_EQ(pair.a.close_reason(), "timed out");
  const auto status = pair.a.send_reliable(Bytes{1}, network.now());
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "192.0.2.2:2000: the connection is closed (timed out)");
}

// --- hostile packets ---

TEST(Datagram, StrangersAreIgnored) {
  TestNetwork network;
  Pair pair(network);
  const Bytes data = write_packet({PacketKind::kData, true, 0, Bytes{1, 2, 3}});
  const Bytes unreliable = write_packet({PacketKind::kUnreliable, false, 77, Bytes{1}});
  const Bytes ack = write_packet({PacketKind::kAck, false, 0, {}});
  for (const Address& from : {kStranger, kB.with_port(2001)})
    for (const Bytes& bytes : {data, unreliable, ack}) network.forge(from, kA, bytes);
  network.forge(kA.with_port(1001), kB, ack);
  ASSERT_TRUE(pair.b.send_reliable(Bytes{9}, network.now()).ok());
  const std::uint64_t before = network.packets;
  const auto got = pair.a.receive(network.now());
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->data, Bytes{9}) << "its peer's alone";
  EXPECT_EQ(network.packets, before + 1) << "no answer but the peer's";
  EXPECT_EQ(pair.a.statistics().ignored, 6u);
}

TEST(Datagram, RubbishFromThePeersAddressDoesNothing) {
  TestNetwork network(3);
  Pair pair(network);
  Rng rng(8);
  int messages = 0;
  for (std::uint32_t round = 0; round < 2000; ++round) {
    const double now = network.now();
    for (int i = 0; i < 20; ++i) {
      Bytes bytes = message_of(rng.below(40), rng.next());
      if (bytes.size() >= 4 && rng.below(2) == 0) {  // past the first check
        bytes[2] = 0;
        bytes[3] = static_cast<std::uint8_t>(bytes.size());
        if (rng.below(2) == 0) bytes[0] = 0;
      }
      // Numbers far from those in use: an attacker who knows the current ones can forge anything (as in NetQuake).
      if (bytes.size() >= 8) bytes[4] |= 0x80u;
      network.forge(kB, kA, bytes);
    }
    if (pair.b.can_send()) {
      ASSERT_TRUE(pair.b.send_reliable(message_of(1 + rng.below(3000), round), now).ok());
    }
    while (auto got = pair.a.receive(now))
      if (got->reliable) ++messages;
    (void)pair.b.receive(now);
    network.advance(kFrame);
    ASSERT_TRUE(pair.a.is_open());
  }
  EXPECT_GT(messages, 500);
}

// One that is ahead cannot be honest, as the one before it was not acknowledged: a word on it would lose its message.
TEST(Datagram, PiecesAheadGetNoWord) {
  TestNetwork network;
  Pair pair(network);
  network.forge(kB, kA, write_packet({PacketKind::kData, true, 1, Bytes{1}}));
  network.forge(kB, kA, write_packet({PacketKind::kData, true, 0x7fffffff, Bytes{1}}));
  EXPECT_FALSE(pair.a.receive(network.now()).has_value());
  EXPECT_EQ(network.packets, 0u);
  network.forge(kB, kA, write_packet({PacketKind::kData, true, 0, Bytes{2}}));
  EXPECT_EQ(pair.a.receive(network.now())->data, Bytes{2});
  EXPECT_EQ(network.packets, 1u);
}

// Late words on an earlier piece do not count for the one in flight.
TEST(Datagram, OnlyTheWordOnThisPieceCounts) {
  TestNetwork network;
  Pair pair(network);
  ASSERT_TRUE(pair.a.send_reliable(Bytes(3000), network.now()).ok());
  for (const std::uint32_t sequence : {0u, 0u, 0xffffffffu, 2u}) {
    network.forge(kB, kA, write_packet({PacketKind::kAck, false, sequence, {}}));
    (void)pair.a.receive(network.now());
  }
  EXPECT_EQ(pair.a.statistics().packets_sent, 2u);
  EXPECT_EQ(pair.a.statistics().stale, 3u);
}

TEST(Datagram, MessageWithoutEndCloses) {
  TestNetwork network;
  Pair pair(network);
  const Bytes piece(1024, 1);
  for (std::uint32_t i = 0; i < 200 && pair.a.is_open(); ++i) {
    network.forge(kB, kA, write_packet({PacketKind::kData, false, i, piece}));
    EXPECT_FALSE(pair.a.receive(network.now()).has_value());
  }
  EXPECT_FALSE(pair.a.is_open());
  EXPECT_EQ(pair.a.close_reason(), "the other side sent a message longer than any may be");
}

// QuakeSpasm sends what fits 64000 bytes in one piece.
TEST(Datagram, LongPiecesOfOtherEngines) {
  TestNetwork network;
  Pair pair(network);
  const Bytes sent = message_of(64000, 4);
  network.forge(kB, kA, write_packet({PacketKind::kData, true, 0, sent}));
  const auto got = pair.a.receive(network.now());
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->data, sent);
  network.forge(kB, kA, write_packet({PacketKind::kUnreliable, false, 0, sent}));
  EXPECT_EQ(pair.a.receive(network.now())->data, sent);
  network.forge(kB, kA, write_packet({PacketKind::kUnreliable, false, 1, Bytes(64001)}));
  EXPECT_FALSE(pair.a.receive(network.now()).has_value());
}

TEST(Datagram, AFloodDoesNotHoldUpTheFrame) {
  TestNetwork network;
  Pair pair(network);
  for (int i = 0; i < 5000; ++i) network.forge(kStranger, kA, Bytes{1});
  ASSERT_TRUE(pair.b.send_unreliable(Bytes{7}, network.now()).ok());
  int calls = 1;
  while (!pair.a.receive(network.now())) ++calls;
  EXPECT_GT(calls, 10);
  EXPECT_LT(calls, 100);
}

// What waits in the socket was said in time.
TEST(Datagram, WhoStandsStillTakesNobodyForSilent) {
  TestNetwork network;
  Pair pair(network);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(pair.b.send_unreliable(Bytes{7}, network.now()).ok());
    network.advance(100.0);
  }
  ASSERT_GT(network.now(), kDefaultTimeout);
  EXPECT_TRUE(pair.a.receive(network.now()).has_value());
  EXPECT_TRUE(pair.a.is_open());
}

}  // namespace
}  // namespace fb::net
