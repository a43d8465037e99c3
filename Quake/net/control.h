// Connection control of NetQuake's protocol version 3, game "QUAKE": requests to connect and queries about a server,
// each request and reply in one datagram. Pure functions of bytes; strings are bounded, but the range of numbers is not
// checked yet.
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
  int player = 0;  // index among the players
  bool operator==(const PlayerInfo&) const = default;
};
struct RuleInfo {
  std::string previous;  // the rule before the requested one; empty for the first
  bool operator==(const RuleInfo&) const = default;
};
}  // namespace ccreq
using ControlRequest = std::variant<ccreq::Connect, ccreq::ServerInfo, ccreq::PlayerInfo, ccreq::RuleInfo>;

namespace ccrep {
struct Accept {
  std::int32_t port = 0;  // the server's port for this client
  bool operator==(const Accept&) const = default;
};
struct Reject {
  std::string reason;
  bool operator==(const Reject&) const = default;
};
struct ServerInfo {
  std::string address;  // the server's own idea of its address: seldom correct, so sent empty and ignored
  std::string name, map;
  int players = 0, max_players = 0, version = kConnectVersion;
  bool operator==(const ServerInfo&) const = default;
};
struct PlayerInfo {
  int player = 0;
  std::string name;
  std::int32_t colors = 0, frags = 0, seconds = 0;
  std::string address;  // sent empty, for privacy
  bool operator==(const PlayerInfo&) const = default;
};
struct RuleInfo {
  std::string name, value;  // both empty: the end of the list
  bool operator==(const RuleInfo&) const = default;
};
}  // namespace ccrep
using ControlReply = std::variant<ccrep::Accept, ccrep::Reject, ccrep::ServerInfo, ccrep::PlayerInfo, ccrep::RuleInfo>;

// Fail on incomplete datagrams. Bytes after the message are ignored: other engines put more there.
Result<ControlRequest> parse_control_request(ByteView datagram);
Result<ControlReply> parse_control_reply(ByteView datagram);
Bytes write_control(const ControlRequest& request);
Bytes write_control(const ControlReply& reply);

}  // namespace fb::net
