// A simulated network in memory for tests: hosts with their own addresses, whose packets are lost, repeated, delayed
// and so reordered at random, by a seed. The test controls the time.
#pragma once

#include <functional>
#include <map>
#include <queue>
#include <vector>

#include "base/rng.h"
#include "net/network.h"

namespace fb::net::testing {

struct Weather {
  float loss = 0.0f, repeat = 0.0f;      // chances of a packet
  double delay = 0.0, more_delay = 0.0;  // seconds; up to more_delay is added by chance, which reorders
};

class TestNetwork {
 public:
  explicit TestNetwork(std::uint64_t seed = 1, Weather weather = {}) : weather(weather), rng_(seed) {}
  TestNetwork(const TestNetwork&) = delete;
  TestNetwork& operator=(const TestNetwork&) = delete;

  // The host with this address (its port is ignored). Lives as long as the network.
  Network& host(const Address& address) {
    auto& made = hosts_[address.with_port(0)];
    if (!made) made = std::make_unique<Host>(*this, address.with_port(0));
    return *made;
  }
  double now() const { return now_; }
  void advance(double seconds) { now_ += seconds; }
  // Sends as an attacker who can forge any sender's address; the packet arrives for certain and at once.
  void forge(const Address& from, const Address& to, ByteView data) {
    flying_.push({now_, next_number_++, from, to, Bytes(data.begin(), data.end())});
  }

  Weather weather;
  std::uint64_t packets = 0, bytes = 0, lost = 0;
  // Sees every packet that is sent.
  std::function<void(const Address& from, const Address& to, ByteView data)> watch;

 private:
  struct Flight {
    double time;
    std::uint64_t number;
    Address from, to;
    Bytes data;
    bool operator>(const Flight& o) const { return time != o.time ? time > o.time : number > o.number; }
  };

  class TestSocket final : public Socket {
   public:
    TestSocket(TestNetwork& network, const Address& address) : network_(network), address_(address) {
      network.sockets_[address] = this;
    }
    ~TestSocket() override { network_.sockets_.erase(address_); }
    void send_to(const Address& to, ByteView data) override { network_.send(address_, to, data); }
    std::optional<Datagram> receive_from() override {
      network_.deliver();
      if (inbox.empty()) return std::nullopt;
      current_ = std::move(inbox.front());
      inbox.pop();
      waiting_ -= current_.second.size();
      return Datagram{current_.first, current_.second};
    }
    std::uint16_t port() const override { return address_.port; }
    Family family() const override { return address_.family; }
    // Packets are lost if there is no room.
    void put(const Address& from, const Bytes& data) {
      if (waiting_ + data.size() > kRoom) return;
      waiting_ += data.size();
      inbox.emplace(from, data);
    }

   private:
    static constexpr std::size_t kRoom = 212992;  // bytes, as Linux has it
    std::queue<std::pair<Address, Bytes>> inbox;
    std::size_t waiting_ = 0;
    TestNetwork& network_;
    Address address_;
    std::pair<Address, Bytes> current_;
  };

  class Host final : public Network {
   public:
    Host(TestNetwork& network, const Address& address) : network_(network), address_(address) {}
    Result<std::unique_ptr<Socket>> open(Family family, std::uint16_t port) override {
      if (family != address_.family) return Error{"network: no such family here"};
      if (port == 0) port = network_.next_port_++;
      const Address address = address_.with_port(port);
      if (network_.sockets_.contains(address)) return Error{"network: the port is taken"};
      return std::unique_ptr<Socket>(std::make_unique<TestSocket>(network_, address));
    }
    Result<Address> resolve(std::string_view name, std::uint16_t default_port) override {
      if (const auto address = parse_address(name, default_port)) return *address;
      return Error{std::string(name) + ": no such host"};
    }

   private:
    TestNetwork& network_;
    Address address_;
  };

  void send(const Address& from, const Address& to, ByteView data) {
    ++packets;
    bytes += data.size();
    if (watch) watch(from, to, data);
    if (to.same_host(broadcast(0))) {
      for (const auto& [address, socket] : sockets_)
        if (address.port == to.port && address.family == to.family) fly(from, address, data);
    } else {
      fly(from, to, data);
    }
  }
  void fly(const Address& from, const Address& to, ByteView data) {
    if (rng_.uniform() < weather.loss) {
      ++lost;
      return;
    }
    const int copies = rng_.uniform() < weather.repeat ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      const double delay = weather.delay + weather.more_delay * static_cast<double>(rng_.uniform());
      flying_.push({now_ + delay, next_number_++, from, to, Bytes(data.begin(), data.end())});
    }
  }
  void deliver() {
    while (!flying_.empty() && flying_.top().time <= now_) {
      const Flight& flight = flying_.top();
      if (const auto socket = sockets_.find(flight.to); socket != sockets_.end())
        socket->second->put(flight.from, flight.data);
      flying_.pop();
    }
  }

  Rng rng_;
  double now_ = 0.0;
  std::uint16_t next_port_ = 40000;
  std::uint64_t next_number_ = 0;
  std::priority_queue<Flight, std::vector<Flight>, std::greater<>> flying_;
  std::map<Address, TestSocket*> sockets_;
  std::map<Address, std::unique_ptr<Host>> hosts_;
};

}  // namespace fb::net::testing
