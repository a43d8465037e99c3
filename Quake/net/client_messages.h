// Messages from client to server: movement, and commands as text.
#pragma once

#include <string>
#include <variant>

#include "base/maths.h"
#include "base/result.h"
#include "net/message.h"

namespace fb::net {
namespace clc {

struct Nop {
  bool operator==(const Nop&) const = default;
};
struct Disconnect {
  bool operator==(const Disconnect&) const = default;
};
struct Move {
  float time = 0.0f;  // seconds: time of the last server message, to measure the round trip
  vec3 view_angles{0.0f};
  int forward = 0, side = 0, up = 0;  // units a second
  int buttons = 0, impulse = 0;
  bool operator==(const Move&) const = default;
};
struct StringCommand {
  std::string text;
  bool operator==(const StringCommand&) const = default;
};

}  // namespace clc

using ClientMessage = std::variant<clc::Nop, clc::Disconnect, clc::Move, clc::StringCommand>;

Result<ClientMessage> read_client_message(MessageReader& reader);
void write_client_message(MessageWriter& writer, const ClientMessage& message);

}  // namespace fb::net
