#include "ui/menu/layout.h"

#include <algorithm>
#include <cmath>

#include "ui/menu/facts.h"

namespace fb::ui::menu {
namespace {

constexpr float kMostWidth = 420.0f, kMostHeight = 300.0f;
constexpr float kTitleHeight = 34.0f, kHelpHeight = 40.0f, kShortHelpHeight = 22.0f, kPictureHelpHeight = 62.0f,
                kPlaqueWidth = 56.0f, kIndent = 16.0f;

}  // namespace

int menu_scale(int output_width, int output_height, int wanted) {
  const int largest = std::max(1, std::min(output_width / kPageWidth, output_height / kPageHeight));
  return wanted > 0 ? std::min(wanted, largest) : largest;
}

Box slider_box(const RowPlace& place) { return {place.value.x, place.value.y, 10.0f * kLetter, place.value.height}; }

Layout lay_out(const Page& page, const std::vector<std::size_t>& shown, std::size_t cursor, std::size_t first,
               int width, int height) {
  Layout layout;
  const auto total_width = static_cast<float>(width), total_height = static_cast<float>(height);
  const float needed = page.plaque ? static_cast<float>(kPageHeight) : kMostHeight;
  layout.page.width = std::min(total_width, page.plaque ? static_cast<float>(kPageWidth) : kMostWidth);
  layout.page.height = std::min(total_height, needed);
  layout.page.x = std::floor(0.5f * (total_width - layout.page.width));
  layout.page.y = std::floor(0.5f * (total_height - layout.page.height));
  layout.title_y = layout.page.y + 4.0f;
  const float foot = page.save_pictures ? kPictureHelpHeight : page.listed_rows > 0 ? kShortHelpHeight : kHelpHeight;
  layout.help_y = layout.page.y + layout.page.height - foot;
  if (page.save_pictures) {
    const float high = kPictureHelpHeight - 8.0f;
    const float wide = high * static_cast<float>(kSavePictureWidth) / static_cast<float>(kSavePictureHeight);
    layout.picture = {layout.page.x + layout.page.width - wide - 4.0f, layout.help_y + 4.0f, wide, high};
  }

  const float left = layout.page.x + (page.plaque ? kPlaqueWidth : 0.0f);
  const float right = layout.page.x + layout.page.width;
  const float value_x = left + kLetter * std::floor(page.value_column * (right - left) / kLetter);
  float y = layout.page.y + kTitleHeight;
  std::size_t index = 0;
  const auto add = [&](float high, bool large) {
    const float x = left + (large ? 0.0f : kIndent - kLetter);
    RowPlace place;
    place.row = shown[index];
    place.box = {x, y, right - x, high};
    place.value = {value_x, y, right - value_x, high};
    place.large = large;
    layout.places.push_back(place);
    y += high;
    ++index;
  };
  while (index < shown.size() && shown[index] < page.listed_rows) add(kListedHeight, true);
  if (index > 0) y += 4.0f;

  const std::size_t small_rows = shown.size() - index, listed = index;
  layout.room = static_cast<std::size_t>(std::max(1.0f, (layout.help_y - y) / kRowHeight));
  if (small_rows <= layout.room) {
    layout.first = 0;
  } else {
    layout.first = std::min(first, small_rows - layout.room);
    if (cursor >= listed) {
      const std::size_t at = cursor - listed;
      if (at < layout.first) layout.first = at;
      if (at >= layout.first + layout.room) layout.first = at + 1 - layout.room;
      // The heading of the first row is shown with it.
      if (at > 0 && at == layout.first && page.rows[shown[listed + at - 1]].kind == Row::Kind::kHeading) --layout.first;
    }
  }
  index += layout.first;
  layout.above = layout.first > 0;
  for (std::size_t i = 0; i < layout.room && index < shown.size(); ++i) add(kRowHeight, false);
  layout.below = index < shown.size();
  return layout;
}

}  // namespace fb::ui::menu
