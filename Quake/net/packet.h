// NetQuake's datagrams. They start with eight bytes, big-endian: flags and the packet's length (16 bits, including
// these eight), then a sequence number; a control packet has only the first four (control.h). Pure functions of bytes.
#pragma once

#include <cstdint>

#include "base/bytes.h"
#include "base/result.h"
#include "net/connection.h"

namespace fb::net {

enum class PacketKind : std::uint8_t { kData, kAck, kNak, kUnreliable, kControl };

struct Packet {
  PacketKind kind = PacketKind::kData;
  bool end_of_message = false;  // the last fragment of a reliable message
  std::uint32_t sequence = 0;
  ByteView payload;  // a part of the datagram it was read from
};

constexpr std::size_t kPacketHeader = 8;
constexpr std::size_t kControlHeader = 4;
// Size of a fragment of a reliable message. Quake's first MAX_DATAGRAM, for which every engine has room; peers may send
// longer ones.
constexpr std::size_t kFragment = 1024;

// Fails if the length is not the datagram's, and on combinations of flags that no engine sends.
Result<Packet> parse_packet(ByteView datagram);
// kControl has no sequence: see write_control.
Bytes write_packet(const Packet& packet);

}  // namespace fb::net
