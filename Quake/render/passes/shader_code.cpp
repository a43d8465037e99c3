#include "render/passes/shader_code.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "base/check.h"
#include "compiled_shaders.inc"

namespace fb::render {
namespace {

const CompiledShader& find_shader(std::string_view name) {
  const std::span<const CompiledShader> all = compiled_shaders();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const CompiledShader& shader) { return shader.name == name; });
  if (found == all.end()) fatal(__FILE__, __LINE__, "no shader named " + std::string(name));
  return *found;
}

// Mesa's version where the device is lavapipe ("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"); high for anything else.
int lavapipe_version(const gpu::Device& device) {
  const std::string& driver = device.report().driver;
  const auto at = driver.find("Mesa ");
  return device.is_software() && at != std::string::npos ? std::atoi(driver.c_str() + at + 5) : 99;
}

}  // namespace

std::span<const CompiledShader> compiled_shaders() { return compiled_shader_table(); }

bool arrays_by_address(const gpu::Device& device, std::optional<bool> asked) {
  // Before Mesa 24, lavapipe loads lane by lane; since, a load by address is one gather instruction, and one through a
  // descriptor a bounds check and a branch a lane.
  return device.has_addresses() && asked.value_or(lavapipe_version(device) >= 24);
}

bool lanes_of_gpu(const gpu::Device& device, std::optional<bool> asked) {
  return asked.value_or(!device.is_software());
}

std::span<const std::uint32_t> shader_code(std::string_view name, bool ray_query, bool by_address) {
  const CompiledShader& shader = find_shader(name);
  if (ray_query && !shader.query.empty()) return shader.query;
  return by_address ? shader.address : shader.bound;
}

gpu::ComputePipeline make_pipeline(gpu::Device& device, const gpu::BindingTable& table, std::string_view name,
                                   bool ray_query, bool by_address,
                                   std::span<const gpu::SpecializationConstant> constants) {
  return {device, table, shader_code(name, ray_query, by_address), std::string(name), constants};
}

}  // namespace fb::render
