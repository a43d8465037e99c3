#include "gpu/precompiler.h"

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <system_error>
#include <utility>

#include "gpu/binding_table.h"
#include "gpu/commands.h"

#ifdef __unix__
#include <unistd.h>
#endif

namespace fb::gpu {
namespace {

using Clock = std::chrono::steady_clock;

// LLVM takes 2 to 30 times as long for a shader as it takes to read its SPIR-V; code from the cache a fifth of that.
constexpr double kFromCache = 0.7;

#ifdef __unix__
std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// Mesa's folder, or the nearest one above it that exists, can be written.
bool cache_is_on() {
  for (const char* name : {"MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE"})
    if (const auto value = variable(name); value == "1" || value == "true" || value == "yes") return false;
  std::filesystem::path folder;
  for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME", "HOME"})
    if (folder.empty()) folder = variable(name);
  std::error_code failure;
  while (folder.has_relative_path() && !std::filesystem::exists(folder, failure)) folder = folder.parent_path();
  return !folder.empty() && access(folder.c_str(), W_OK) == 0;
}
#else
bool cache_is_on() { return false; }
#endif

}  // namespace

// Its instance is its own, too: when that goes, its part of the driver has written what it put into the cache.
struct Precompiler::Sibling {
  Sibling(std::unique_ptr<Device> made, const ShaderSource& shader)
      : device(std::move(made)), table(*device), first(*device, table, shader.spirv, shader.name, shader.constants) {}
  std::unique_ptr<Device> device;
  BindingTable table;
  ComputePipeline first;
};

Precompiler::Precompiler(const Device& device, ShaderSource first)
    : options_(device.options()), first_(std::move(first)) {
  options_.preferred = device.report().name;
  options_.validation = options_.synchronization_validation = options_.present = false;
  options_.instance_extensions.clear();
  options_.shares_pipelines = false;  // each is made once
}

Precompiler::~Precompiler() = default;

bool Precompiler::helps(const Device& device) { return device.is_software() && cache_is_on(); }

std::unique_ptr<Precompiler::Sibling> Precompiler::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto sibling = std::move(idle_.back());
      idle_.pop_back();
      return sibling;
    }
  }
  auto device = Device::create(options_);
  return device ? std::make_unique<Sibling>(std::move(*device), first_) : nullptr;
}

void Precompiler::compile(const ShaderSource& shader) noexcept { compile_if_new(shader); }

bool Precompiler::compile_if_new(const ShaderSource& shader) noexcept {
  if (failed_) return true;
  try {
    auto sibling = take();
    failed_ = !sibling;
    if (failed_) return true;
    const auto start = Clock::now();
    Clock::time_point read;
    {
      const ComputePipeline pipeline(*sibling->device, sibling->table, shader.spirv, shader.name, shader.constants);
      read = Clock::now();
      sibling->device->run([&](Commands& commands) {
        commands.bind(sibling->table);
        commands.dispatch(sibling->first, 0, 0, 0);
        commands.dispatch(pipeline, 0, 0, 0);
      });
    }
    const auto made = Clock::now();
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(sibling));
    return made - read > kFromCache * (read - start);
  } catch (const std::exception&) {
    failed_ = true;
    return true;
  }
}

}  // namespace fb::gpu
