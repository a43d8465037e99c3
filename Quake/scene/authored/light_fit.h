// How strong each emitter of a map is, asked of its baked light: non-negative factors on what the map's rules give, by
// the least squares of logarithms (what eyes compare), each held to where it began as far as the data do not decide.
#pragma once

#include <vector>

#include "scene/authored/light_transport.h"

namespace fb::scene {

struct LightFit {
  std::vector<vec3> factors;                 // of each emitter, on its power
  std::vector<float> shares;                 // of the points' light that each brings, after
  vec3 common{1.0f};                         // what all were multiplied by first
  double stops_before = 0, stops_after = 0;  // rms distance of the points' light from the baked one
};
// Every point's styles are an equation each: lightmaps hold the light of one style's emitters.
LightFit fit_light(const std::vector<Emitter>& emitters, const std::vector<LuxelPoint>& points,
                   const LightTransport& transport);

// One channel's equations: sum over terms of coefficient * factor = value.
struct LightEquation {
  struct Term {
    std::uint32_t unknown;
    float coefficient;
  };
  std::vector<Term> terms;
  float value;
};
// Factors exp(u) that bring the sums close to the values, as logarithms; `begin` are the u to begin with and to stay
// near, `firmness` how much each does: as much as so many equations; `most` how far
// each may go up.
std::vector<double> solve_logarithms(const std::vector<LightEquation>& equations, const std::vector<double>& begin,
                                     const std::vector<double>& firmness, const std::vector<double>& most);

}  // namespace fb::scene
