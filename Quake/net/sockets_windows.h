// Winsock: what sockets_posix.h says.
#pragma once

#include <winsock2.h>
#include <ws2tcpip.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <system_error>

namespace fb::net {

using SocketHandle = SOCKET;
constexpr SocketHandle kNoSocket = INVALID_SOCKET;

inline void start_sockets() {
  static const int started = [] {
    WSADATA facts;
    return WSAStartup(MAKEWORD(2, 2), &facts);
  }();
  (void)started;  // where it fails, so does the first socket
}
inline void close_socket(SocketHandle handle) { ::closesocket(handle); }
inline bool make_prompt(SocketHandle handle) {
  u_long yes = 1;
  SetHandleInformation(reinterpret_cast<HANDLE>(handle), HANDLE_FLAG_INHERIT, 0);
  return ::ioctlsocket(handle, FIONBIO, &yes) == 0;
}
template <typename Value>
void set_option(SocketHandle handle, int level, int option, const Value& value) {
  ::setsockopt(handle, level, option, reinterpret_cast<const char*>(&value), static_cast<int>(sizeof value));
}
inline void send_datagram(SocketHandle handle, std::span<const std::uint8_t> data, const sockaddr* to, socklen_t size) {
  (void)::sendto(handle, reinterpret_cast<const char*>(data.data()), static_cast<int>(data.size()), 0, to, size);
}
inline std::optional<std::size_t> receive_datagram(SocketHandle handle, std::span<std::uint8_t> into, sockaddr* from,
                                                   socklen_t* size) {
  const int got =
      ::recvfrom(handle, reinterpret_cast<char*>(into.data()), static_cast<int>(into.size()), 0, from, size);
  return got >= 0 ? std::optional(static_cast<std::size_t>(got)) : std::nullopt;
}
inline bool may_receive_again() {
  const int why = WSAGetLastError();
  return why == WSAEINTR || why == WSAECONNRESET || why == WSAENETRESET || why == WSAEMSGSIZE;
}
inline std::string socket_failure() { return std::system_category().message(WSAGetLastError()); }
inline std::string lookup_failure(int code) { return std::system_category().message(code); }

}  // namespace fb::net
