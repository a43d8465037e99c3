// Techniques that keep nothing from frame to frame: one pass that traces paths, and perhaps some constants.
#include <cstring>
#include <string>

#include "render/technique.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

class PathTechnique : public Technique {
 public:
  explicit PathTechnique(std::string_view name) : name_(name) {}
  void prepare(const TechniqueFrame&) override {}
  void add_passes(const TechniquePasses& passes) override { add_paths_pass(passes, name_); }

 private:
  std::string name_;
};

class NeeTechnique : public PathTechnique {
 public:
  NeeTechnique(const TechniqueTools& tools, std::string_view name)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::NeeConstants), "constants of nee") {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    shared::NeeConstants constants{};
    copy_settings(frame.settings, constants);
    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
  }

 private:
  gpu::Buffer uniform_;
};

}  // namespace

void add_paths_pass(const TechniquePasses& passes, std::string_view name,
                    const std::array<std::uint32_t, shared::kTechniqueSpecs>& constants) {
  Variant variant = passes.variant;
  variant.technique = constants;
  passes.list.dispatch("paths", PassKind::kEstimator, passes.shaders.get(name, variant), groups_over(passes.size, 8));
}

std::unique_ptr<Technique> make_path_technique(const TechniqueTools&, std::string_view name) {
  return std::make_unique<PathTechnique>(name);
}
std::unique_ptr<Technique> make_nee_technique(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<NeeTechnique>(tools, name);
}

}  // namespace fb::render
