#include "render/passes/pass.h"

#include <utility>

#include "base/check.h"

namespace fb::render {

void PassList::add(std::string name, PassKind kind, std::function<void(gpu::Commands&)> record) {
  passes_.push_back({std::move(name), kind, std::move(record)});
}

void PassList::dispatch(std::string name, PassKind kind, const gpu::ComputePipeline& pipeline, uvec2 groups) {
  add(std::move(name), kind, [&pipeline, groups](gpu::Commands& commands) {
    commands.dispatch(pipeline, groups.x, groups.y);
    commands.barrier();
  });
}

void PassList::dispatch(std::string name, PassKind kind, const gpu::ComputePipeline& pipeline,
                        const AskedGroups& groups) {
  add(std::move(name), kind, [&pipeline, groups](gpu::Commands& commands) {
    groups.dispatch(commands, pipeline);
    commands.barrier();
  });
}

void PassList::record(gpu::Commands& commands) const {
  for (const Pass& pass : passes_) {
    gpu::Commands::Scope scope(commands, pass.name);
    pass.record(commands);
  }
}

std::vector<PassTime> PassList::times(const std::vector<gpu::PassTime>& measured) const {
  FB_CHECK_EQ(measured.size(), passes_.size());
  std::vector<PassTime> times;
  for (std::size_t i = 0; i < passes_.size(); ++i)
    times.push_back({passes_[i].name, measured[i].milliseconds, passes_[i].kind});
  return times;
}

}  // namespace fb::render
