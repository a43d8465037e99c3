// The techniques there are: a row registers one. Its shader, Shaders/estimators/NAME/NAME.comp, chooses the steps of
// the path loop (Shaders/lib/path.glsl).
#include <algorithm>

#include "render/techniques/technique.h"

namespace fb::render {

const std::vector<TechniqueInfo>& techniques() {
  static const std::vector<TechniqueInfo> list{
      {.name = "pt",
       .description = "BSDF sampling only; unbiased for paths of at most r_bounces reflections",
       .bias = Bias::kUnbiased,
       .make = make_path_technique},
      {.name = "nee",
       .description =
           "next-event estimation: of the lights of a list and the suns one, by what it would bring and by what rays "
           "reached before; and the BSDF; unbiased for paths of at most r_bounces reflections",
       .bias = Bias::kUnbiased,
       .make = make_nee_technique,
       .learns = true,
       .wants_lights = true},
      {.name = "mcpg",
       .description = "Markov chain path guiding (Alber 2025); unbiased for paths of at most r_bounces reflections",
       .bias = Bias::kUnbiased,
       .make = make_guided_technique,
       .learns = true,
       .views = shared::kViewOfGuide},
      {.name = "mcpg_nee",
       .description = "mcpg that looks for lights as nee does, and learns what this leaves; unbiased like both",
       .bias = Bias::kUnbiased,
       .make = make_guided_technique,
       .learns = true,
       .wants_lights = true,
       .views = shared::kViewOfGuide},
      {.name = "mcpg_tail",
       .description =
           "mcpg with one reflection traced (r_bounces says no more than whether there is any) and the "
           "irradiance cache beyond it: a Lambertian tail of any number of reflections, averaged over cells, "
           "some frames late",
       .bias = Bias::kBiased,
       .make = make_guided_tail_technique,
       .learns = true,
       .views = shared::kViewOfGuide},
  };
  return list;
}

const TechniqueInfo* find_technique(std::string_view name) {
  const auto& list = techniques();
  const auto found = std::find_if(list.begin(), list.end(), [&](const TechniqueInfo& t) { return t.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace fb::render
