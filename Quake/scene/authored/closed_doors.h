// Closed doors that a map's author saw light through. Light tools pass brush entities over, so behind a door that is
// closed when the game begins there may be light that no open way brings. Where it is most of what a place was baked
// with, such a door casts no shadow; others do.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/authored/light_fit.h"

namespace fb::scene {

// Submodels of LitMap::submodels, ascending. `transport`: of the points, for the emitters that the fit is of.
std::vector<std::uint32_t> doors_lit_through(const LitMap& map, const MapEmitters& emitters, const LightFit& fit,
                                             const std::vector<LuxelPoint>& points, const LightTransport& transport);

}  // namespace fb::scene
