#include "net/client_messages.h"

#include <fmt/format.h>

namespace fb::net {

Result<ClientMessage> read_client_message(MessageReader& reader) {
  const std::size_t start = reader.offset();
  const int command = reader.u8();
  ClientMessage message;
  switch (static_cast<Clc>(command)) {
    case Clc::kNop:
      message = clc::Nop{};
      break;
    case Clc::kDisconnect:
      message = clc::Disconnect{};
      break;
    case Clc::kStringCommand:
      message = clc::StringCommand{reader.string()};
      break;
    case Clc::kMove: {
      clc::Move move;
      move.time = reader.f32();
      for (int i = 0; i < 3; ++i) move.view_angles[i] = reader.protocol.extended() ? reader.angle16() : reader.angle();
      move.forward = reader.i16();
      move.side = reader.i16();
      move.up = reader.i16();
      move.buttons = reader.u8();
      move.impulse = reader.u8();
      message = move;
      break;
    }
    default:
      return reader.error_at(start, fmt::format("a client's command {} is unknown", command));
  }
  if (reader.failed()) return reader.error_at(start, fmt::format("a client's command {} is cut short", command));
  return message;
}

void write_client_message(MessageWriter& writer, const ClientMessage& message) {
  if (std::holds_alternative<clc::Nop>(message)) {
    writer.u8(static_cast<int>(Clc::kNop));
  } else if (std::holds_alternative<clc::Disconnect>(message)) {
    writer.u8(static_cast<int>(Clc::kDisconnect));
  } else if (const auto* command = std::get_if<clc::StringCommand>(&message)) {
    writer.u8(static_cast<int>(Clc::kStringCommand));
    writer.string(command->text);
  } else if (const auto* move = std::get_if<clc::Move>(&message)) {
    writer.u8(static_cast<int>(Clc::kMove));
    writer.f32(move->time);
    for (int i = 0; i < 3; ++i) {
      if (writer.protocol.extended())
        writer.angle16(move->view_angles[i]);
      else
        writer.angle(move->view_angles[i]);
    }
    writer.i16(move->forward);
    writer.i16(move->side);
    writer.i16(move->up);
    writer.u8(move->buttons);
    writer.u8(move->impulse);
  }
}

}  // namespace fb::net
