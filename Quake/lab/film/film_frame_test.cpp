#include "lab/film/film_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fb::lab {
namespace {

FilmSpec film_of(std::size_t lanes, uvec2 size) {
  FilmSpec film;
  film.size = size;
  film.fps = 10;
  film.lanes.resize(lanes);
  return film;
}

TEST(FilmFrame, LanesShareAllColumnsInTheirOrder) {
  FilmSpec film = film_of(3, {100, 4});
  film.sweep = 2;
  bool moved = false;
  for (std::uint32_t frame = 0; frame < 40; ++frame) {
    std::uint32_t end = 0;
    for (std::size_t lane = 0; lane < 3; ++lane) {
      const LaneColumns columns = lane_columns(film, lane, frame);
      EXPECT_EQ(columns.begin, end);
      EXPECT_GT(columns.end, columns.begin) << "lane " << lane << " in frame " << frame;
      end = columns.end;
    }
    EXPECT_EQ(end, 100u);
    moved |= lane_columns(film, 0, frame).end != 33;
  }
  EXPECT_TRUE(moved);
  EXPECT_EQ(lane_columns(film, 0, 3).end, lane_columns(film, 0, 23).end) << "2 seconds later it is there again";
}

TEST(FilmFrame, AZoomBeginsWithAllAndEndsWithItsPart) {
  FilmSpec film = film_of(1, {160, 90});
  film.zoom = FilmZoom{{100, 45}, {16, 9}, 10, 20};
  for (const std::uint32_t frame : {0u, 10u}) {
    EXPECT_EQ(zoomed_view(film, frame).corner, vec2(0.0f)) << frame;
    EXPECT_EQ(zoomed_view(film, frame).size, vec2(160, 90)) << frame;
  }
  for (const std::uint32_t frame : {20u, 31u}) {
    const FilmView view = zoomed_view(film, frame);
    EXPECT_NEAR(view.size.x, 16, 1e-3) << frame;
    EXPECT_NEAR(view.corner.x, 100, 1e-3) << frame;
    EXPECT_NEAR(view.corner.y, 45, 1e-3) << frame;
  }
  const FilmView half = zoomed_view(film, 15);
  EXPECT_NEAR(half.size.x, 160 / std::sqrt(10.0f), 1e-3) << "half way it has half of the logarithm";
  // The point that stays: the same share of every view lies to its left.
  const float fixed = 100.0f / (160.0f - 16.0f) * 160.0f;
  for (const std::uint32_t frame : {12u, 15u, 19u}) {
    const FilmView view = zoomed_view(film, frame);
    EXPECT_NEAR((fixed - view.corner.x) / view.size.x, fixed / 160.0f, 1e-4f) << frame;
  }
  film.zoom->begins = film.zoom->ends = 5;
  EXPECT_EQ(zoomed_view(film, 4).size.x, 160.0f);
  EXPECT_NEAR(zoomed_view(film, 5).size.x, 16, 1e-3) << "at once";
}

TEST(FilmFrame, AMagnifiedPartShowsItsPixels) {
  FilmSpec film = film_of(1, {4, 2});
  film.zoom = FilmZoom{{2, 1}, {2, 1}, 0, 0};
  const std::vector<std::vector<std::uint32_t>> pictures{{1, 2, 3, 4, 5, 6, 7, 8}};
  const FilmFrame frame = compose(film, pictures, 0);
  std::vector<std::uint32_t> shown;
  for (const std::uint32_t pixel : frame.pixels) shown.push_back(pixel & 0xffu);
  EXPECT_EQ(shown, (std::vector<std::uint32_t>{7, 7, 8, 8, 7, 7, 8, 8}));
}

}  // namespace
}  // namespace fb::lab
