#include "net/connect_attempt.h"

#include "net/control.h"
#include "net/datagram_connection.h"

namespace fb::net {
namespace {

constexpr int kMostTries = 3, kMostPacketsACall = 64;
constexpr double kTryEvery = 2.5;  // seconds
constexpr std::uint8_t kClcNop = 1;

}  // namespace

ConnectAttempt::ConnectAttempt(Network& network, const Address& server) : server_(server) {
  auto socket = network.open(server.family, 0);
  if (socket)
    socket_ = std::move(*socket);
  else
    fail(socket.error().message);
}

ConnectAttempt::State ConnectAttempt::fail(std::string why) {
  failure_ = std::move(why);
  return state_ = State::kFailed;
}

ConnectAttempt::State ConnectAttempt::poll(double now) {
  for (int i = 0; i < kMostPacketsACall && state_ == State::kTrying; ++i) {
    const auto datagram = socket_->receive_from();
    if (!datagram) break;
    if (datagram->from == server_) take_reply(datagram->data, now);
  }
  if (state_ != State::kTrying || (tries_ > 0 && now < next_try_)) return state_;
  if (tries_ == kMostTries) return fail("no response");
  socket_->send_to(server_, write_control(ControlRequest(ccreq::Connect{})));
  ++tries_;
  next_try_ = now + kTryEvery;
  return state_;
}

ConnectAttempt::State ConnectAttempt::take_reply(ByteView datagram, double now) {
  const auto reply = parse_control_reply(datagram);
  if (!reply) return state_;
  if (const auto* reject = std::get_if<ccrep::Reject>(&*reply)) {
    std::string reason = reject->reason;
    while (!reason.empty() && (reason.back() == '\n' || reason.back() == ' ')) reason.pop_back();
    return fail(reason.empty() ? "rejected" : std::move(reason));
  }
  const auto* accept = std::get_if<ccrep::Accept>(&*reply);
  if (accept == nullptr || accept->port < 1 || accept->port > 65535) return state_;
  const Address game = server_.with_port(static_cast<std::uint16_t>(accept->port));
  auto connection = std::make_unique<DatagramConnection>(std::move(socket_), game, now, timeout_);
  // Sends the first packet, so that a NAT on this side lets the server's packets from the new port through.
  (void)connection->send_reliable(Bytes{kClcNop}, now);
  connection_ = std::move(connection);
  return state_ = State::kConnected;
}

}  // namespace fb::net
