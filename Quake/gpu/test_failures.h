// For tests: Vulkan calls that run out of memory, and devices that are lost, when the test wants them to.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "gpu/vulkan_error.h"

namespace fb::gpu {

// While it lives, one call (counted from 0) finds no memory: of all, or of those to `function`. Where that is
// vkAllocateMemory, so do the calls right behind it, which try another kind of memory. One at a time.
class FailingCall {
 public:
  explicit FailingCall(std::size_t nth, std::string function = "vk") {
    state() = State{.nth = nth, .function = std::move(function), .failed = {}};
    fails_call = [](const char* call) { return state().fails(call); };
  }
  ~FailingCall() { fails_call = nullptr; }
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  // The function that failed; empty if there were not so many calls.
  const std::string& failed() const { return state().failed; }

 private:
  struct State {
    std::size_t nth = 0;
    std::string function;
    std::size_t calls = 0;
    std::string failed;
    bool just_failed = false;

    // Pipelines are made on several threads.
    bool fails(std::string_view call) {
      static std::mutex one;
      const std::lock_guard lock(one);
      const std::string name(call.substr(0, call.find('(')));
      const bool next_kind = just_failed && name == "vkAllocateMemory" && failed == name;
      just_failed = next_kind || (name.starts_with(function) && calls++ == nth);
      if (just_failed) failed = name;
      return just_failed;
    }
  };
  static State& state() {
    static State state;
    return state;
  }
};

// While it lives, the device is lost at one submission (counted from 0): what can tell of it does, until a new device
// is made. That one is lost at its first submission, until so many were. One at a time, and no FailingCall beside it.
class LostDevice {
 public:
  explicit LostDevice(std::size_t submission, int devices = 1) {
    state() = State{.submission = submission, .devices = devices};
    failing_result = VK_ERROR_DEVICE_LOST;
    fails_call = [](const char* call) { return state().fails(call); };
  }
  ~LostDevice() {
    fails_call = nullptr;
    failing_result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  LostDevice(const LostDevice&) = delete;
  LostDevice& operator=(const LostDevice&) = delete;

  int lost() const { return state().losses; }
  bool replaced() const { return state().losses > 0 && !state().is_lost; }

 private:
  struct State {
    std::size_t submission = 0, submissions = 0;
    int devices = 1, losses = 0;
    bool is_lost = false;

    bool fails(std::string_view call) {
      const std::string_view name = call.substr(0, call.find('('));
      if (name == "vkCreateDevice") is_lost = false;
      if (name == "vkQueueSubmit" && !is_lost && submissions++ >= submission && losses < devices) {
        is_lost = true;
        ++losses;
      }
      return is_lost && (name == "vkQueueSubmit" || name == "vkWaitForFences" || name == "vkGetQueryPoolResults" ||
                         name == "vkAcquireNextImageKHR" || name == "vkQueuePresentKHR");
    }
  };
  static State& state() {
    static State state;
    return state;
  }
};

}  // namespace fb::gpu
