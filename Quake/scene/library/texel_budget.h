// How many bytes of texels a game's images may take together. What would be more is shown smaller: the largest images
// are halved, on both sides, until all fit, as gl_picmip would have it of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/assets.h"

namespace fb::scene {

// Where nobody says: the images of large packs of textures.
constexpr std::uint64_t kUsualTexelBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kLeastTexelBytes = 1u << 16u;

// As the device holds them, in words of four bytes.
std::uint64_t texel_bytes(const Image& image);

// The mean of every four texels, of the light that they are: colours are averaged in linear light, by what covers. Of
// palette indices every second one. Nothing of one texel on both sides becomes smaller.
void halve(Image& image);

// Halves the largest, the first among equals, until all take `most` or none can be halved. Returns how many are smaller
// now.
std::size_t halve_largest(std::vector<Image>& images, std::uint64_t most);

}  // namespace fb::scene
