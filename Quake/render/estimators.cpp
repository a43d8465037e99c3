// The estimators there are. Their policies are Shaders/estimators/<name>/<name>.glsl.
#include "render/renderer.h"

namespace fb::render {

const std::vector<EstimatorInfo>& estimators() {
  static const std::vector<EstimatorInfo> list{
      {"pt", "BSDF sampling only; unbiased for paths of at most r_bounces reflections", true, false},
      {"mcpg", "Markov chain path guiding (Alber 2025); unbiased for paths of at most r_bounces reflections", true,
       true},
  };
  return list;
}

}  // namespace fb::render
