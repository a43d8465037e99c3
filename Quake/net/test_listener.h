// A listener on a network in memory, and those who connect to it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/connect_attempt.h"
#include "net/datagram_listener.h"
#include "net/test_network.h"

namespace fb::net::testing {

inline const Address kServer = ipv4(192, 0, 2, 1, 26000), kClient = ipv4(192, 0, 2, 50, 0),
                     kVictim = ipv4(203, 0, 113, 7, 5000);
constexpr double kFrame = 1.0 / 72.0;

class ListenerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    status.name = "test server";
    status.map = "start";
    status.max_players = 4;
    status.rules = {{"sv_gravity", "800"}, {"sv_maxspeed", "320"}, {"teamplay", "0"}};
    auto opened = DatagramListener::open(
        network.host(kServer), kServer.port, [this] { return status; }, 1);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    listener = std::move(*opened);
    network.watch = [this](const Address&, const Address& to, ByteView data) {
      if (to == kVictim) victim_bytes += data.size();
    };
  }
  void accept_all() {
    while (auto connection = listener->accept(network.now())) {
      accepted.push_back(std::move(connection));
      status.players.push_back({"player", 0, 0, 0.0});
    }
  }
  void frame() {
    accept_all();
    for (auto& connection : accepted)
      while (auto message = connection->receive(network.now())) received.push_back(std::move(message->data));
    // Who has gone leaves its slot.
    for (auto& connection : accepted) {
      if (connection->is_open()) continue;
      gone.push_back(std::move(connection));
      status.players.pop_back();
    }
    std::erase(accepted, nullptr);
    network.advance(kFrame);
  }
  void frames(double seconds) {
    for (const double end = network.now() + seconds; network.now() < end;) frame();
  }
  // The client's end, null if it failed.
  std::unique_ptr<Connection> connect(const Address& from, double seconds = 10.0) {
    ConnectAttempt attempt(network.host(from), kServer);
    const double end = network.now() + seconds;
    while (network.now() < end) {
      const auto state = attempt.poll(network.now());
      if (state == ConnectAttempt::State::kFailed) failure = attempt.failure();
      if (state != ConnectAttempt::State::kTrying) return attempt.take();
      frame();
    }
    return nullptr;
  }
  std::unique_ptr<Socket> open_socket(const Address& at) {
    return std::move(*network.host(at).open(Family::kIpv4, at.port));
  }
  std::optional<ControlReply> ask(Socket& socket, const ControlRequest& request) {
    socket.send_to(kServer, write_control(request));
    accept_all();
    const auto datagram = socket.receive_from();
    if (!datagram) return std::nullopt;
    const auto reply = parse_control_reply(datagram->data);
    EXPECT_TRUE(reply.ok());
    return reply.ok() ? std::optional(*reply) : std::nullopt;
  }

  TestNetwork network;
  ServerStatus status;
  std::unique_ptr<DatagramListener> listener;
  std::vector<std::unique_ptr<Connection>> accepted, gone;
  std::vector<Bytes> received;
  std::string failure;
  std::uint64_t victim_bytes = 0;
};

}  // namespace fb::net::testing
