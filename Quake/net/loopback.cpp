#include "net/loopback.h"

#include <array>

namespace fb::net {
namespace {

// Shared by both ends. End i receives from inbox[i].
struct Pipe {
  struct Inbox {
    std::deque<ReceivedMessage> messages;
    std::size_t bytes = 0;
  };
  std::array<Inbox, 2> inbox;
  std::array<bool, 2> can_send{true, true};
  std::array<bool, 2> open{true, true};
};

class LoopbackConnection final : public Connection {
 public:
  LoopbackConnection(std::shared_ptr<Pipe> pipe, std::size_t end, double now)
      : pipe_(std::move(pipe)), end_(end), connect_time_(now) {}
  ~LoopbackConnection() override { close(); }

  bool can_send() const override { return is_open() && pipe_->can_send[end_]; }
  Status send_reliable(ByteView message, double) override {
    if (auto status = check(message); !status) return status;
    if (!pipe_->can_send[end_]) return Error{"loopback: the last reliable message is still on its way"};
    pipe_->can_send[end_] = false;
    put(message, true);
    return ok_status();
  }
  Status send_unreliable(ByteView message, double) override {
    if (auto status = check(message); !status) return status;
    if (pipe_->inbox[1 - end_].bytes + message.size() <= kMaxMessage) put(message, false);
    return ok_status();
  }
  std::optional<ReceivedMessage> receive(double) override {
    Pipe::Inbox& inbox = pipe_->inbox[end_];
    if (!pipe_->open[end_] || inbox.messages.empty()) return std::nullopt;
    ReceivedMessage message = std::move(inbox.messages.front());
    inbox.messages.pop_front();
    inbox.bytes -= message.data.size();
    if (message.reliable) pipe_->can_send[1 - end_] = true;
    return message;
  }
  bool is_open() const override { return pipe_->open[0] && pipe_->open[1]; }
  std::string_view close_reason() const override {
    if (!pipe_->open[end_]) return "closed";
    return pipe_->open[1 - end_] ? "" : "closed by the other side";
  }
  void close() override { pipe_->open[end_] = false; }
  std::string address() const override { return "LOCAL"; }
  bool is_local() const override { return true; }
  std::size_t unreliable_limit() const override { return kMaxMessage; }
  double connect_time() const override { return connect_time_; }

 private:
  Status check(ByteView message) const {
    if (!is_open()) return Error{"loopback: the connection is closed"};
    if (message.empty() || message.size() > kMaxMessage)
      return Error{"loopback: a message of " + std::to_string(message.size()) + " bytes"};
    return ok_status();
  }
  void put(ByteView message, bool reliable) {
    Pipe::Inbox& inbox = pipe_->inbox[1 - end_];
    inbox.messages.push_back({reliable, Bytes(message.begin(), message.end())});
    inbox.bytes += message.size();
  }

  std::shared_ptr<Pipe> pipe_;
  std::size_t end_;
  double connect_time_;
};

}  // namespace

std::pair<std::unique_ptr<Connection>, std::unique_ptr<Connection>> make_loopback(double now) {
  auto pipe = std::make_shared<Pipe>();
  return {std::make_unique<LoopbackConnection>(pipe, 0, now), std::make_unique<LoopbackConnection>(pipe, 1, now)};
}

std::unique_ptr<Connection> LoopbackListener::connect(double now) {
  auto [client, server] = make_loopback(now);
  waiting_.push_back(std::move(server));
  return std::move(client);
}

std::unique_ptr<Connection> LoopbackListener::accept(double) {
  if (waiting_.empty()) return nullptr;
  auto server = std::move(waiting_.front());
  waiting_.pop_front();
  return server;
}

}  // namespace fb::net
