#include "net/keepalive.h"

#include <chrono>
#include <system_error>

#include "base/log.h"

namespace fb::net {

Keepalive::Keepalive(Connection& connection, double every) : connection_(connection) {
  try {
    thread_ = std::thread([this, every] { run(every); });
  } catch (const std::system_error& failure) {
    log_warning("the server may lose patience with long waits: no thread can be started ({})", failure.what());
  }
}

Keepalive::~Keepalive() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Keepalive::run(double every) {
  const int most = static_cast<int>(kLongest / kEvery);
  SilenceWatch watch;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, std::chrono::duration<double>(every), [this] { return ends_; }))
    if (watch.look(connection_.packets_sent(), most)) connection_.say_nothing();
}

}  // namespace fb::net
