// Quake's fog as a medium: what the bytes that Quake mixes are as light.
#pragma once

#include "base/maths.h"
#include "scene/snapshot.h"

namespace fb::scene {

// `density`: Quake's, of exp(-(density z / 64)^2); `color` linear; `covers`: of the sky, 0 to 1. Of what the medium
// scatters (its albedo) a part stays.
void show_as_in_quake(Medium& medium, float density, const vec3& color, float covers);

}  // namespace fb::scene
