// The compiled shaders by name, in the variant that suits a device, and pipelines made from them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "gpu/pipeline.h"

namespace fb::render {

// Whether shaders reach arrays by device address, not through descriptors (Shaders/lib/arrays.glsl). Both give the same
// picture; which is faster depends on the driver. `asked`: what is asked for; a device without addresses has none all
// the same.
bool arrays_by_address(const gpu::Device& device, std::optional<bool> asked = {});

// Whether shaders are specialised for a GPU's lanes, not a processor's (shared/bindings.h, kSpecGpuLanes). Both give
// the same picture.
bool lanes_of_gpu(const gpu::Device& device, std::optional<bool> asked = {});

// SPIR-V of a shader that Shaders/CMakeLists.txt lists. `ray_query`: rays are traced by VK_KHR_ray_query, if it traces.
std::span<const std::uint32_t> shader_code(std::string_view name, bool ray_query, bool by_address);

gpu::ComputePipeline make_pipeline(gpu::Device& device, const gpu::BindingTable& table, std::string_view name,
                                   bool ray_query, bool by_address,
                                   std::span<const gpu::SpecializationConstant> constants = {});

// Tells one version of an estimator's code from another: a hash of its shader and the G-buffer's.
std::uint64_t shader_hash(std::string_view estimator);

}  // namespace fb::render
