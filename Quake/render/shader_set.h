// Pipelines, made when first asked for and kept: few variants, since each costs start-up time.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "gpu/pipeline.h"
#include "render/shader_code.h"
#include "shared/kinds.h"

namespace fb::render {

// What a tracing pipeline is specialised for (shared/bindings.h, kSpec*).
struct Variant {
  bool ray_query = false;
  bool candidates = false;  // alpha tests or translucency
  bool specular = false;
  std::uint32_t surfaces = shared::kFeaturesAll;
  bool medium = false;                                             // there is one between surfaces
  bool in_medium = false;                                          // paths begin in it
  bool water = false;                                              // some surface is an interface of water or glass
  bool show_view = false;                                          // the technique draws its debug view
  std::array<std::uint32_t, shared::kTechniqueSpecs> technique{};  // the technique's own
  auto operator<=>(const Variant&) const = default;
};

class ShaderSet {
 public:
  ShaderSet(gpu::Device& device, const gpu::BindingTable& table, const MemoryAccess& access)
      : device_(device), table_(table), access_(access) {}
  // `name`: of a shader in Shaders/CMakeLists.txt. Passes that trace nothing have one variant. It stays where it is.
  const gpu::ComputePipeline& get(std::string_view name, const Variant& variant = {});

 private:
  gpu::Device& device_;
  const gpu::BindingTable& table_;
  MemoryAccess access_;
  std::map<std::tuple<std::string, Variant>, gpu::ComputePipeline, std::less<>> pipelines_;
};

}  // namespace fb::render
