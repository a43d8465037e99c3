// The compiled shaders, and pipelines made from them when first asked for: few variants, since each costs start-up
// time.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "gpu/pipeline.h"
#include "render/gpu_scene.h"

namespace fb::render {

// What a tracing pipeline is specialised for (constants 0 to 6 of Shaders/lib; how trees are read is the device's).
struct Variant {
  bool ray_query = false;
  bool candidates = false;  // alpha tests or translucency
  bool specular = false;
  // Of estimators that learn (constants 2 to 4).
  bool resolve = false;
  std::uint32_t accesses = 1, bucket = 1;
  bool show_view = false;  // a debug view of the technique's own: r_debug 20 to 29
  auto operator<=>(const Variant&) const = default;
};

// Tells one version of an estimator's code from another: a hash of its shader and the G-buffer's.
std::uint64_t shader_hash(std::string_view estimator);

class ShaderSet {
 public:
  ShaderSet(gpu::Device& device, const gpu::BindingTable& table) : device_(device), table_(table) {}
  const gpu::ComputePipeline& gbuffer(const Variant& variant);
  // `estimator` is a name of estimators().
  const gpu::ComputePipeline& paths(std::string_view estimator, const Variant& variant);
  // Passes that trace nothing, by their shader's name ("accumulate", "tonemap").
  const gpu::ComputePipeline& pass(std::string_view name);

 private:
  const gpu::ComputePipeline& get(std::string_view name, const Variant& variant);
  gpu::Device& device_;
  const gpu::BindingTable& table_;
  std::map<std::tuple<std::string, Variant>, gpu::ComputePipeline, std::less<>> pipelines_;
};

}  // namespace fb::render
