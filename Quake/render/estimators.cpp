// The estimators there are. Their shaders, Shaders/estimators/NAME/NAME.comp, choose the steps of the path loop.
#include "render/renderer.h"

namespace fb::render {

const std::vector<EstimatorInfo>& estimators() {
  static const std::vector<EstimatorInfo> list{
      {"pt", "BSDF sampling only; unbiased for paths of at most r_bounces reflections", true, false},
      {"nee",
       "next-event estimation: lights from a list, suns and the BSDF; unbiased for paths of at most r_bounces "
       "reflections",
       true, false, false, true},
      {"mcpg", "Markov chain path guiding (Alber 2025); unbiased for paths of at most r_bounces reflections", true,
       true},
      {"mcpg_nee", "mcpg that looks for lights as nee does, and learns what this leaves; unbiased like both", true,
       true, false, true},
      {"mcpg_tail",
       "mcpg with one reflection traced (r_bounces says no more than whether there is any) and the irradiance cache "
       "beyond "
       "it: a Lambertian tail of any number of reflections, averaged over cells, some frames late",
       false, true, true},
  };
  return list;
}

}  // namespace fb::render
