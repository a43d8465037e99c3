#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>

namespace fb::net {

using SocketHandle = int;
constexpr SocketHandle kNoSocket = -1;

inline void start_sockets() {}
inline void close_socket(SocketHandle handle) { ::close(handle); }
// Calls return at once, and programs that this one starts do not have it.
inline bool make_prompt(SocketHandle handle) {
  const int flags = ::fcntl(handle, F_GETFL);
  return flags >= 0 && ::fcntl(handle, F_SETFL, flags | O_NONBLOCK) >= 0 && ::fcntl(handle, F_SETFD, FD_CLOEXEC) >= 0;
}
template <typename Value>
void set_option(SocketHandle handle, int level, int option, const Value& value) {
  ::setsockopt(handle, level, option, &value, sizeof value);
}
inline void send_datagram(SocketHandle handle, std::span<const std::uint8_t> data, const sockaddr* to, socklen_t size) {
  (void)::sendto(handle, data.data(), data.size(), 0, to, size);
}
// Its bytes; nothing if there is none.
inline std::optional<std::size_t> receive_datagram(SocketHandle handle, std::span<std::uint8_t> into, sockaddr* from,
                                                   socklen_t* size) {
  const ssize_t got = ::recvfrom(handle, into.data(), into.size(), 0, from, size);
  return got >= 0 ? std::optional(static_cast<std::size_t>(got)) : std::nullopt;
}
// Whether the last receive_datagram() failed by an interruption, or by an error that another host returned for an
// earlier packet.
inline bool may_receive_again() { return errno == EINTR || errno == ECONNREFUSED; }
inline std::string socket_failure() { return std::strerror(errno); }
inline std::string lookup_failure(int code) { return ::gai_strerror(code); }

}  // namespace fb::net
