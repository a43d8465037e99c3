#include "net/rate_limit.h"

#include <algorithm>

#include "base/hash.h"

namespace fb::net {

bool RateLimit::Bucket::take(double now, double burst, double per_second) {
  tokens = std::min(burst, tokens + std::max(0.0, now - time) * per_second);
  time = std::max(time, now);
  if (tokens < 1.0) return false;
  tokens -= 1.0;
  return true;
}

bool RateLimit::allow(const Address& source, double now) {
  const std::size_t size = source.family == Family::kIpv4 ? 4 : 8;
  const std::uint64_t hash = hash_bytes(source.bytes.data(), size, seed_);
  // An address over its limit does not use up the common limit.
  return sources_[hash % sources_.size()].take(now, kBurst, kPerSecond) && all_.take(now, kBurstOfAll, kPerSecondOfAll);
}

}  // namespace fb::net
