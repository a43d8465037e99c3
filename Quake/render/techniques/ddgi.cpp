// Dynamic diffuse global illumination (Majercik 2019, 2021 and 2022): probes in the world that keep light and
// distances, at a path's first vertex (ddgi) or second (ddgi_plus). Layouts: Shaders/estimators/ddgi/.
#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include "estimators/ddgi/ddgi.h"
#include "render/techniques/path_technique.h"
#include "render/techniques/probes.h"
#include "render/techniques/seen_grid.h"

namespace fb::render {
namespace {

class DdgiTechnique : public PathTechnique {
 public:
  DdgiTechnique(const TechniqueTools& tools, std::string_view name, bool plus)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::DdgiConstants), "constants of ddgi"),
        seen_(tools),
        probes_(tools, plus) {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    const shared::DdgiConstants constants = probes_.prepare(frame, seen_);
    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
  }
  void add_passes(const TechniquePasses& passes) override {
    seen_.add_reset(passes.list);
    probes_.add_passes(passes);
    PathTechnique::add_passes(passes);
    seen_.add_fold(passes.list, passes.shaders);
  }
  void forget() override {
    seen_.forget();
    probes_.forget();
  }
  std::uint32_t salt() const override { return probes_.frame(); }
  std::uint64_t bytes() const override { return seen_.bytes() + probes_.bytes(); }

 private:
  gpu::Buffer uniform_;
  SeenGrid seen_;
  Probes probes_;
};

template <bool kPlus>
std::unique_ptr<Technique> make_ddgi(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<DdgiTechnique>(tools, name, kPlus);
}

}  // namespace

extern constinit const TechniqueInfo kDdgi{
    .name = "ddgi",
    .description =
        "nee at the first vertex, whose reflected light is that of probes in a grid (DDGI: Majercik 2019); biased by "
        "their spacing, leaks and lag, and of any number of reflections",
    .bias = Bias::kBiased,
    .make = make_ddgi<false>,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .views = shared::kViewOfDdgi};
extern constinit const TechniqueInfo kDdgiPlus{
    .name = "ddgi_plus",
    .description =
        "nee whose second vertex's light is that of probes which know all light that falls on it (DDGI+: Majercik "
        "2022); biased like ddgi, but one reflection further away",
    .bias = Bias::kBiased,
    .make = make_ddgi<true>,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .views = shared::kViewOfDdgi};

}  // namespace fb::render
