// Connection control of NetQuake's protocol version 3, game "QUAKE": who asks to connect and what a server says of
// itself, each request and reply in one datagram. Pure functions of bytes; strings are bounded, numbers are not yet
// checked for sense.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::net {

constexpr int kConnectVersion = 3;
constexpr std::string_view kGameName = "QUAKE";
constexpr std::size_t kMaxControlString = 255;

namespace ccreq {
struct Connect {
  std::string game{kGameName};
  int version = kConnectVersion;
  bool operator==(const Connect&) const = default;
};
struct ServerInfo {
  std::string game{kGameName};
  int version = kConnectVersion;
  bool operator==(const ServerInfo&) const = default;
};
struct PlayerInfo {
  int player = 0;  // counted among those who play
  bool operator==(const PlayerInfo&) const = default;
};
struct RuleInfo {
  std::string previous;  // the rule before the one asked for; empty for the first
  bool operator==(const RuleInfo&) const = default;
};
}  // namespace ccreq
using ControlRequest = std::variant<ccreq::Connect, ccreq::ServerInfo, ccreq::PlayerInfo, ccreq::RuleInfo>;

namespace ccrep {
struct Accept {
  std::int32_t port = 0;  // where the server goes on with this client
  bool operator==(const Accept&) const = default;
};
struct Reject {
  std::string reason;
  bool operator==(const Reject&) const = default;
};
struct ServerInfo {
  std::string address;  // as the server sees itself: seldom of use, so empty from here and ignored
  std::string name, map;
  int players = 0, max_players = 0, version = kConnectVersion;
  bool operator==(const ServerInfo&) const = default;
};
struct PlayerInfo {
  int player = 0;
  std::string name;
  std::int32_t colors = 0, frags = 0, seconds = 0;
  std::string address;  // empty from here: nobody's business
  bool operator==(const PlayerInfo&) const = default;
};
struct RuleInfo {
  std::string name, value;  // both empty: there are no more
  bool operator==(const RuleInfo&) const = default;
};
}  // namespace ccrep
using ControlReply = std::variant<ccrep::Accept, ccrep::Reject, ccrep::ServerInfo, ccrep::PlayerInfo, ccrep::RuleInfo>;

// Fail on anything that is not whole. Bytes behind it are let be: other engines put more there.
Result<ControlRequest> parse_control_request(ByteView datagram);
Result<ControlReply> parse_control_reply(ByteView datagram);
Bytes write_control(const ControlRequest& request);
Bytes write_control(const ControlReply& reply);

}  // namespace fb::net
