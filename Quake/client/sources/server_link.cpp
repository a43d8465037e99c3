#include "client/sources/server_link.h"

#include <utility>

#include "net/server_messages.h"

namespace fb::cl {
namespace {

bool is_keepalive(ByteView data) { return data.size() == 1 && data[0] == net::svc::Nop::kCommand.number; }

Bytes encoded(const net::ClientMessage& message, const net::Protocol& protocol = {}) {
  net::MessageWriter writer(protocol);
  net::write_client_message(writer, message);
  return writer.take();
}

}  // namespace

ServerLink::ServerLink(std::unique_ptr<net::Connection> connection, std::string name)
    : connection_(std::move(connection)), name_(std::move(name)) {}
ServerLink::~ServerLink() = default;

bool ServerLink::command(std::string_view text) {
  if (waiting_.size() >= kMostWaiting || text.size() > net::kMaxMessage / 2) return false;
  waiting_.emplace_back(text);
  return true;
}

void ServerLink::flush(double now) {
  if (waiting_.empty() || !connection_->can_send()) return;
  Bytes message;
  while (!waiting_.empty() && (message.empty() || message.size() + waiting_.front().size() + 2 <= kMessageBytes)) {
    const Bytes command = encoded(net::clc::StringCommand{waiting_.front()});
    message.insert(message.end(), command.begin(), command.end());
    waiting_.pop_front();
  }
  (void)connection_->send_reliable(message, now);
}

std::optional<net::ReceivedMessage> ServerLink::receive(double now) {
  while (auto message = connection_->receive(now))
    if (!is_keepalive(message->data)) return message;
  return std::nullopt;
}

void ServerLink::send_move(const net::clc::Move& move, const net::Protocol& protocol, double now) {
  if (++moves_ <= kDroppedMoves) return;
  (void)connection_->send_unreliable(encoded(move, protocol), now);
}

void ServerLink::keep_alive() { keepalive_ = std::make_unique<net::Keepalive>(*connection_); }

void ServerLink::disconnect(double now) {
  keepalive_.reset();
  (void)connection_->send_unreliable(encoded(net::clc::Disconnect{}), now);
  connection_->close();
}

}  // namespace fb::cl
