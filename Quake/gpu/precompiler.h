// Machine code before it is wanted, for drivers that make it at a shader's first dispatch, in the one thread of the
// device's queue (lavapipe), and keep it in a cache on the disk. Devices of our own, one a thread, dispatch no
// workgroup of the shader; the device that draws then finds the code in the cache.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "gpu/pipeline.h"

namespace fb::gpu {

// Shaders as ComputePipeline takes them.
struct ShaderSource {
  std::span<const std::uint32_t> spirv;
  std::string name;
  std::vector<SpecializationConstant> constants;
};

class Precompiler {
 public:
  // For pipelines of `device`, which are dispatched behind `first`, one of another shader: for the first dispatch after
  // uniforms are bound Mesa's lavapipe before 24 may compile code of its own, with their values in it.
  Precompiler(const Device& device, ShaderSource first);
  // What was made is in the cache when it goes.
  ~Precompiler();
  Precompiler(const Precompiler&) = delete;
  Precompiler& operator=(const Precompiler&) = delete;

  // Whether the driver is of the kind above, and its cache is not off (by Mesa's variables, or for want of a folder).
  static bool helps(const Device& device);

  // Makes the code of one shader and waits for it; several threads may at once. After it failed for want of memory or
  // of a device it does nothing. Nothing can be seen of it but time.
  void compile(const ShaderSource& shader) noexcept;
  // The same; false: the code was in the cache, as far as the time that it took tells.
  bool compile_if_new(const ShaderSource& shader) noexcept;

 private:
  struct Sibling;
  std::unique_ptr<Sibling> take();

  DeviceOptions options_;
  ShaderSource first_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Sibling>> idle_;
  std::atomic<bool> failed_{false};
};

}  // namespace fb::gpu
