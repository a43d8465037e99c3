// A film's frames out of the pictures of its lanes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/film/film_spec.h"

namespace fb::lab {

constexpr std::uint32_t kFilmLine = 2;  // pixels between lanes

// Row-major, red in the lowest byte, sRGB.
struct FilmFrame {
  uvec2 size{0, 0};
  std::vector<std::uint32_t> pixels;
};
uvec2 film_size(const FilmSpec& film);

// Columns of the film that lane `lane` has in its frame `frame`: [begin, end). Lanes are in their order from the left.
struct LaneColumns {
  std::uint32_t begin = 0, end = 0;
};
LaneColumns lane_columns(const FilmSpec& film, std::size_t lane, std::uint32_t frame);

// `pictures`: one a lane, of the spec's size. What is magnified by zooming shows its pixels (nearest).
FilmFrame compose(const FilmSpec& film, std::span<const std::vector<std::uint32_t>> pictures, std::uint32_t frame);

// The part of a lane's picture that the frame shows.
struct FilmView {
  vec2 corner{0.0f}, size{0.0f};
};
FilmView zoomed_view(const FilmSpec& film, std::uint32_t frame);

}  // namespace fb::lab
