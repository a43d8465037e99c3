#include "net/client_messages.h"

#include <fmt/format.h>

#include "net/fields.h"

namespace fb::net {

Result<ClientMessage> read_client_message(MessageReader& reader) {
  const std::size_t start = reader.offset();
  const int command = reader.u8();
  ClientMessage message;
  if (!begin_message(message, static_cast<unsigned>(command)))
    return reader.error_at(start, fmt::format("a client's command {} is unknown", command));
  std::visit([&](auto& m) { read_fields(reader, m); }, message);
  if (reader.failed()) return reader.error_at(start, fmt::format("a client's command {} is cut short", command));
  return message;
}

void write_client_message(MessageWriter& writer, const ClientMessage& message) {
  const auto write = [&](const auto& m) {
    writer.u8(command_of(m).number);
    write_fields(writer, m);
  };
  std::visit(write, message);
}

}  // namespace fb::net
