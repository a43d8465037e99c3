// Reads and writes messages by the description that their structs contain: the command, and the fields once, in their
// order on the wire:
//
//   struct SetPause {
//     static constexpr Command kCommand{24, "svc_setpause"};
//     bool paused = false;
//     static void fields(auto& m, auto& wire) { wire.flag(m.paused); }
//   };
//
// A struct with a member `extended` may have a second command, kExtendedCommand, for the same message with wider
// fields. A message whose layout depends on its values has functions for reading and writing instead (state_codec.h).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "base/maths.h"
#include "net/message.h"
#include "net/state_codec.h"

namespace fb::net {

// The two directions of a list of fields.
struct FieldReader {
  MessageReader& r;
  void u8(int& v) { v = r.u8(); }
  void i8(int& v) { v = r.i8(); }
  void u16(int& v) { v = r.u16(); }
  void i16(int& v) { v = r.i16(); }
  void i32(std::int32_t& v) { v = r.i32(); }
  void f32(float& v) { v = r.f32(); }
  void flag(bool& v) { v = r.u8() != 0; }
  void coords(vec3& v) { v = r.coords(); }
  void angles(vec3& v) { v = r.angles(); }
  void angles_of_move(vec3& v) {
    for (int i = 0; i < 3; ++i) v[i] = r.protocol.extended() ? r.angle16() : r.angle();
  }
  void text(std::string& v) { v = r.string(); }
  template <typename Enum>
  void one_of(Enum& v) {  // the caller checks its range
    v = static_cast<Enum>(r.u8());
  }
  void entity_channel(int& entity, int& channel) {
    const int both = r.u16();
    entity = both >> 3;
    channel = both & 7;
  }
  void state(EntityState& v, bool extended) { v = read_baseline(r, extended); }
};
struct FieldWriter {
  MessageWriter& w;
  void u8(int v) { w.u8(v); }
  void i8(int v) { w.i8(v); }
  void u16(int v) { w.u16(v); }
  void i16(int v) { w.i16(v); }
  void i32(std::int32_t v) { w.i32(v); }
  void f32(float v) { w.f32(v); }
  void flag(bool v) { w.u8(v ? 1 : 0); }
  void coords(const vec3& v) { w.coords(v); }
  void angles(const vec3& v) { w.angles(v); }
  void angles_of_move(const vec3& v) {
    for (int i = 0; i < 3; ++i) {
      if (w.protocol.extended())
        w.angle16(v[i]);
      else
        w.angle(v[i]);
    }
  }
  void text(const std::string& v) { w.string(v); }
  template <typename Enum>
  void one_of(Enum v) {
    w.u8(static_cast<int>(v));
  }
  void entity_channel(int entity, int channel) { w.u16((entity << 3) | (channel & 7)); }
  void state(const EntityState& v, bool extended) { write_baseline(w, v, extended); }
};

template <typename M>
void read_fields(MessageReader& reader, M& message) {
  if constexpr (!std::is_empty_v<M>) {
    FieldReader wire{reader};
    M::fields(message, wire);
  }
}
template <typename M>
void write_fields(MessageWriter& writer, const M& message) {
  if constexpr (!std::is_empty_v<M>) {
    FieldWriter wire{writer};
    M::fields(message, wire);
  }
}

template <typename M>
concept HasExtendedCommand = requires {
  M::kExtendedCommand;
};
template <typename M>
concept HasCommand = requires {
  M::kCommand;
};

template <HasCommand M>
constexpr const Command& command_of(const M& message) {
  if constexpr (HasExtendedCommand<M>) return message.extended ? M::kExtendedCommand : M::kCommand;
  return M::kCommand;
}

// Sets `message` to the alternative with this command, with default values. False: no alternative has it.
template <typename... M>
bool begin_message(std::variant<M...>& message, unsigned command) {
  const auto begin = [&]<typename T>(std::type_identity<T>) {
    if constexpr (HasExtendedCommand<T>) {
      if (command == T::kExtendedCommand.number) {
        message.template emplace<T>().extended = true;
        return true;
      }
    }
    if constexpr (HasCommand<T>) {
      if (command == T::kCommand.number) {
        message.template emplace<T>();
        return true;
      }
    }
    return false;
  };
  return (begin(std::type_identity<M>{}) || ...);
}

// The names of all commands, by number; empty for none. Two messages with the same command do not compile.
template <typename... M>
consteval std::array<std::string_view, 128> command_names(const std::variant<M...>*) {
  std::array<std::string_view, 128> names{};
  const auto add = [&names](const Command& command) {
    if (!names[command.number].empty()) throw "two messages have one command";
    names[command.number] = command.name;
  };
  const auto add_all_of = [&add]<typename T>(std::type_identity<T>) {
    if constexpr (HasCommand<T>) add(T::kCommand);
    if constexpr (HasExtendedCommand<T>) add(T::kExtendedCommand);
  };
  (add_all_of(std::type_identity<M>{}), ...);
  return names;
}

}  // namespace fb::net
