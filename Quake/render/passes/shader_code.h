// The compiled shaders by name, in the variant that suits a device, and pipelines made from them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "gpu/pipeline.h"

namespace fb::render {

// SPIR-V of a shader that Shaders/CMakeLists.txt lists, in its variants.
struct CompiledShader {
  std::string_view name;
  std::span<const std::uint32_t> bound;    // arrays through descriptors
  std::span<const std::uint32_t> address;  // arrays by device address
  std::span<const std::uint32_t> query;    // by device address, rays through ray query; empty: traces nothing
};
std::span<const CompiledShader> compiled_shaders();

// Whether shaders reach arrays by device address, not through descriptors (Shaders/lib/arrays.glsl). Both give the same
// picture; which is faster depends on the driver. `asked`: what is asked for; a device without addresses has none all
// the same.
bool arrays_by_address(const gpu::Device& device, std::optional<bool> asked = {});

// Whether shaders are specialised for a GPU's lanes, not a processor's (shared/bindings.h, kSpecGpuLanes). Both give
// the same picture.
bool lanes_of_gpu(const gpu::Device& device, std::optional<bool> asked = {});

// The variant for a device. `ray_query`: rays are traced by VK_KHR_ray_query, if it traces.
std::span<const std::uint32_t> shader_code(std::string_view name, bool ray_query, bool by_address);

gpu::ComputePipeline make_pipeline(gpu::Device& device, const gpu::BindingTable& table, std::string_view name,
                                   bool ray_query, bool by_address,
                                   std::span<const gpu::SpecializationConstant> constants = {});

}  // namespace fb::render
