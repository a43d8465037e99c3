// What the transport needs of a network: addresses, sockets for datagrams, and somebody who opens them. The system's is
// system_network (POSIX); tests have one in memory that loses, repeats, delays and reorders (test_network.h). Time
// never comes from here: whoever uses the transport passes it in.
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
  std::array<std::uint8_t, 16> bytes{};  // in the order of the wire; IPv4 has four
  std::uint32_t scope = 0;               // IPv6: the interface of a link-local address
  std::uint16_t port = 0;

  auto operator<=>(const Address&) const = default;
  bool same_host(const Address& other) const {
    return family == other.family && bytes == other.bytes && scope == other.scope;
  }
  Address with_port(std::uint16_t other) const {
    Address copy = *this;
    copy.port = other;
    return copy;
  }
  std::string to_string() const;  // "192.0.2.1:26000", "[2001:db8::1]:26000"
};

Address ipv4(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d, std::uint16_t port);
// Everybody on the local network.
inline Address broadcast(std::uint16_t port) { return ipv4(255, 255, 255, 255, port); }
// An address in numbers, with or without a port: "192.0.2.1", "192.0.2.1:26001", "2001:db8::1", "[::1]:26001".
std::optional<Address> parse_address(std::string_view text, std::uint16_t default_port = kDefaultPort);
// "host:26001" to host and port; the default where there is none. Fails where it is no port.
struct HostAndPort {
  std::string host;
  std::uint16_t port;
};
Result<HostAndPort> split_port(std::string_view text, std::uint16_t default_port = kDefaultPort);

// One UDP socket. Closed by its destructor. Nothing here blocks or fails: a datagram that cannot be sent is lost, as
// any may be.
class Socket {
 public:
  struct Datagram {
    Address from;
    ByteView data;  // until the next call
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
  // A socket that may also broadcast; port 0 takes any that is free.
  virtual Result<std::unique_ptr<Socket>> open(Family family, std::uint16_t port) = 0;
  // A name, or an address in numbers, with or without a port. May ask the system's resolver, so it may take seconds.
  virtual Result<Address> resolve(std::string_view name, std::uint16_t default_port = kDefaultPort) = 0;
};

// What of the machine's network may be used.
struct NetworkOptions {
  bool ipv4 = true, ipv6 = true;
  std::optional<Address> own_address =
      std::nullopt;  // sockets have this one of the machine's addresses, and its family alone is used

  bool uses(Family family) const {
    if (own_address && own_address->family != family) return false;
    return family == Family::kIpv4 ? ipv4 : ipv6;
  }
  bool any() const { return uses(Family::kIpv4) || uses(Family::kIpv6); }
};

// The machine's own. Where there is no implementation for the system, or the options leave nothing, open() says so.
std::unique_ptr<Network> system_network(const NetworkOptions& options = {});

}  // namespace fb::net
