// NetQuake's datagrams. Eight bytes in front, big-endian: flags and the packet's length (16 bits, with these eight),
// then a sequence number; a control packet has the first four alone (control.h). Pure functions of bytes.
#pragma once

#include <cstdint>

#include "base/bytes.h"
#include "base/result.h"
#include "net/connection.h"

namespace fb::net {

enum class PacketKind : std::uint8_t { kData, kAck, kNak, kUnreliable, kControl };

struct Packet {
  PacketKind kind = PacketKind::kData;
  bool end_of_message = false;  // the last piece of a reliable message
  std::uint32_t sequence = 0;
  ByteView payload;  // within the datagram it was read from
};

constexpr std::size_t kPacketHeader = 8;
constexpr std::size_t kControlHeader = 4;
// A piece of a reliable message. Quake's first MAX_DATAGRAM, so that every engine ever made has room for it; peers may
// send longer ones.
constexpr std::size_t kFragment = 1024;

// Fails where the length is not the datagram's, and on flags that no engine sends together.
Result<Packet> parse_packet(ByteView datagram);
// kControl has no sequence: see write_control.
Bytes write_packet(const Packet& packet);

}  // namespace fb::net
