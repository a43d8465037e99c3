#include "lab/film/film_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kLineColor = 0xffffffffu, kGapColor = 0xff000000u;

}  // namespace

uvec2 film_size(const FilmSpec& film) {
  if (!film.side_by_side) return film.size;
  const auto lanes = static_cast<std::uint32_t>(film.lanes.size());
  return {lanes * film.size.x + (lanes - 1) * kFilmLine, film.size.y};
}

LaneColumns lane_columns(const FilmSpec& film, std::size_t lane, std::uint32_t frame) {
  const std::uint32_t width = film.size.x;
  if (film.side_by_side) {
    const auto begin = static_cast<std::uint32_t>(lane) * (width + kFilmLine);
    return {begin, begin + width};
  }
  const auto lanes = static_cast<double>(film.lanes.size());
  const double turn = film.sweep > 0 ? std::sin(2 * std::numbers::pi * frame / (film.fps * film.sweep)) : 0;
  const auto line = [&](std::size_t i) {
    if (i == 0) return 0u;
    if (i == film.lanes.size()) return width;
    return static_cast<std::uint32_t>(std::lround(width * (static_cast<double>(i) + 0.45 * turn) / lanes));
  };
  return {line(lane), line(lane + 1)};
}

FilmView zoomed_view(const FilmSpec& film, std::uint32_t frame) {
  const vec2 whole(film.size);
  if (!film.zoom || frame < film.zoom->begins) return {vec2(0.0f), whole};
  const FilmZoom& zoom = *film.zoom;
  // Of the way, slow at both ends.
  float t = 1.0f;
  if (frame < zoom.ends) {
    t = static_cast<float>(frame - zoom.begins) / static_cast<float>(zoom.ends - zoom.begins);
    t = t * t * (3.0f - 2.0f * t);
  }
  // Its size shrinks by the same factor in equal steps, and a point stays where it is on the screen.
  const vec2 size = whole * vec2(std::pow(zoom.size.x / whole.x, t), std::pow(zoom.size.y / whole.y, t));
  const vec2 shrunk = (whole - size) / glm::max(whole - zoom.size, vec2(1e-3f));
  return {zoom.corner * shrunk, size};
}

FilmFrame compose(const FilmSpec& film, std::span<const std::vector<std::uint32_t>> pictures, std::uint32_t frame) {
  FB_CHECK_EQ(pictures.size(), film.lanes.size());
  FilmFrame out{film_size(film), {}};
  out.pixels.assign(std::size_t{out.size.x} * out.size.y, kGapColor);
  const FilmView view = zoomed_view(film, frame);
  std::vector<std::uint32_t> columns(film.size.x);
  for (std::uint32_t x = 0; x < film.size.x; ++x) {
    const float at = view.corner.x + (static_cast<float>(x) + 0.5f) * view.size.x / static_cast<float>(film.size.x);
    columns[x] = std::min(static_cast<std::uint32_t>(at), film.size.x - 1);
  }
  for (std::size_t lane = 0; lane < pictures.size(); ++lane) {
    FB_CHECK_EQ(pictures[lane].size(), std::size_t{film.size.x} * film.size.y);
    const LaneColumns place = lane_columns(film, lane, frame);
    for (std::uint32_t y = 0; y < film.size.y; ++y) {
      const float at = view.corner.y + (static_cast<float>(y) + 0.5f) * view.size.y / static_cast<float>(film.size.y);
      const std::size_t row = std::size_t{std::min(static_cast<std::uint32_t>(at), film.size.y - 1)} * film.size.x;
      for (std::uint32_t x = place.begin; x < place.end; ++x) {
        const std::uint32_t own = film.side_by_side ? x - place.begin : x;
        const bool line = !film.side_by_side && lane > 0 && x < place.begin + kFilmLine / 2;
        const bool before = !film.side_by_side && lane + 1 < pictures.size() && x + kFilmLine / 2 >= place.end;
        out.pixels[std::size_t{y} * out.size.x + x] =
            line || before ? kLineColor : pictures[lane][row + columns[own]] | 0xff000000u;
      }
    }
  }
  return out;
}

}  // namespace fb::lab
