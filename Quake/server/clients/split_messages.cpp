#include "server/clients/split_messages.h"

#include "net/server_messages.h"

namespace fb::sv {

std::size_t whole_messages(ByteView bytes, std::size_t most, const net::Protocol& protocol) {
  if (bytes.size() <= most) return bytes.size();
  net::ServerMessageReader reader(bytes, "what waits to be sent", protocol);
  std::size_t whole = 0;
  while (!reader.at_end() && reader.next() && reader.offset() <= most) whole = reader.offset();
  return whole;
}

std::vector<Bytes> split_messages(ByteView bytes, std::size_t most, const net::Protocol& protocol) {
  std::vector<Bytes> parts;
  net::ServerMessageReader reader(bytes, "what waits to be sent", protocol);
  std::size_t begin = 0, whole = 0;
  const auto cut = [&](std::size_t end) {
    if (end > begin)
      parts.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                         bytes.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  };
  while (!reader.at_end()) {
    const bool readable = reader.next().ok();
    const std::size_t end = readable ? reader.offset() : bytes.size();
    if (end - begin > most) cut(whole);
    whole = end;
    if (!readable) break;
  }
  cut(bytes.size());
  return parts;
}

}  // namespace fb::sv
