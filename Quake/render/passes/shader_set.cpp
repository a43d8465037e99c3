#include "render/passes/shader_set.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "base/background_work.h"

namespace fb::render {
namespace {

// The shader whose code, if it comes from the driver's cache, says that the others' would: as specialised as the
// largest ones, and soon read.
constexpr std::size_t kProbeWords = 20'000;
// Frames that need nothing new before what can wait is begun: the first of them are drawn while those before are shown.
constexpr int kQuiet = 2;
constexpr std::chrono::milliseconds kWait(50);  // between two calls of what set_waiting() has set

}  // namespace

ShaderSet::ShaderSet(gpu::Device& device, const gpu::BindingTable& table, bool by_address, bool gpu_lanes)
    : device_(device), table_(table), by_address_(by_address), gpu_lanes_(gpu_lanes) {}

// What make() makes, kept by the set: threads may outlast the call.
struct ShaderSet::Batch {
  struct Step {
    std::size_t shader;
    bool code;  // of the driver's cache; or the pipeline
  };
  void take(const ShaderSet& set, std::size_t i) {
    const auto [shader, code] = steps[i];
    if (!code)
      asked[shader]->second = set.compile(asked[shader]->first);
    else if (!cached && !precompiler->compile_if_new(sources[shader]) && i == 0)
      cached = true;
  }

  std::vector<Made> asked;
  std::vector<gpu::ShaderSource> sources;
  std::vector<Step> steps;
  std::optional<gpu::Precompiler> precompiler;
  std::atomic<bool> cached{false};
  std::optional<BackgroundWork> work;  // last: its threads use the others
};

ShaderSet::~ShaderSet() = default;

void ShaderSet::set_precompiles(bool precompiles) { precompiles_ = precompiles && gpu::Precompiler::helps(device_); }

void ShaderSet::set_hurries(bool hurries) { hurries_ = hurries && (precompiles_ || !device_.is_software()); }

const gpu::ComputePipeline& ShaderSet::get(std::string_view name, const Variant& variant) {
  const auto [found, fresh] = pipelines_.try_emplace(Key(name, variant));
  if (fresh) asked_.push_back(found);
  return found->second;
}

const gpu::ComputePipeline& ShaderSet::get(std::string_view name, const Variant& variant, const Variant& meanwhile) {
  const Key key(name, variant);
  const auto late = std::find_if(late_.begin(), late_.end(), [&](const Late& l) { return l.key == key; });
  if (late != late_.end()) {
    if (hurries_ && !late->done) return get(name, meanwhile);
    if (late->thread.joinable()) late->thread.join();
    if (late->pipeline) pipelines_[key] = std::move(late->pipeline);
    late_.erase(late);
  } else if (hurries_ && !pipelines_.contains(key)) {
    late_.emplace_back().key = key;  // make() begins it
    return get(name, meanwhile);
  }
  return get(name, variant);
}

std::unique_ptr<ShaderSet::Batch> ShaderSet::plan(std::vector<Made> asked) const {
  auto batch = std::make_unique<Batch>();
  for (const Made& pipeline : asked) batch->sources.push_back(source(pipeline->first));
  // Long ones first, so that the processors end together.
  std::vector<std::size_t> order(asked.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto words = [&](std::size_t i) { return batch->sources[i].spirv.size(); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return words(a) > words(b); });

  std::vector<Batch::Step>& steps = batch->steps;
  if (precompiles_) {
    batch->precompiler.emplace(device_, first_dispatch());
    const auto small =
        std::find_if(order.rbegin(), order.rend(), [&](std::size_t i) { return words(i) >= kProbeWords; });
    const std::size_t probe = small != order.rend() ? *small : order.back();
    steps.push_back({probe, true});
    steps.push_back({order.front(), false});  // what must be done in any case, beside the probe
    for (const std::size_t i : order)
      if (i != probe) steps.push_back({i, true});
  }
  for (const std::size_t i : order)
    if (!precompiles_ || i != order.front()) steps.push_back({i, false});
  batch->asked = std::move(asked);
  return batch;
}

void ShaderSet::compile_asked() {
  std::vector<Made> asked = std::exchange(asked_, {});
  under_way_ = plan(asked);
  under_way_->work.emplace(under_way_->steps.size(),
                           [this, &batch = *under_way_](std::size_t i) { batch.take(*this, i); });
  try {
    while (!under_way_->work->wait_for(kWait))
      if (waiting_ && !waiting_()) {
        under_way_->work->give_up();
        throw ShadersAbandoned();
      }
  } catch (const ShadersAbandoned&) {
    throw;
  } catch (...) {
    under_way_.reset();
    for (const Made& pipeline : asked)
      if (!pipeline->second) pipelines_.erase(pipeline);
    throw;
  }
  under_way_.reset();
}

void ShaderSet::make() {
  quiet_ = asked_.empty() ? quiet_ + 1 : 0;
  if (!asked_.empty()) compile_asked();
  if (quiet_ < kQuiet) return;  // the frame just asked for would wait for its processors
  for (Late& late : late_)
    if (!late.thread.joinable() && !late.done) late.thread = std::jthread([this, &late] { make_late(late); });
}

void ShaderSet::make_late(Late& late) const {
  try {
    if (precompiles_) gpu::Precompiler(device_, first_dispatch()).compile(source(late.key));
    late.pipeline = compile(late.key);
  } catch (const std::exception&) {  // it is made, or fails, where it is asked for
  }
  late.done = true;
}

// A frame begins with it (GpuScene::record).
gpu::ShaderSource ShaderSet::first_dispatch() const { return {shader_code("pose", false, by_address_), "pose", {}}; }

gpu::ShaderSource ShaderSet::source(const Key& key) const {
  const auto& [name, variant] = key;
  gpu::ShaderSource shader{shader_code(name, variant.ray_query, by_address_), name, {}};
  shader.constants = {{shared::kSpecCandidates, variant.candidates},
                      {shared::kSpecSpecular, variant.specular},
                      {shared::kSpecShowView, variant.show_view},
                      {shared::kSpecMedium, variant.medium},
                      {shared::kSpecFeatures, variant.surfaces},
                      {shared::kSpecWater, variant.water},
                      {shared::kSpecOneBounce, variant.one_bounce},
                      {shared::kSpecSmall, variant.small},
                      {shared::kSpecGpuLanes, gpu_lanes_}};
  for (std::uint32_t i = 0; i < variant.technique.size(); ++i)
    shader.constants.push_back({shared::kSpecTechnique + i, variant.technique[i]});
  return shader;
}

gpu::ComputePipeline ShaderSet::compile(const Key& key) const {
  const gpu::ShaderSource shader = source(key);
  return {device_, table_, shader.spirv, shader.name, shader.constants};
}

}  // namespace fb::render
