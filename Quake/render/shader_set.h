// Pipelines, made when first asked for and kept: few variants, since each costs start-up time.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "gpu/pipeline.h"
#include "render/shader_code.h"

namespace fb::render {

// What a tracing pipeline is specialised for (shared/bindings.h, kSpec*).
struct Variant {
  bool ray_query = false;
  bool candidates = false;  // alpha tests or translucency
  bool specular = false;
  // Of techniques that learn.
  bool resolve = false;
  std::uint32_t accesses = 1, bucket = 1;
  bool show_view = false;  // a debug view of the technique's own: r_debug 20 to 29
  auto operator<=>(const Variant&) const = default;
};

class ShaderSet {
 public:
  ShaderSet(gpu::Device& device, const gpu::BindingTable& table, const MemoryAccess& access)
      : device_(device), table_(table), access_(access) {}
  const gpu::ComputePipeline& gbuffer(const Variant& variant);
  // `estimator` is a name of estimators().
  const gpu::ComputePipeline& paths(std::string_view estimator, const Variant& variant);
  // Passes that trace nothing, by their shader's name ("accumulate", "tonemap").
  const gpu::ComputePipeline& pass(std::string_view name);

 private:
  const gpu::ComputePipeline& get(std::string_view name, const Variant& variant);
  gpu::Device& device_;
  const gpu::BindingTable& table_;
  MemoryAccess access_;
  std::map<std::tuple<std::string, Variant>, gpu::ComputePipeline, std::less<>> pipelines_;
};

}  // namespace fb::render
