// Recording: dispatches, copies, barriers, and timers around passes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace fb::gpu {

// GPU time of named passes, in milliseconds, in the order recorded; a pass counts what was recorded since the pass
// before it. Zero where the device has no timestamps.
struct PassTime {
  std::string name;
  double milliseconds = 0;
};

class PassTimer {
 public:
  PassTimer(Device& device, std::uint32_t max_passes = 64);
  ~PassTimer();
  PassTimer(const PassTimer&) = delete;
  PassTimer& operator=(const PassTimer&) = delete;
  void reset(VkCommandBuffer cmd);
  void begin(VkCommandBuffer cmd, std::string_view name);
  void end(VkCommandBuffer cmd);
  // After the submission has finished.
  std::vector<PassTime> read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class Commands {
 public:
  Commands(Device& device, VkCommandBuffer cmd) : device_(device), cmd_(cmd) {}
  VkCommandBuffer handle() const { return cmd_; }
  Device& device() { return device_; }

  void bind(const BindingTable& table);  // scene, frame and technique, once a recording
  // In the technique's place the arrays of one pass (kSetPose, kSetDraw), or kSetTechnique again.
  void bind_third(const BindingTable& table, std::uint32_t set);
  template <typename T>
  void push(const T& constants) {
    static_assert(sizeof(T) <= kPushConstantBytes);
    push_bytes(&constants, sizeof(T));
  }
  // Groups, not invocations.
  void dispatch(const ComputePipeline& pipeline, std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  // As many as a kStorage buffer holds when it runs, three words: VkDispatchIndirectCommand. At most x, y.
  void dispatch_indirect(const ComputePipeline& pipeline, const Buffer& groups, VkDeviceSize offset, std::uint32_t x,
                         std::uint32_t y);
  // Everything that shaders, copies and builds wrote before is visible to all that comes after.
  void barrier();
  void copy(const Buffer& from, const Buffer& to, VkDeviceSize bytes, VkDeviceSize from_offset = 0,
            VkDeviceSize to_offset = 0);
  void fill(const Buffer& buffer, std::uint32_t value, VkDeviceSize offset = 0, VkDeviceSize bytes = VK_WHOLE_SIZE);
  // A few words, at most 64 KiB, that are recorded with the command.
  void update(const Buffer& buffer, std::span<const std::uint32_t> words, VkDeviceSize offset);

  // Times what is recorded in its scope, if a timer is set.
  void set_timer(PassTimer* timer) { timer_ = timer; }
  class Scope {
   public:
    Scope(Commands& commands, std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Commands& commands_;
  };

 private:
  void push_bytes(const void* data, std::uint32_t bytes);
  void bind(const ComputePipeline& pipeline, std::uint32_t x, std::uint32_t y, std::uint32_t z);
  Device& device_;
  VkCommandBuffer cmd_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  PassTimer* timer_ = nullptr;
};

}  // namespace fb::gpu
