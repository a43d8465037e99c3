#include "scene/authored/displayed_fog.h"

#include <algorithm>
#include <cmath>

#include "shared/displayed_fog.h"
#include "shared/tone.h"

namespace fb::scene {
namespace {

constexpr float kDensityUnits = 64.0f, kDensest = 10.0f;  // 1/unit
// Of what Quake's fog, which has its whole colour already, scatters besides, so that lamps have a halo in it: with all
// of it LibreQuake's fogs are a fifth to two fifths of a stop too bright and too much of one colour.
constexpr float kScattered = 0.1f;

}  // namespace

void show_as_in_quake(Medium& medium, float density, const vec3& color, float covers) {
  const float rate = std::min(density / kDensityUnits, kDensest);
  medium.square = shared::kDisplayedMix * shared::displayed_fog_rate(shared::srgb_from_linear(color)) * rate * rate;
  medium.glow = color;
  medium.albedo *= kScattered;
  medium.sky = std::pow(1.0f - covers, shared::kDisplayedMix);
  medium.glow_before_sky = std::pow(covers, shared::kDisplayedMix);
}

}  // namespace fb::scene
