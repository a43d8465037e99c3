// Speaks for a client whose own thread is busy for long: a first frame whose shaders are compiled, a level that is
// loaded, a window that is dragged. A thread of its own looks every few seconds whether anything has been sent, and
// sends a packet that says nothing (clc_nop) where nothing has: the other side hears something every five seconds.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "net/connection.h"

namespace fb::net {

// What is to be done at each look. No clock: looks come at even intervals.
class SilenceWatch {
 public:
  // `sent`: packets that the connection has sent so far, those that this has asked for included. Whether to speak now:
  // nothing has been sent since the look before, nor for more than `most` looks in a row: such a client hangs.
  bool look(std::uint64_t sent, int most) {
    const bool silent = sent == seen_;
    in_vain_ = silent ? in_vain_ + 1 : 0;
    const bool speaks = silent && in_vain_ <= most;
    seen_ = sent + (speaks ? 1 : 0);
    return speaks;
  }

 private:
  std::uint64_t seen_ = 0;
  int in_vain_ = 0;
};

class Keepalive {
 public:
  static constexpr double kEvery = 2.0;        // seconds: two looks apart is the longest silence
  static constexpr double kLongest = 15 * 60;  // seconds for which it speaks alone

  // The connection must outlive this, and its network must say any_thread(). Without a thread, where the system has
  // none left, nothing is said.
  explicit Keepalive(Connection& connection, double every = kEvery);
  ~Keepalive();
  Keepalive(const Keepalive&) = delete;
  Keepalive& operator=(const Keepalive&) = delete;

 private:
  void run(double every);

  Connection& connection_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace fb::net
