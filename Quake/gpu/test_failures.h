// For tests: Vulkan calls that run out of memory when the test wants them to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/vulkan_error.h"

namespace fb::gpu {

// While it lives, one call (counted from 0) finds no memory. Where that is vkAllocateMemory, so do the calls right
// behind it that try another kind of memory. One at a time.
class FailingCall {
 public:
  explicit FailingCall(std::size_t nth) {
    state() = {nth, {}, {}};
    fails_call = [](const char* call) {
      State& s = state();
      s.calls.emplace_back(call);
      const std::size_t at = s.calls.size() - 1;
      const bool again = s.calls[at].starts_with("vkAllocateMemory") && at > 0 && s.calls[at - 1] == s.calls[at] &&
                         !s.failed.empty() && at == s.last + 1;
      if (at != s.nth && !again) return false;
      s.failed = s.calls[at];
      s.last = at;
      return true;
    };
  }
  ~FailingCall() { fails_call = nullptr; }
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  // The call that failed, as the source has it; empty if there were not so many.
  const std::string& failed() const { return state().failed; }
  const std::vector<std::string>& calls() const { return state().calls; }

 private:
  struct State {
    std::size_t nth = 0;
    std::vector<std::string> calls;
    std::string failed;
    std::size_t last = 0;
  };
  static State& state() {
    static State state;
    return state;
  }
};

}  // namespace fb::gpu
