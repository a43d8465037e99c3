// The interface of a network for the transport: addresses, sockets for datagrams, and a factory that opens them. The
// system's is system_network (POSIX); tests have one in memory that loses, repeats, delays and reorders packets
// (test_network.h). It provides no time: users of the transport pass it in.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::net {

constexpr std::uint16_t kDefaultPort = 26000;

enum class Family : std::uint8_t { kIpv4, kIpv6 };

struct Address {
  Family family = Family::kIpv4;
  std::array<std::uint8_t, 16> bytes{};  // in network byte order; IPv4 has four
  std::uint32_t scope = 0;               // IPv6: the interface of a link-local address
  std::uint16_t port = 0;

  auto operator<=>(const Address&) const = default;
  bool same_host(const Address& other) const {
    return family == other.family && bytes == other.bytes && scope == other.scope;
  }
  // The same host as far as others can tell: which of a network's IPv6 addresses it has is for a host to choose.
  bool same_site(const Address& other) const;
  Address with_port(std::uint16_t other) const {
    Address copy = *this;
    copy.port = other;
    return copy;
  }
  std::string to_string() const;  // "192.0.2.1:26000", "[2001:db8::1]:26000"
};

Address ipv4(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d, std::uint16_t port);
// The broadcast address of the local network.
inline Address broadcast(std::uint16_t port) { return ipv4(255, 255, 255, 255, port); }
// Parses a numeric address, with or without a port: "192.0.2.1", "192.0.2.1:26001", "2001:db8::1", "[::1]:26001".
std::optional<Address> parse_address(std::string_view text, std::uint16_t default_port = kDefaultPort);
// Splits "host:26001" into host and port; the default port if there is none. Fails if the port is invalid.
struct HostAndPort {
  std::string host;
  std::uint16_t port;
};
Result<HostAndPort> split_port(std::string_view text, std::uint16_t default_port = kDefaultPort);

// A UDP socket. Its destructor closes it. Nothing here blocks or fails: a datagram that cannot be sent is lost, as any
// may be.
class Socket {
 public:
  struct Datagram {
    Address from;
    ByteView data;  // valid until the next call
  };
  virtual ~Socket() = default;
  virtual void send_to(const Address& to, ByteView data) = 0;
  virtual std::optional<Datagram> receive_from() = 0;
  virtual std::uint16_t port() const = 0;
  virtual Family family() const = 0;
};

class Network {
 public:
  virtual ~Network() = default;
  // Opens a socket that may also broadcast; port 0 takes any free port.
  virtual Result<std::unique_ptr<Socket>> open(Family family, std::uint16_t port) = 0;
  // Whether a socket's send_to may be called from another thread than the one that uses it.
  virtual bool any_thread() const { return false; }
  // Resolves a name, or a numeric address, with or without a port. May use the system's resolver, so it may take
  // seconds.
  virtual Result<Address> resolve(std::string_view name, std::uint16_t default_port = kDefaultPort) = 0;
};

// Which parts of the machine's network may be used.
struct NetworkOptions {
  bool ipv4 = true, ipv6 = true;
  std::optional<Address> own_address =
      std::nullopt;  // bind sockets to this address of the machine, and use its family only

  bool uses(Family family) const {
    if (own_address && own_address->family != family) return false;
    return family == Family::kIpv4 ? ipv4 : ipv6;
  }
  bool any() const { return uses(Family::kIpv4) || uses(Family::kIpv6); }
};

// The system's network. If there is no implementation for the system, or the options disable everything, open() returns
// an error.
std::unique_ptr<Network> system_network(const NetworkOptions& options = {});

}  // namespace fb::net
