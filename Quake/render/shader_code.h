// The compiled shaders by name, in the variant that suits a device, and pipelines made from them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "gpu/pipeline.h"

namespace fb::render {

// How shaders read memory. Every choice gives the same picture; the fastest depends on the driver.
struct MemoryAccess {
  bool by_address = false;  // arrays by device address, not through descriptors (Shaders/lib/arrays.glsl)
  bool texels = false;      // arrays that have a texel buffer are read through it
};
// `by_address`: what is asked for; a device without addresses has none all the same.
MemoryAccess memory_access(const gpu::Device& device, std::optional<bool> by_address = {});

// SPIR-V of a shader that Shaders/CMakeLists.txt lists. `ray_query`: rays are traced by VK_KHR_ray_query, if it traces.
std::span<const std::uint32_t> shader_code(std::string_view name, bool ray_query, bool by_address);

// `constants` beside those that `access` stands for.
gpu::ComputePipeline make_pipeline(gpu::Device& device, const gpu::BindingTable& table, std::string_view name,
                                   bool ray_query, const MemoryAccess& access,
                                   std::span<const gpu::SpecializationConstant> constants = {});

// Tells one version of an estimator's code from another: a hash of its shader and the G-buffer's.
std::uint64_t shader_hash(std::string_view estimator);

}  // namespace fb::render
