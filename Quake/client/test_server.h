// For tests: a server that knows no QuakeC: it signs clients on as Quake's does, and moves a player in a straight line
// as fast as the client's moves say.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/test_demo.h"
#include "net/client_messages.h"
#include "net/connection.h"
#include "net/loopback.h"

namespace fb::cl::test {

class FakeServer {
 public:
  explicit FakeServer(const net::Protocol& protocol = {}) : protocol_(protocol) {}

  std::unique_ptr<net::Connection> connect() {
    auto [client, server] = net::make_loopback(0.0);
    take(std::move(server));
    return std::move(client);
  }
  void take(std::unique_ptr<net::Connection> connection) {
    connection_ = std::move(connection);
    begin_level();
  }
  bool has_client() const { return connection_ && connection_->is_open(); }
  void begin_level() {
    spawned = false;
    time = 1.0;
    origin = vec3(0, 0, 24);
    say({server_info(protocol_), net::svc::SetView{1}, net::svc::SignonNum{1}});
  }
  void change_level() {
    say({net::svc::StuffText{"reconnect\n"}});
    begin_level();
  }
  // Reliable, in order, when it may go.
  void say(const std::vector<net::ServerMessage>& messages) { waiting_.push_back(datagram(messages, protocol_)); }
  void say_raw(Bytes bytes) { waiting_.push_back(std::move(bytes)); }
  void hang_up() { connection_->close(); }

  // Reads what has come, moves the player on, says so.
  void frame(double seconds, double now) {
    if (!connection_) return;
    while (auto message = connection_->receive(now)) hear(message->data);
    if (!waiting_.empty() && connection_->can_send()) {
      ASSERT_TRUE(connection_->send_reliable(waiting_.front(), now).ok());
      waiting_.erase(waiting_.begin());
    }
    if (!spawned) return;
    time += seconds;
    if (!moves.empty()) {
      const AxisVectors axes = angle_vectors({0.0f, moves.back().view_angles.y, 0.0f});
      origin += axes.forward * (static_cast<float>(moves.back().forward) * static_cast<float>(seconds));
    }
    net::svc::ClientData data;
    data.health = 100;
    data.on_ground = true;
    std::vector<net::ServerMessage> messages{net::svc::Time{static_cast<float>(time)}, data, update(1, 3, origin)};
    messages.insert(messages.end(), extra.begin(), extra.end());
    extra.clear();
    (void)connection_->send_unreliable(datagram(messages, protocol_), now);
  }

  std::vector<std::string> commands;
  std::vector<net::clc::Move> moves;
  std::vector<net::ServerMessage> extra;  // goes with the next frame's datagram
  int nops = 0;
  bool spawned = false, said_goodbye = false;
  double time = 1.0;
  vec3 origin{0.0f};

 private:
  void hear(ByteView data) {
    net::MessageReader reader(data, "client", protocol_);
    while (!reader.at_end()) {
      auto message = net::read_client_message(reader);
      ASSERT_TRUE(message.ok()) << message.error().message;
      if (const auto* command = std::get_if<net::clc::StringCommand>(&*message)) obey(command->text);
      if (const auto* move = std::get_if<net::clc::Move>(&*message)) moves.push_back(*move);
      if (std::holds_alternative<net::clc::Disconnect>(*message)) said_goodbye = true;
      if (std::holds_alternative<net::clc::Nop>(*message)) ++nops;
    }
  }
  void obey(const std::string& text) {
    commands.push_back(text);
    if (text == "prespawn") say({net::svc::SpawnBaseline{1, {}, false}, net::svc::SignonNum{2}});
    if (text == "spawn")
      say({net::svc::UpdateName{0, "tester"}, net::svc::LightStyle{3, "mz"}, net::svc::SetAngle{{0, 90, 0}},
           net::svc::SignonNum{3}});
    if (text == "begin") spawned = true;
  }

  net::Protocol protocol_;
  std::unique_ptr<net::Connection> connection_;
  std::vector<Bytes> waiting_;
};

}  // namespace fb::cl::test
