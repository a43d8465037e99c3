// Corrupts bytes in ways that matter to packets: flipped bits, removed, doubled and exchanged parts, extreme numbers;
// and makes packets' headers valid again, so that they get as far as possible. For tests and floods.
#pragma once

#include <algorithm>
#include <array>

#include "base/bytes.h"
#include "base/rng.h"

namespace fb::net::testing {

inline Bytes random_bytes(Rng& rng, std::uint32_t most) {
  Bytes bytes(rng.below(most + 1));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(rng.next());
  return bytes;
}

// One corruption.
inline void mutate_once(Bytes& bytes, Rng& rng) {
  constexpr std::array<std::uint8_t, 8> kEnds = {0, 1, 0x7f, 0x80, 0xff, '"', '\\', '\n'};
  const auto size = static_cast<std::uint32_t>(bytes.size());
  if (size == 0) {
    bytes = random_bytes(rng, 16);
    return;
  }
  const auto at = bytes.begin() + rng.below(size);
  switch (rng.below(7)) {
    case 0:
      *at = static_cast<std::uint8_t>(*at ^ 1u << rng.below(8));
      break;
    case 1:
      *at = kEnds[rng.below(kEnds.size())];
      break;
    case 2:
      std::fill(at, at + std::min<std::ptrdiff_t>(4, bytes.end() - at), kEnds[rng.below(5)]);  // a number, or a float
      break;
    case 3:
      bytes.erase(at, bytes.end());
      break;
    case 4:
      bytes.erase(at, at + std::min<std::ptrdiff_t>(1 + rng.below(8), bytes.end() - at));
      break;
    case 5: {
      const Bytes piece(at, at + std::min<std::ptrdiff_t>(1 + rng.below(64), bytes.end() - at));
      bytes.insert(bytes.begin() + rng.below(size), piece.begin(), piece.end());
      break;
    }
    default: {
      const Bytes piece = random_bytes(rng, 24);
      bytes.insert(at, piece.begin(), piece.end());
    }
  }
}

inline void mutate(Bytes& bytes, Rng& rng) {
  for (std::uint32_t i = 1 + rng.below(4); i > 0; --i) mutate_once(bytes, rng);
}

// Joins the first half of one and the second of another.
inline Bytes spliced(const Bytes& a, const Bytes& b, Rng& rng) {
  Bytes both(a.begin(), a.begin() + rng.below(static_cast<std::uint32_t>(a.size()) + 1));
  both.insert(both.end(), b.begin() + rng.below(static_cast<std::uint32_t>(b.size()) + 1), b.end());
  return both;
}

// Sets a header's length to the packet's.
inline void mend_length(Bytes& packet) {
  if (packet.size() < 4 || packet.size() > 0xffff) return;
  packet[2] = static_cast<std::uint8_t>(packet.size() >> 8u);
  packet[3] = static_cast<std::uint8_t>(packet.size());
}

}  // namespace fb::net::testing
