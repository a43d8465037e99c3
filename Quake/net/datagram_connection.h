// A connection over UDP by NetQuake's protocol: a reliable message is sent in numbered fragments of kFragment bytes.
// Each is sent again every second until the other side acknowledges its number, and only then the next. Unreliable
// messages have their own sequence of numbers; late ones are dropped. Only packets from the peer's address and port are
// accepted.
//
// A client's request to connect may carry a forged address. So a server sends nothing to a peer that has not yet sent a
// packet from that address to its new port, except a reliable message of one byte (svc_nop) every second, five times:
// engines that do not send first (Quake's own) acknowledge it. See DatagramListener.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "net/connection.h"
#include "net/network.h"
#include "net/packet.h"

namespace fb::net {

struct DatagramStatistics {
  std::uint64_t packets_sent = 0, packets_resent = 0, packets_received = 0;
  std::uint64_t duplicates = 0, stale = 0, ignored = 0;  // received: repeated, too late, malformed or a stranger's
  std::uint64_t unreliable_lost = 0;                     // gaps in the sequence of unreliable messages
};

class DatagramConnection final : public Connection {
 public:
  // A listener's view of a connection that it does not own.
  struct Peer {
    Address address;
    double last_heard = 0.0;
    bool open = true;
    bool signed_on = false;  // see Connection::set_signed_on
    std::string close_reason = {};
  };

  DatagramConnection(std::unique_ptr<Socket> socket, const Address& peer, double now, double timeout = kDefaultTimeout);
  ~DatagramConnection() override;

  bool can_send() const override { return is_open() && verified_ && in_flight_.empty(); }
  Status send_reliable(ByteView message, double now) override;
  Status send_unreliable(ByteView message, double now) override;
  std::optional<ReceivedMessage> receive(double now) override;
  bool is_open() const override { return peer_->open; }
  std::string_view close_reason() const override { return peer_->close_reason; }
  void close() override { close_because("closed"); }
  std::string address() const override { return peer_->address.to_string(); }
  bool is_local() const override { return false; }
  std::size_t unreliable_limit() const override { return kDatagramMtu; }
  double connect_time() const override { return connect_time_; }
  void set_signed_on() override { peer_->signed_on = true; }
  void say_nothing() override;
  std::uint64_t packets_sent() const override { return sent_; }

  const DatagramStatistics& statistics() const { return statistics_; }
  void set_timeout(double seconds) { timeout_ = seconds; }
  std::uint16_t local_port() const { return socket_->port(); }

  // For the listener. The peer is not trusted until it has sent a packet; poll_peer sends the probe and returns whether
  // it has.
  void doubt_peer() { verified_ = false; }
  bool poll_peer(double now);
  std::shared_ptr<Peer> peer() const { return peer_; }

 private:
  void close_because(std::string_view reason);
  Status check_message(ByteView message) const;
  void send(const Packet& packet);
  void send_fragment(double now, bool again);
  void do_what_time_demands(double now);
  std::optional<ReceivedMessage> read_packets(double now);
  std::optional<ReceivedMessage> take(const Packet& packet, double now);
  void take_ack(std::uint32_t sequence, double now);
  std::optional<ReceivedMessage> take_fragment(const Packet& packet);

  std::unique_ptr<Socket> socket_;
  std::shared_ptr<Peer> peer_;
  double connect_time_, timeout_;
  bool verified_ = true;
  int probes_ = 0;
  double next_probe_;
  std::optional<ReceivedMessage> early_;  // arrived while the listener waited

  Bytes in_flight_;  // the reliable message that is being sent; empty: none
  std::size_t in_flight_offset_ = 0;
  double last_send_ = 0.0;
  std::uint32_t send_sequence_ = 0;  // of the fragment in flight, or the next one
  Bytes arriving_;                   // fragments so far
  std::uint32_t receive_sequence_ = 0;
  std::uint32_t unreliable_receive_sequence_ = 0;
  DatagramStatistics statistics_;

  // With the socket's send_to and the peer's address, all that say_nothing() touches.
  std::atomic<std::uint32_t> unreliable_send_sequence_{0};
  std::atomic<std::uint64_t> sent_{0};
};

}  // namespace fb::net
