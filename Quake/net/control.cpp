#include "net/control.h"

#include <optional>

#include "net/message.h"
#include "net/packet.h"

namespace fb::net {
namespace {

enum Command : int {
  kConnectRequest = 0x01,
  kServerInfoRequest = 0x02,
  kPlayerInfoRequest = 0x03,
  kRuleInfoRequest = 0x04,
  kAcceptReply = 0x81,
  kRejectReply = 0x82,
  kServerInfoReply = 0x83,
  kPlayerInfoReply = 0x84,
  kRuleInfoReply = 0x85,
};

// A reader at the command, or why there is none.
Result<MessageReader> open_control(ByteView datagram) {
  const auto packet = parse_packet(datagram);
  if (!packet) return packet.error();
  if (packet->kind != PacketKind::kControl) return Error{"packet: not one of connection control"};
  return MessageReader(packet->payload, "connection control");
}

// Reads a string; not good() if it is longer than the longest allowed.
std::string short_string(MessageReader& reader, bool& good) {
  std::string text = reader.string();
  if (text.size() > kMaxControlString) good = false;
  return text;
}

Bytes finish(const MessageWriter& writer) { return write_packet({PacketKind::kControl, false, 0, writer.bytes()}); }

void write(MessageWriter& w, const ccreq::Connect& r) {
  w.u8(kConnectRequest);
  w.string(r.game);
  w.u8(r.version);
}
void write(MessageWriter& w, const ccreq::ServerInfo& r) {
  w.u8(kServerInfoRequest);
  w.string(r.game);
  w.u8(r.version);
}
void write(MessageWriter& w, const ccreq::PlayerInfo& r) {
  w.u8(kPlayerInfoRequest);
  w.u8(r.player);
}
void write(MessageWriter& w, const ccreq::RuleInfo& r) {
  w.u8(kRuleInfoRequest);
  w.string(r.previous);
}
void write(MessageWriter& w, const ccrep::Accept& r) {
  w.u8(kAcceptReply);
  w.i32(r.port);
}
void write(MessageWriter& w, const ccrep::Reject& r) {
  w.u8(kRejectReply);
  w.string(r.reason);
}
void write(MessageWriter& w, const ccrep::ServerInfo& r) {
  w.u8(kServerInfoReply);
  w.string(r.address);
  w.string(r.name);
  w.string(r.map);
  w.u8(r.players);
  w.u8(r.max_players);
  w.u8(r.version);
}
void write(MessageWriter& w, const ccrep::PlayerInfo& r) {
  w.u8(kPlayerInfoReply);
  w.u8(r.player);
  w.string(r.name);
  w.i32(r.colors);
  w.i32(r.frags);
  w.i32(r.seconds);
  w.string(r.address);
}
void write(MessageWriter& w, const ccrep::RuleInfo& r) {
  w.u8(kRuleInfoReply);
  if (r.name.empty()) return;  // an empty reply ends the list
  w.string(r.name);
  w.string(r.value);
}

template <typename Message>
Bytes write_any(const Message& message) {
  MessageWriter writer;
  std::visit([&](const auto& m) { write(writer, m); }, message);
  return finish(writer);
}

}  // namespace

Result<ControlRequest> parse_control_request(ByteView datagram) {
  auto opened = open_control(datagram);
  if (!opened) return opened.error();
  MessageReader& reader = *opened;
  bool good = true;
  std::optional<ControlRequest> request;
  switch (reader.u8()) {
    case kConnectRequest: {
      ccreq::Connect r;
      r.game = short_string(reader, good);
      r.version = reader.u8();
      request = std::move(r);
      break;
    }
    case kServerInfoRequest: {
      ccreq::ServerInfo r;
      r.game = short_string(reader, good);
      r.version = reader.u8();
      request = std::move(r);
      break;
    }
    case kPlayerInfoRequest:
      request = ccreq::PlayerInfo{reader.u8()};
      break;
    case kRuleInfoRequest:
      request = ccreq::RuleInfo{short_string(reader, good)};
      break;
    default:
      good = false;
  }
  if (!good || reader.failed() || !request) return Error{"connection control: a request that makes no sense"};
  return std::move(*request);
}

Result<ControlReply> parse_control_reply(ByteView datagram) {
  auto opened = open_control(datagram);
  if (!opened) return opened.error();
  MessageReader& reader = *opened;
  bool good = true;
  std::optional<ControlReply> reply;
  switch (reader.u8()) {
    case kAcceptReply:
      reply = ccrep::Accept{reader.i32()};
      break;
    case kRejectReply:
      reply = ccrep::Reject{short_string(reader, good)};
      break;
    case kServerInfoReply: {
      ccrep::ServerInfo r;
      r.address = short_string(reader, good);
      r.name = short_string(reader, good);
      r.map = short_string(reader, good);
      r.players = reader.u8();
      r.max_players = reader.u8();
      r.version = reader.u8();
      reply = std::move(r);
      break;
    }
    case kPlayerInfoReply: {
      ccrep::PlayerInfo r;
      r.player = reader.u8();
      r.name = short_string(reader, good);
      r.colors = reader.i32();
      r.frags = reader.i32();
      r.seconds = reader.i32();
      r.address = short_string(reader, good);
      reply = std::move(r);
      break;
    }
    case kRuleInfoReply: {
      ccrep::RuleInfo r;
      if (!reader.at_end()) {
        r.name = short_string(reader, good);
        r.value = short_string(reader, good);
      }
      reply = std::move(r);
      break;
    }
    default:
      good = false;
  }
  if (!good || reader.failed() || !reply) return Error{"connection control: a reply that makes no sense"};
  return std::move(*reply);
}

Bytes write_control(const ControlRequest& request) { return write_any(request); }
Bytes write_control(const ControlReply& reply) { return write_any(reply); }

}  // namespace fb::net
