// A map's baked light as the device reads it for the view `authored` (Shaders/shared/baked_words.h).
#pragma once

#include <cstdint>
#include <vector>

#include "formats/bsp.h"
#include "scene/library/lightmaps.h"

namespace fb::scene {

// Empty where the map has no baked light.
std::vector<std::uint32_t> baked_words(const formats::Bsp& bsp, const Lightmaps& lightmaps);

}  // namespace fb::scene
