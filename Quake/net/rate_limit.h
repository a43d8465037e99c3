// Limits a server's replies to strangers: a burst and a rate per second, for each address and for all together.
// Addresses share buckets by a seeded hash, so that a flood of forged ones takes no more memory.
#pragma once

#include <array>
#include <cstdint>

#include "net/network.h"

namespace fb::net {

class RateLimit {
 public:
  explicit RateLimit(std::uint64_t seed) : seed_(seed) {}
  // Takes one reply from the budget of `source`; false if it is empty. Ignores ports, and the half of an IPv6 address
  // that a host chooses for itself.
  bool allow(const Address& source, double now);

 private:
  struct Bucket {
    double tokens, time;
    bool take(double now, double burst, double per_second);
  };
  static constexpr double kBurst = 40.0, kPerSecond = 20.0;  // a status query: 16 players at once, 20 rules a second
  static constexpr double kBurstOfAll = 400.0, kPerSecondOfAll = 200.0;
  std::uint64_t seed_;
  Bucket all_{kBurstOfAll, 0.0};
  std::array<Bucket, 1024> sources_ = [] {
    std::array<Bucket, 1024> full;
    full.fill({kBurst, 0.0});
    return full;
  }();
};

}  // namespace fb::net
