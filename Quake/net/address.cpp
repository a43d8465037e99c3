#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "net/network.h"
#include "net/sockets.h"

namespace fb::net {

std::string Address::to_string() const {
  char text[INET6_ADDRSTRLEN] = "";
  const bool v4 = family == Family::kIpv4;
  inet_ntop(v4 ? AF_INET : AF_INET6, bytes.data(), text, sizeof text);
  return v4 ? fmt::format("{}:{}", text, port) : fmt::format("[{}]:{}", text, port);
}

bool Address::same_site(const Address& other) const {
  const bool link_local = bytes[0] == 0xfe && (bytes[1] & 0xc0) == 0x80;
  if (family == Family::kIpv4 || family != other.family || link_local) return same_host(other);
  return std::equal(bytes.begin(), bytes.begin() + 8, other.bytes.begin());
}

Address ipv4(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d, std::uint16_t port) {
  Address address;
  address.bytes = {a, b, c, d};
  address.port = port;
  return address;
}

Result<HostAndPort> split_port(std::string_view text, std::uint16_t default_port) {
  std::string_view host = text, port;
  const std::size_t colon = text.rfind(':');
  if (text.starts_with('[')) {
    const std::size_t close = text.find(']');
    host = text.substr(1, close == std::string_view::npos ? close : close - 1);
    if (close != std::string_view::npos && text.substr(close).starts_with("]:")) port = text.substr(close + 2);
  } else if (colon != std::string_view::npos && text.find(':') == colon) {  // more colons: IPv6 without a port
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  if (port.empty()) return HostAndPort{std::string(host), default_port};
  const auto number = whole_number_in<std::uint16_t>(fmt::format("{}: port", host), port, 1);
  if (!number) return number.error();
  return HostAndPort{std::string(host), *number};
}

std::optional<Address> parse_address(std::string_view text, std::uint16_t default_port) {
  const auto parts = split_port(text, default_port);
  if (!parts) return std::nullopt;
  const std::string& host = parts->host;
  Address address;
  address.port = parts->port;
  if (inet_pton(AF_INET, host.c_str(), address.bytes.data()) == 1) return address;
  address.family = Family::kIpv6;
  if (inet_pton(AF_INET6, host.c_str(), address.bytes.data()) == 1) return address;
  return std::nullopt;
}

}  // namespace fb::net
