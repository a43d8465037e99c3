// The system's UDP sockets; no other file uses them.
#include "net/network.h"

#include <cstring>
#include <string>

#include "net/sockets.h"

namespace fb::net {
namespace {

struct SystemAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

SystemAddress to_system(const Address& address) {
  SystemAddress system;
  if (address.family == Family::kIpv4) {
    sockaddr_in in{};
    in.sin_family = AF_INET;
    in.sin_port = htons(address.port);
    std::memcpy(&in.sin_addr, address.bytes.data(), 4);
    std::memcpy(&system.storage, &in, system.size = sizeof in);
  } else {
    sockaddr_in6 in{};
    in.sin6_family = AF_INET6;
    in.sin6_port = htons(address.port);
    in.sin6_scope_id = address.scope;
    std::memcpy(&in.sin6_addr, address.bytes.data(), 16);
    std::memcpy(&system.storage, &in, system.size = sizeof in);
  }
  return system;
}

std::optional<Address> from_system(const sockaddr* system) {
  Address address;
  if (system->sa_family == AF_INET) {
    sockaddr_in in;
    std::memcpy(&in, system, sizeof in);
    address.port = ntohs(in.sin_port);
    std::memcpy(address.bytes.data(), &in.sin_addr, 4);
    return address;
  }
  if (system->sa_family != AF_INET6) return std::nullopt;
  sockaddr_in6 in;
  std::memcpy(&in, system, sizeof in);
  address.family = Family::kIpv6;
  address.port = ntohs(in.sin6_port);
  address.scope = in.sin6_scope_id;
  std::memcpy(address.bytes.data(), &in.sin6_addr, 16);
  return address;
}

class SystemSocket final : public Socket {
 public:
  SystemSocket(SocketHandle handle, Family family) : handle_(handle), family_(family) {}
  ~SystemSocket() override { close_socket(handle_); }
  SystemSocket(const SystemSocket&) = delete;
  SystemSocket& operator=(const SystemSocket&) = delete;

  void send_to(const Address& to, ByteView data) override {
    if (to.family != family_) return;
    const SystemAddress system = to_system(to);
    send_datagram(handle_, data, system.get(), system.size);
  }
  std::optional<Datagram> receive_from() override {
    for (int interruptions = 0; interruptions < 16; ++interruptions) {
      SystemAddress system;
      const auto size = receive_datagram(handle_, buffer_, system.get(), &system.size);
      if (size) {
        const auto from = from_system(system.get());
        if (!from) continue;
        return Datagram{*from, ByteView(buffer_).first(*size)};
      }
      if (!may_receive_again()) break;
    }
    return std::nullopt;
  }
  std::uint16_t port() const override { return port_; }
  Family family() const override { return family_; }
  void set_port(std::uint16_t port) { port_ = port; }

 private:
  SocketHandle handle_;
  Family family_;
  std::uint16_t port_ = 0;
  Bytes buffer_ = Bytes(65536);
};

class SystemNetwork final : public Network {
 public:
  explicit SystemNetwork(const NetworkOptions& options) : options_(options) { start_sockets(); }

  Result<std::unique_ptr<Socket>> open(Family family, std::uint16_t port) override {
    if (!options_.uses(family)) return Error{"network: " + switched_off(family)};
    const SocketHandle handle = ::socket(family == Family::kIpv4 ? AF_INET : AF_INET6, SOCK_DGRAM, 0);
    if (handle == kNoSocket) return failure("a UDP socket cannot be made");
    auto socket = std::make_unique<SystemSocket>(handle, family);  // closes the handle if anything below fails
    const int yes = 1;
    set_option(handle, SOL_SOCKET, SO_BROADCAST, yes);
    // Each address family has its own socket, so that no IPv4 address arrives as an IPv4-mapped IPv6 one.
    if (family == Family::kIpv6) set_option(handle, IPPROTO_IPV6, IPV6_V6ONLY, yes);
    if (!make_prompt(handle)) return failure("a UDP socket cannot be made not to block");
    Address any;
    any.family = family;
    const Address own = options_.own_address.value_or(any).with_port(port);
    SystemAddress system = to_system(own);
    if (::bind(handle, system.get(), system.size) < 0) {
      const std::string at = options_.own_address ? " at " + own.to_string() : std::string();
      return failure("UDP port " + std::to_string(port) + at + " cannot be had");
    }
    system.size = sizeof system.storage;
    if (::getsockname(handle, system.get(), &system.size) < 0) return failure("a UDP socket does not know its port");
    const auto bound = from_system(system.get());
    if (!bound) return Error{"network: a UDP socket of an unknown family"};
    socket->set_port(bound->port);
    return std::unique_ptr<Socket>(std::move(socket));
  }

  bool any_thread() const override { return true; }

  Result<Address> resolve(std::string_view name, std::uint16_t default_port) override {
    if (const auto address = parse_address(name, default_port)) return *address;
    const auto parts = split_port(name, default_port);
    if (!parts) return parts.error();
    const auto& [host, port] = *parts;
    if (host.empty()) return Error{"network: no server is named"};
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_DGRAM;
    wanted.ai_flags = AI_ADDRCONFIG;
    addrinfo* found = nullptr;
    if (const int code = ::getaddrinfo(host.c_str(), nullptr, &wanted, &found); code != 0)
      return Error{host + ": " + lookup_failure(code)};
    std::optional<Address> address;
    for (const addrinfo* at = found; at != nullptr && !address; at = at->ai_next) {
      address = from_system(at->ai_addr);
      if (address && !options_.uses(address->family)) address.reset();
    }
    ::freeaddrinfo(found);
    if (!address) return Error{host + ": has no address that a game can use"};
    return address->with_port(port);
  }

 private:
  std::string switched_off(Family family) const {
    const std::string off = " is switched off by the command line";
    if (!options_.any()) return "it" + off;
    return (family == Family::kIpv4 ? "IPv4" : "IPv6") + off;
  }
  static Error failure(std::string_view what) {
    return Error{"network: " + std::string(what) + " (" + socket_failure() + ")"};
  }

  NetworkOptions options_;
};

}  // namespace

std::unique_ptr<Network> system_network(const NetworkOptions& options) {
  return std::make_unique<SystemNetwork>(options);
}

}  // namespace fb::net
