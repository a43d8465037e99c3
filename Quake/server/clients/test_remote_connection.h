// A connection within the program that counts as one over a network. For tests and fuzzers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "net/connection.h"

namespace fb::sv::testing {

class RemoteConnection final : public net::Connection {
 public:
  explicit RemoteConnection(std::unique_ptr<net::Connection> inner) : inner_(std::move(inner)) {}
  bool can_send() const override { return inner_->can_send(); }
  Status send_reliable(ByteView message, double now) override { return inner_->send_reliable(message, now); }
  Status send_unreliable(ByteView message, double now) override { return inner_->send_unreliable(message, now); }
  std::optional<net::ReceivedMessage> receive(double now) override { return inner_->receive(now); }
  bool is_open() const override { return inner_->is_open(); }
  std::string_view close_reason() const override { return inner_->close_reason(); }
  void close() override { inner_->close(); }
  std::string address() const override { return "192.0.2.1:26001"; }
  bool is_local() const override { return false; }
  std::size_t unreliable_limit() const override { return net::kDatagramMtu; }
  double connect_time() const override { return inner_->connect_time(); }

 private:
  std::unique_ptr<net::Connection> inner_;
};

}  // namespace fb::sv::testing
