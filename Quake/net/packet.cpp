#include "net/packet.h"

#include <optional>

#include "base/check.h"

namespace fb::net {
namespace {

constexpr std::uint32_t kLengthMask = 0x0000ffff;
constexpr std::uint32_t kFlagData = 0x00010000, kFlagAck = 0x00020000, kFlagNak = 0x00040000, kFlagEnd = 0x00080000;
constexpr std::uint32_t kFlagUnreliable = 0x00100000, kFlagControl = 0x80000000;

std::uint32_t big_endian(ByteView bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24u | std::uint32_t{bytes[at + 1]} << 16u | std::uint32_t{bytes[at + 2]} << 8u |
         std::uint32_t{bytes[at + 3]};
}
void put_big_endian(Bytes& out, std::uint32_t value) {
  for (const unsigned shift : {24u, 16u, 8u, 0u}) out.push_back(static_cast<std::uint8_t>(value >> shift & 0xffu));
}

std::uint32_t flags_of(const Packet& packet) {
  switch (packet.kind) {
    case PacketKind::kData:
      return packet.end_of_message ? kFlagData | kFlagEnd : kFlagData;
    case PacketKind::kAck:
      return kFlagAck;
    case PacketKind::kNak:
      return kFlagNak;
    case PacketKind::kUnreliable:
      return kFlagUnreliable;
    case PacketKind::kControl:
      return kFlagControl;
  }
  return 0;
}

std::optional<PacketKind> kind_of(std::uint32_t flags) {
  switch (flags) {
    case kFlagData:
    case kFlagData | kFlagEnd:
      return PacketKind::kData;
    case kFlagAck:
      return PacketKind::kAck;
    case kFlagNak:
      return PacketKind::kNak;
    case kFlagUnreliable:
      return PacketKind::kUnreliable;
    case kFlagControl:
      return PacketKind::kControl;
    default:
      return std::nullopt;
  }
}

}  // namespace

Result<Packet> parse_packet(ByteView datagram) {
  if (datagram.size() < kControlHeader) return Error{"packet: shorter than any header"};
  const std::uint32_t header = big_endian(datagram, 0);
  if ((header & kLengthMask) != datagram.size()) return Error{"packet: its length is not the datagram's"};
  const auto kind = kind_of(header & ~kLengthMask);
  if (!kind) return Error{"packet: flags that mean nothing together"};
  Packet packet{*kind, (header & kFlagEnd) != 0, 0, datagram.subspan(kControlHeader)};
  if (packet.kind == PacketKind::kControl) return packet;
  if (datagram.size() < kPacketHeader) return Error{"packet: no sequence number"};
  packet.sequence = big_endian(datagram, 4);
  packet.payload = datagram.subspan(kPacketHeader);
  return packet;
}

Bytes write_packet(const Packet& packet) {
  const bool control = packet.kind == PacketKind::kControl;
  const std::size_t size = (control ? kControlHeader : kPacketHeader) + packet.payload.size();
  FB_CHECK_LE(size, kLengthMask);
  Bytes out;
  out.reserve(size);
  put_big_endian(out, flags_of(packet) | static_cast<std::uint32_t>(size));
  if (!control) put_big_endian(out, packet.sequence);
  out.insert(out.end(), packet.payload.begin(), packet.payload.end());
  return out;
}

}  // namespace fb::net
