#include "net/server_messages.h"

#include <fmt/format.h>

#include "net/fields.h"

namespace fb::net {
namespace {

std::string unknown_protocol(int version) {
  return fmt::format("the server speaks protocol {}, not 15, 666 or 999", version);
}

std::string read_server_info(MessageReader& r, svc::ServerInfo& m) {
  m.protocol.version = r.i32();
  if (r.failed()) return {};
  if (!is_known_protocol(m.protocol.version)) return unknown_protocol(m.protocol.version);
  if (m.protocol.version == kProtocolRmq) m.protocol.flags = static_cast<std::uint32_t>(r.i32());
  r.protocol = m.protocol;
  m.max_clients = r.u8();
  m.game_type = r.u8();
  m.level_name = r.string();
  for (auto* list : {&m.models, &m.sounds}) {
    while (true) {
      std::string name = r.string();
      if (name.empty()) break;
      if (list->size() + 1 == kMaxPrecaches) return fmt::format("more than {} precaches", kMaxPrecaches - 1);
      list->push_back(std::move(name));
    }
  }
  if (!r.failed() && (m.max_clients < 1 || m.max_clients > kMaxClients))
    return fmt::format("{} players, not 1 to {}", m.max_clients, kMaxClients);
  return {};
}

// Reads the fields after the command and returns the cause of an error, or "". The caller checks for a truncated
// message.
struct Read {
  MessageReader& r;
  unsigned command;

  template <typename M>
  std::string operator()(M& m) const {
    read_fields(r, m);
    return {};
  }
  std::string operator()(svc::EntityUpdate& m) const {
    m = read_update(r, command);
    return {};
  }
  std::string operator()(svc::ClientData& m) const {
    m = read_client_data(r);
    return {};
  }
  std::string operator()(svc::Sound& m) const {
    m = read_sound(r);
    return {};
  }
  std::string operator()(svc::ServerInfo& m) const { return read_server_info(r, m); }
  std::string operator()(svc::Version& m) const {
    read_fields(r, m);
    if (!is_known_protocol(m.version)) return unknown_protocol(m.version);
    r.protocol.version = m.version;
    return {};
  }
  std::string operator()(svc::TempEntity& m) const {
    read_fields(r, m);
    if (m.type <= TempEntityType::kBeam) return {};
    return fmt::format("temporary entity {} is unknown", static_cast<int>(m.type));
  }
};

struct Write {
  MessageWriter& w;

  template <typename M>
  void operator()(const M& m) const {
    w.u8(command_of(m).number);
    body(m);
  }
  void operator()(const svc::EntityUpdate& m) const { write_update(w, m); }

  template <typename M>
  void body(const M& m) const {
    write_fields(w, m);
  }
  void body(const svc::ClientData& m) const { write_client_data(w, m); }
  void body(const svc::Sound& m) const { write_sound(w, m); }
  void body(const svc::ServerInfo& m) const {
    w.i32(m.protocol.version);
    if (m.protocol.version == kProtocolRmq) w.i32(static_cast<std::int32_t>(m.protocol.flags));
    w.u8(m.max_clients);
    w.u8(m.game_type);
    w.string(m.level_name);
    for (const auto* list : {&m.models, &m.sounds}) {
      for (const std::string& name : *list) w.string(name);
      w.u8(0);
    }
    w.protocol = m.protocol;
  }
};

}  // namespace

std::string_view svc_name(unsigned command) {
  static constexpr auto kNames = command_names(static_cast<const ServerMessage*>(nullptr));
  if (command == 0) return "svc_bad";
  if (command & kUpdateSignal) return "fast update";
  return command < kNames.size() && !kNames[command].empty() ? kNames[command] : "svc_?";
}

Error ServerMessageReader::error(std::string_view cause) const {
  return reader_.error_at(start_,
                          fmt::format("{} (after {}): {}", svc_name(command_), svc_name(previous_command_), cause));
}

Result<ServerMessage> ServerMessageReader::next() {
  previous_command_ = command_;
  start_ = reader_.offset();
  command_ = static_cast<unsigned>(reader_.u8());
  ServerMessage message;
  if (command_ & kUpdateSignal)
    message.emplace<svc::EntityUpdate>();
  else if (!begin_message(message, command_))
    return error(fmt::format("command {} is unknown", command_));
  const std::string cause = std::visit(Read{reader_, command_}, message);
  if (!cause.empty()) return error(cause);
  if (reader_.not_finite()) return error("a number is not finite");
  if (reader_.failed()) return error("the message is cut short");
  return message;
}

void write_server_message(MessageWriter& writer, const ServerMessage& message) { std::visit(Write{writer}, message); }

}  // namespace fb::net
