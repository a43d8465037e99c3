#include "net/packet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "net/control.h"

namespace fb::net {
namespace {

using ::testing::ElementsAre;

TEST(Packet, AsOnTheWire) {
  const Bytes data = {'h', 'i'};
  EXPECT_THAT(write_packet({PacketKind::kData, true, 0x01020304, data}),
              ElementsAre(0x00, 0x09, 0x00, 0x0a, 0x01, 0x02, 0x03, 0x04, 'h', 'i'));
  EXPECT_THAT(write_packet({PacketKind::kData, false, 1, data}),
              ElementsAre(0x00, 0x01, 0x00, 0x0a, 0, 0, 0, 1, 'h', 'i'));
  EXPECT_THAT(write_packet({PacketKind::kAck, false, 2, {}}), ElementsAre(0x00, 0x02, 0x00, 0x08, 0, 0, 0, 2));
  EXPECT_THAT(write_packet({PacketKind::kUnreliable, false, 3, data}),
              ElementsAre(0x00, 0x10, 0x00, 0x0a, 0, 0, 0, 3, 'h', 'i'));
  EXPECT_THAT(write_packet({PacketKind::kControl, false, 0, data}), ElementsAre(0x80, 0x00, 0x00, 0x06, 'h', 'i'));
}

TEST(Packet, ComesBack) {
  const Bytes data(64000, 7);
  for (const PacketKind kind :
       {PacketKind::kData, PacketKind::kAck, PacketKind::kNak, PacketKind::kUnreliable, PacketKind::kControl}) {
    const Bytes bytes = write_packet({kind, kind == PacketKind::kData, 0xfffffffe, data});
    const auto packet = parse_packet(bytes);
    ASSERT_TRUE(packet.ok()) << packet.error().message;
    EXPECT_EQ(packet->kind, kind);
    EXPECT_EQ(packet->end_of_message, kind == PacketKind::kData);
    EXPECT_EQ(packet->sequence, kind == PacketKind::kControl ? 0u : 0xfffffffeu);
    EXPECT_EQ(packet->payload.size(), data.size());
  }
}

TEST(Packet, RefusesWhatMakesNoSense) {
  const Bytes good = write_packet({PacketKind::kData, true, 5, Bytes{1, 2, 3}});
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(parse_packet(ByteView(good).first(size)).ok()) << size;
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_FALSE(parse_packet(longer).ok());
  for (const int flags : {0x0000, 0x0003, 0x0008, 0x0018, 0x000a, 0x0011, 0x8001, 0xffff, 0x0020}) {
    Bytes bytes = good;
    bytes[0] = static_cast<std::uint8_t>(flags >> 8);
    bytes[1] = static_cast<std::uint8_t>(flags & 0xff);
    EXPECT_FALSE(parse_packet(bytes).ok()) << flags;
  }
  EXPECT_FALSE(parse_packet(Bytes{0x00, 0x02, 0x00, 0x04}).ok()) << "no sequence";
}

TEST(Control, AsOnTheWire) {
  EXPECT_THAT(write_control(ControlRequest(ccreq::Connect{})),
              ElementsAre(0x80, 0x00, 0x00, 0x0c, 0x01, 'Q', 'U', 'A', 'K', 'E', 0, 3));
  EXPECT_THAT(write_control(ControlRequest(ccreq::ServerInfo{})),
              ElementsAre(0x80, 0x00, 0x00, 0x0c, 0x02, 'Q', 'U', 'A', 'K', 'E', 0, 3));
  EXPECT_THAT(write_control(ControlReply(ccrep::Accept{0x1234})),
              ElementsAre(0x80, 0x00, 0x00, 0x09, 0x81, 0x34, 0x12, 0, 0));
  EXPECT_THAT(write_control(ControlReply(ccrep::RuleInfo{})), ElementsAre(0x80, 0x00, 0x00, 0x05, 0x85));
}

TEST(Control, ComesBack) {
  const std::vector<ControlRequest> requests = {ccreq::Connect{"DUKE", 7}, ccreq::ServerInfo{}, ccreq::PlayerInfo{15},
                                                ccreq::RuleInfo{"sv_gravity"}, ccreq::RuleInfo{}};
  for (const ControlRequest& request : requests) {
    Bytes bytes = write_control(request);
    const auto read = parse_control_request(bytes);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, request);
    EXPECT_FALSE(parse_control_reply(bytes).ok());
  }
  const std::vector<ControlReply> replies = {ccrep::Accept{40001},
                                             ccrep::Reject{"Server is full.\n"},
                                             ccrep::ServerInfo{"192.0.2.1:26000", "the server", "start", 3, 16, 3},
                                             ccrep::PlayerInfo{2, "ranger", 0xd4, -7, 3600, "private"},
                                             ccrep::RuleInfo{"sv_gravity", "800"},
                                             ccrep::RuleInfo{}};
  for (const ControlReply& reply : replies) {
    Bytes bytes = write_control(reply);
    const auto read = parse_control_reply(bytes);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, reply);
    EXPECT_FALSE(parse_control_request(bytes).ok());
    // Cut short anywhere, with a header that says so.
    for (std::size_t size = kControlHeader; size < bytes.size(); ++size) {
      const Bytes cut = write_packet({PacketKind::kControl, false, 0, ByteView(bytes).subspan(4, size - 4)});
      if (std::holds_alternative<ccrep::RuleInfo>(reply) && size == 5) continue;  // that is the end of the list
      EXPECT_FALSE(parse_control_reply(cut).ok()) << reply.index() << " " << size;
    }
  }
}

// Engines put words of their own behind a request.
TEST(Control, LetsBeWhatFollows) {
  Bytes bytes = write_control(ControlRequest(ccreq::Connect{}));
  bytes.insert(bytes.end(), {1, 34, 0, 0, 0});
  bytes[3] = static_cast<std::uint8_t>(bytes.size());
  EXPECT_TRUE(parse_control_request(bytes).ok());
}

TEST(Control, StringsAreBounded) {
  const auto named = [](std::size_t n) {
    return parse_control_request(write_control(ControlRequest(ccreq::RuleInfo{std::string(n, 'x')}))).ok();
  };
  EXPECT_TRUE(named(kMaxControlString));
  EXPECT_FALSE(named(kMaxControlString + 1));
}

}  // namespace
}  // namespace fb::net
