// Where the parts of a page are, in the painter's virtual pixels. Drawing and the mouse use the same.
#pragma once

#include <cstddef>
#include <vector>

#include "ui/menu/page.h"

namespace fb::ui::menu {

constexpr int kPageWidth = 320, kPageHeight = 200;  // of Quake's menus; pages with lists use more where there is more
constexpr float kRowHeight = 10.0f, kListedHeight = 20.0f, kLetter = 8.0f;

struct Box {
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;
  bool contains(float px, float py) const { return px >= x && py >= y && px < x + width && py < y + height; }
};

struct RowPlace {
  std::size_t row = 0;  // in Page::rows
  Box box, value;       // the whole row; the part with its value
  bool large = false;   // one of the listed rows
};

struct Layout {
  Box page;
  float title_y = 0.0f, help_y = 0.0f;
  Box picture;                        // of the selected save; no width: there is none
  std::vector<RowPlace> places;       // of the visible rows
  std::size_t first = 0;              // index, in the list of shown rows, of the first visible small row
  std::size_t room = 0;               // small rows that fit
  bool above = false, below = false;  // there are more
};

// `shown`: the rows that pass the filter, as indices of Page::rows. `cursor`: one of them, by its place in `shown`,
// kept visible. `first`: where the list was scrolled to.
Layout lay_out(const Page& page, const std::vector<std::size_t>& shown, std::size_t cursor, std::size_t first,
               int width, int height);

// Where a row's slider is: ten letters, of which the first and the last are its ends.
Box slider_box(const RowPlace& place);

// Whole output pixels for a virtual one, so that a page fits: as large as can be if `wanted` is 0, at most `wanted`.
int menu_scale(int output_width, int output_height, int wanted);

}  // namespace fb::ui::menu
