// Technique `pt`: its shader alone. Of others that keep nothing, too (PathTechnique).
#include <memory>

#include "render/techniques/path_technique.h"

namespace fb::render {

std::unique_ptr<Technique> make_path_technique(const TechniqueTools&, std::string_view name) {
  return std::make_unique<PathTechnique>(name);
}

extern constinit const TechniqueInfo kPt{
    .name = "pt",
    .description = "BSDF sampling only; unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_path_technique};

}  // namespace fb::render
