// Pipelines, made when first asked for and kept: few variants, since each costs start-up time. Those of a frame are
// made at once, on all processors.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

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
  bool water = false;                                              // some surface is an interface of water or glass
  bool one_bounce = false;                                         // paths have one reflection at most
  bool show_view = false;                                          // the technique draws its debug view
  std::array<std::uint32_t, shared::kTechniqueSpecs> technique{};  // the technique's own
  auto operator<=>(const Variant&) const = default;
};

class ShaderSet {
 public:
  ShaderSet(gpu::Device& device, const gpu::BindingTable& table, bool by_address)
      : device_(device), table_(table), by_address_(by_address) {}
  // `name`: of a shader in Shaders/CMakeLists.txt. Passes that trace nothing have one variant. It stays where it is,
  // and is to be used after make().
  const gpu::ComputePipeline& get(std::string_view name, const Variant& variant = {});
  // Makes what was asked for since. May throw OutOfMemory: then what is left is to be asked for again.
  void make();
  // Called some twenty times a second while make() waits.
  void set_waiting(std::function<void()> waiting) { waiting_ = std::move(waiting); }

 private:
  using Key = std::tuple<std::string, Variant>;
  gpu::ComputePipeline compile(const Key& key) const;

  gpu::Device& device_;
  const gpu::BindingTable& table_;
  bool by_address_;
  std::map<Key, gpu::ComputePipeline> pipelines_;
  std::vector<std::map<Key, gpu::ComputePipeline>::iterator> asked_;
  std::function<void()> waiting_;
};

}  // namespace fb::render
