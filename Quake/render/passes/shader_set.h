// Pipelines, made when first asked for and kept: few variants, since each costs start-up time. Those of a frame are
// made at once, on all processors; what a frame can do without is made beside the frames.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "gpu/pipeline.h"
#include "gpu/precompiler.h"
#include "render/passes/shader_code.h"
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
  bool small = false;                                              // it stands in while another is compiled
  bool show_view = false;                                          // the technique draws its debug view
  std::array<std::uint32_t, shared::kTechniqueSpecs> technique{};  // the technique's own
  auto operator<=>(const Variant&) const = default;
};

// Nobody wants the picture any more for which shaders are being compiled.
struct ShadersAbandoned : std::exception {
  const char* what() const noexcept override { return "the compilation of shaders was abandoned"; }
};

class ShaderSet {
 public:
  ShaderSet(gpu::Device& device, const gpu::BindingTable& table, bool by_address, bool gpu_lanes);
  ~ShaderSet();
  // `name`: of a shader in Shaders/CMakeLists.txt. Passes that trace nothing have one variant. It stays where it is,
  // and is to be used after make().
  const gpu::ComputePipeline& get(std::string_view name, const Variant& variant = {});
  // The same, but where pictures are wanted soon (set_hurries) and `variant` has not been compiled, it is compiled on
  // a thread, and until that is done `meanwhile`, a smaller shader of the same result, is returned.
  const gpu::ComputePipeline& get(std::string_view name, const Variant& variant, const Variant& meanwhile);
  // Makes what was asked for since. May throw OutOfMemory: then what is left is to be asked for again; or
  // ShadersAbandoned (set_waiting).
  void make();

  // What a driver would compile at the first dispatch is compiled in make(), on all processors (gpu/precompiler.h).
  void set_precompiles(bool precompiles);
  // Whether a picture may be drawn by `meanwhile` (above): it comes sooner, but which shader draws it depends on time,
  // so pictures do not repeat to the bit. Without effect on a driver whose frames would wait for the compilation
  // anyway.
  void set_hurries(bool hurries);
  // Nothing is being made beside the frames, nor was left behind by make().
  bool settled() const { return late_.empty() && !under_way_; }
  // Called some twenty times a second while make() waits. Once it says false, make() throws ShadersAbandoned and this
  // set serves nothing any more but its destructor, which waits for what no driver can cut short.
  void set_waiting(std::function<bool()> waiting) { waiting_ = std::move(waiting); }

 private:
  using Key = std::tuple<std::string, Variant>;
  // Of what is made beside the frames.
  struct Late {
    Key key;
    gpu::ComputePipeline pipeline;  // none: there was no memory for it
    std::atomic<bool> done{false};
    std::jthread thread;
  };
  using Made = std::map<Key, gpu::ComputePipeline>::iterator;
  struct Batch;
  std::unique_ptr<Batch> plan(std::vector<Made> asked) const;
  void compile_asked();
  gpu::ShaderSource source(const Key& key) const;
  gpu::ShaderSource first_dispatch() const;
  gpu::ComputePipeline compile(const Key& key) const;
  void make_late(Late& late) const;

  gpu::Device& device_;
  const gpu::BindingTable& table_;
  bool by_address_, gpu_lanes_, precompiles_ = false, hurries_ = false;
  int quiet_ = 0;  // make()s in a row that had nothing to make
  std::map<Key, gpu::ComputePipeline> pipelines_;
  std::vector<Made> asked_;
  std::list<Late> late_;
  std::function<bool()> waiting_;
  std::unique_ptr<Batch> under_way_;  // what make() makes, or has left
};

}  // namespace fb::render
