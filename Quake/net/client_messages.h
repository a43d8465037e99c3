// Messages from client to server: movement, and commands as text; each with its command and fields (fields.h).
#pragma once

#include <string>
#include <variant>

#include "base/maths.h"
#include "base/result.h"
#include "net/message.h"

namespace fb::net {
namespace clc {

struct Nop {
  static constexpr Command kCommand{1, "clc_nop"};
  bool operator==(const Nop&) const = default;
};
struct Disconnect {
  static constexpr Command kCommand{2, "clc_disconnect"};
  bool operator==(const Disconnect&) const = default;
};
struct Move {
  static constexpr Command kCommand{3, "clc_move"};
  float time = 0.0f;  // seconds: time of the last server message, to measure the round trip
  vec3 view_angles{0.0f};
  int forward = 0, side = 0, up = 0;  // units a second
  int buttons = 0, impulse = 0;
  static void fields(auto& m, auto& wire) {
    wire.f32(m.time);
    wire.angles_of_move(m.view_angles);
    wire.i16(m.forward);
    wire.i16(m.side);
    wire.i16(m.up);
    wire.u8(m.buttons);
    wire.u8(m.impulse);
  }
  bool operator==(const Move&) const = default;
};
struct StringCommand {
  static constexpr Command kCommand{4, "clc_stringcmd"};
  std::string text;
  static void fields(auto& m, auto& wire) { wire.text(m.text); }
  bool operator==(const StringCommand&) const = default;
};

}  // namespace clc

using ClientMessage = std::variant<clc::Nop, clc::Disconnect, clc::Move, clc::StringCommand>;

Result<ClientMessage> read_client_message(MessageReader& reader);
void write_client_message(MessageWriter& writer, const ClientMessage& message);

}  // namespace fb::net
