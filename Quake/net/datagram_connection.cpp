#include "net/datagram_connection.h"

#include <algorithm>
#include <utility>

namespace fb::net {
namespace {

constexpr double kResendAfter = 1.0;                                           // seconds
constexpr int kMostPacketsACall = 256;                                         // limits the time of a flood in a frame
constexpr double kFirstProbe = 0.25, kProbeEvery = 1.0, kNeverAnswered = 8.0;  // seconds from connecting
constexpr int kMostProbes = 5;
constexpr std::uint8_t kNop = 1;  // svc_nop, and clc_nop

// How far `number` is ahead of `expected`, across the wrap-around of 32 bits.
std::int32_t ahead(std::uint32_t number, std::uint32_t expected) {
  return static_cast<std::int32_t>(number - expected);
}

}  // namespace

DatagramConnection::DatagramConnection(std::unique_ptr<Socket> socket, const Address& peer, double now, double timeout)
    : socket_(std::move(socket)),
      peer_(std::make_shared<Peer>(Peer{peer, now})),
      connect_time_(now),
      timeout_(timeout),
      next_probe_(now + kFirstProbe) {}

DatagramConnection::~DatagramConnection() { peer_->open = false; }

void DatagramConnection::close_because(std::string_view reason) {
  if (!peer_->open) return;
  peer_->open = false;
  peer_->close_reason = reason;
}

Status DatagramConnection::check_message(ByteView message) const {
  if (!is_open()) return Error{address() + ": the connection is closed (" + std::string(close_reason()) + ")"};
  if (message.empty() || message.size() > kMaxMessage)
    return Error{address() + ": a message of " + std::to_string(message.size()) + " bytes"};
  return ok_status();
}

Status DatagramConnection::send_reliable(ByteView message, double now) {
  if (auto status = check_message(message); !status) return status;
  if (!can_send()) return Error{address() + ": the last reliable message is still on its way"};
  in_flight_.assign(message.begin(), message.end());
  in_flight_offset_ = 0;
  send_fragment(now, false);
  return ok_status();
}

Status DatagramConnection::send_unreliable(ByteView message, double) {
  if (auto status = check_message(message); !status) return status;
  if (verified_) send({PacketKind::kUnreliable, false, unreliable_send_sequence_++, message});
  return ok_status();
}

void DatagramConnection::send(const Packet& packet) {
  socket_->send_to(peer_->address, write_packet(packet));
  ++sent_;
  ++statistics_.packets_sent;
}

void DatagramConnection::say_nothing() {
  const Bytes nothing = {kNop};
  socket_->send_to(peer_->address,
                   write_packet({PacketKind::kUnreliable, false, unreliable_send_sequence_++, nothing}));
  ++sent_;
}

void DatagramConnection::send_fragment(double now, bool again) {
  const std::size_t left = in_flight_.size() - in_flight_offset_;
  const ByteView piece = ByteView(in_flight_).subspan(in_flight_offset_, std::min(left, kFragment));
  send({PacketKind::kData, left <= kFragment, send_sequence_, piece});
  if (again) ++statistics_.packets_resent;
  last_send_ = now;
}

void DatagramConnection::do_what_time_demands(double now) {
  if (now - peer_->last_heard > timeout_) return close_because("timed out");
  if (verified_) {
    if (!in_flight_.empty() && now - last_send_ > kResendAfter) send_fragment(now, true);
    return;
  }
  if (now - connect_time_ > kNeverAnswered) return close_because("never answered");
  if (now < next_probe_ || probes_ == kMostProbes) return;
  const bool again = !in_flight_.empty();
  if (!again) in_flight_ = {kNop};
  send_fragment(now, again);
  ++probes_;
  next_probe_ = now + kProbeEvery;
}

// What has arrived counts before the time that has passed: after a stall of one's own nobody has been silent.
bool DatagramConnection::poll_peer(double now) {
  if (!verified_ && is_open()) early_ = read_packets(now);
  if (is_open()) do_what_time_demands(now);
  return verified_;
}

std::optional<ReceivedMessage> DatagramConnection::receive(double now) {
  if (early_) return std::exchange(early_, std::nullopt);
  auto message = read_packets(now);
  if (is_open()) do_what_time_demands(now);
  return message;
}

std::optional<ReceivedMessage> DatagramConnection::read_packets(double now) {
  for (int i = 0; i < kMostPacketsACall && is_open(); ++i) {
    const auto datagram = socket_->receive_from();
    if (!datagram) return std::nullopt;
    const auto packet = parse_packet(datagram->data);
    if (datagram->from != peer_->address || !packet || packet->kind == PacketKind::kControl) {
      ++statistics_.ignored;
      continue;
    }
    ++statistics_.packets_received;
    peer_->last_heard = now;
    verified_ = true;
    if (auto message = take(*packet, now)) return message;
  }
  return std::nullopt;
}

std::optional<ReceivedMessage> DatagramConnection::take(const Packet& packet, double now) {
  switch (packet.kind) {
    case PacketKind::kAck:
      take_ack(packet.sequence, now);
      return std::nullopt;
    case PacketKind::kData:
      return take_fragment(packet);
    case PacketKind::kUnreliable: {
      const std::int32_t gap = ahead(packet.sequence, unreliable_receive_sequence_);
      if (gap < 0) {
        ++statistics_.stale;
        return std::nullopt;
      }
      statistics_.unreliable_lost += static_cast<std::uint64_t>(gap);
      unreliable_receive_sequence_ = packet.sequence + 1;
      if (packet.payload.empty() || packet.payload.size() > kMaxMessage) return std::nullopt;
      return ReceivedMessage{false, Bytes(packet.payload.begin(), packet.payload.end())};
    }
    case PacketKind::kNak:  // no engine sends one
    case PacketKind::kControl:
      return std::nullopt;
  }
  return std::nullopt;
}

void DatagramConnection::take_ack(std::uint32_t sequence, double now) {
  if (in_flight_.empty() || sequence != send_sequence_) {
    ++statistics_.stale;
    return;
  }
  ++send_sequence_;
  in_flight_offset_ += kFragment;
  if (in_flight_offset_ < in_flight_.size()) {
    send_fragment(now, false);
  } else {
    in_flight_.clear();
    in_flight_offset_ = 0;
  }
}

std::optional<ReceivedMessage> DatagramConnection::take_fragment(const Packet& packet) {
  const std::int32_t gap = ahead(packet.sequence, receive_sequence_);
  if (gap > 0) {  // the one before has not arrived, so no peer that waits for acknowledgements can have sent it
    ++statistics_.ignored;
    return std::nullopt;
  }
  // Acknowledges a repeated one, too: the earlier acknowledgement may have been lost.
  send({PacketKind::kAck, false, packet.sequence, {}});
  if (gap < 0) {
    ++statistics_.duplicates;
    return std::nullopt;
  }
  ++receive_sequence_;
  if (arriving_.size() + packet.payload.size() > kMaxMessage) {
    close_because("the other side sent a message longer than any may be");
    return std::nullopt;
  }
  arriving_.insert(arriving_.end(), packet.payload.begin(), packet.payload.end());
  if (!packet.end_of_message) return std::nullopt;
  Bytes message = std::exchange(arriving_, {});
  if (message.empty()) return std::nullopt;
  return ReceivedMessage{true, std::move(message)};
}

}  // namespace fb::net
