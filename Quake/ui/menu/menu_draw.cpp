// Draws the menus.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "ui/menu/menu.h"
#include "ui/painter.h"
#include "ui/wrap.h"

namespace fb::ui::menu {
namespace {

const vec4 kWhite(1.0f), kDim(0.55f, 0.5f, 0.45f, 1.0f), kShade(0.0f, 0.0f, 0.0f, 0.6f);
const vec4 kBehindSelected(1.0f, 0.8f, 0.4f, 0.16f), kSliderBack(0.3f, 0.24f, 0.18f, 1.0f),
    kKnob(1.0f, 0.8f, 0.4f, 1.0f);
constexpr int kDots = 6;                            // gfx/menudot1.lmp to 6
constexpr unsigned char kCursor = 11, kArrow = 13;  // of Quake's character set
constexpr unsigned char kSliderLeft = 128, kSliderBar = 129, kSliderRight = 130, kSliderKnob = 131;
constexpr std::size_t kHelpLines = 4;
constexpr std::string_view kSavePicture = "save";  // in the atlas
const vec4 kPictureFrame(0.3f, 0.24f, 0.18f, 1.0f);

std::size_t columns(float width) { return static_cast<std::size_t>(std::max(0.0f, width / kLetter)); }

void text(Painter& painter, float x, float y, std::string_view line, float width, bool gold = false,
          const vec4& color = kWhite) {
  painter.text(x, y, line.substr(0, columns(width)), gold, color);
}

// Letters of twice the size, for names that have no picture.
void large_text(Painter& painter, float x, float y, std::string_view line, bool gold) {
  for (const char c : line) {
    const auto code =
        static_cast<unsigned char>(gold ? static_cast<unsigned char>(c) ^ 128u : static_cast<unsigned char>(c));
    if (c != ' ') painter.picture(x, y, 2 * kLetter, 2 * kLetter, painter.atlas().glyph(code));
    x += 2 * kLetter;
  }
}

void draw_slider(Painter& painter, const Box& box, float fraction) {
  const float y = box.y + 1.0f, inside = box.width - 2.0f * kLetter;
  if (painter.atlas().has_game_font()) {
    painter.character(box.x, y, kSliderLeft);
    for (float x = 0.0f; x < inside; x += kLetter) painter.character(box.x + kLetter + x, y, kSliderBar);
    painter.character(box.x + box.width - kLetter, y, kSliderRight);
    painter.character(box.x + kLetter + fraction * (inside - kLetter), y, kSliderKnob);
  } else {
    painter.fill(box.x + kLetter, y + 3.0f, inside, 2.0f, kSliderBack);
    painter.fill(box.x + kLetter + fraction * (inside - 4.0f), y, 4.0f, 8.0f, kKnob);
  }
}

}  // namespace

void Menu::draw(scene::DrawList& list, Atlas& atlas, int width, int height, const Scenery& scenery) {
  if (!open()) return;
  scale_ = menu_scale(width, height, scenery.scale);
  Painter painter(list, atlas, width, height, scale_);
  painter.fill(0.0f, 0.0f, static_cast<float>(painter.width() + 1), static_cast<float>(painter.height() + 1), kShade);
  View& shown = view();
  layout_ = lay_out(shown.page, shown.shown, shown.cursor, shown.first, painter.width(), painter.height());
  shown.first = layout_.first;
  const Box& page = layout_.page;
  if (!shown.page.pictures.empty()) {
    if (const Picture* picture = atlas.picture(shown.page.pictures[shown.picture], false)) {
      painter.picture(std::floor(0.5f * static_cast<float>(painter.width() - kPageWidth)),
                      std::floor(0.5f * static_cast<float>(painter.height() - kPageHeight)), *picture);
      layout_.places.clear();
      return;
    }
  }
  if (shown.page.plaque) {
    if (const Picture* plaque = atlas.picture("gfx/qplaque.lmp", false))
      painter.picture(page.x + 16.0f, page.y + 4.0f, *plaque);
  }
  draw_title(painter);
  const Picture* names = shown.page.list_picture.empty() ? nullptr : atlas.picture(shown.page.list_picture, false);
  if (names != nullptr && !layout_.places.empty() && layout_.places.front().large)
    painter.picture(layout_.places.front().box.x + kLetter * 2.0f, layout_.places.front().box.y, *names);
  for (const RowPlace& place : layout_.places) draw_row(painter, place, scenery);
  if (shown.shown.empty()) {
    const bool searched = !shown.filter.empty();
    text(painter, page.x + 24.0f, page.y + 60.0f, searched ? "Nothing has these words." : shown.page.empty, page.width,
         true);
  }
  draw_foot(painter);
  if (question_) draw_question(painter);
}

void Menu::draw_title(Painter& painter) const {
  const Page& page = view().page;
  const float middle = layout_.page.x + 0.5f * layout_.page.width;
  const Picture* picture = page.title_picture.empty() ? nullptr : painter.atlas().picture(page.title_picture, false);
  if (picture != nullptr) {
    painter.picture(std::floor(middle - 0.5f * static_cast<float>(picture->width)), layout_.title_y, *picture);
  } else {
    const float width = 2.0f * kLetter * static_cast<float>(page.title.size());
    large_text(painter, std::floor(middle - 0.5f * width), layout_.title_y + 4.0f, page.title, true);
  }
}

void Menu::draw_row(Painter& painter, const RowPlace& place, const Scenery& scenery) const {
  const Row& row = view().page.rows[place.row];
  const bool is_selected = &row == selected();
  const Atlas& atlas = painter.atlas();
  if (place.large) {
    const bool has_picture =
        !view().page.list_picture.empty() && painter.atlas().picture(view().page.list_picture, false) != nullptr;
    if (!has_picture) large_text(painter, place.box.x + 2.0f * kLetter, place.box.y + 2.0f, row.label, false);
    if (!is_selected) return;
    const int frame = static_cast<int>(scenery.time * 10.0) % kDots;
    const std::string name = "gfx/menudot" + std::to_string(frame + 1) + ".lmp";
    if (const Picture* dot = painter.atlas().picture(name, false))
      painter.picture(place.box.x - 2.0f, place.box.y - 2.0f, *dot);
    else
      large_text(painter, place.box.x, place.box.y + 2.0f, ">", true);
    return;
  }
  const float y = place.box.y + 1.0f, x = place.box.x + kLetter;
  if (is_selected) {
    painter.fill(place.box.x, place.box.y, place.box.width, place.box.height, kBehindSelected);
    if (atlas.has_game_font())
      painter.character(place.box.x, y, std::fmod(scenery.time, 0.5) < 0.25 ? kArrow : kArrow - 1);
    else
      painter.character(place.box.x, y, '>');
  }
  const bool has_value = row.kind != Row::Kind::kHeading && (row.kind != Row::Kind::kAction || !row.value.empty());
  const float label_width =
      (has_value ? place.value.x : place.box.x + place.box.width) - x - (has_value ? kLetter : 0.0f);
  text(painter, x, y, row.label, label_width, row.kind == Row::Kind::kHeading, row.enabled ? kWhite : kDim);
  draw_value(painter, row, place, scenery);
}

void Menu::draw_value(Painter& painter, const Row& row, const RowPlace& place, const Scenery& scenery) const {
  const float x = place.value.x, y = place.value.y + 1.0f, width = place.value.width;
  const vec4 color = row.enabled ? kWhite : kDim;
  const bool is_selected = &row == selected();
  if (row.kind == Row::Kind::kAction) return text(painter, x, y, row.value, width, true, color);
  if (row.kind == Row::Kind::kBinding) {
    const std::vector<int> keys = bindings_.keys_of(row.bound);
    const float half = kLetter * std::floor(0.5f * width / kLetter);
    for (std::size_t column = 0; column < 2; ++column) {
      const bool here = is_selected && column == column_;
      std::string name = column < keys.size() ? facts_.key_name(keys[column]) : "---";
      if (here && capturing_) name = "press key";
      const float left = x + half * static_cast<float>(column);
      if (here) painter.fill(left - 2.0f, place.value.y, half - 4.0f, place.value.height, kBehindSelected);
      text(painter, left, y, name, here && capturing_ ? width : half - kLetter, here,
           column < keys.size() ? kWhite : kDim);
      if (here && capturing_ && column == 0) break;
    }
    return;
  }
  if (row.kind != Row::Kind::kSetting) return;
  const Control& control = *row.control;
  if (is_selected && editing_) {
    const std::size_t room = columns(width) > 1 ? columns(width) - 1 : 1;
    const std::size_t first = edit_.cursor() > room ? edit_.cursor() - room : 0;
    painter.fill(x - 1.0f, place.value.y, width, place.value.height, kShade);
    text(painter, x, y, std::string_view(edit_.text()).substr(first), width, true);
    if (std::fmod(scenery.time, 0.5) < 0.25)
      painter.character(x + kLetter * static_cast<float>(edit_.cursor() - first), y, kCursor);
    return;
  }
  if (control.kind == Control::Kind::kSlider) {
    const Box slider = slider_box(place);
    draw_slider(painter, slider, static_cast<float>(control.fraction()));
    return text(painter, slider.x + slider.width + kLetter, y, control.shown(), width - slider.width - kLetter, true,
                color);
  }
  if (control.kind == Control::Kind::kColor) {
    // Players' colours are the palette's rows of 16; the first eight are dark first.
    const int row_of = std::atoi(control.shown().c_str());
    const int index = 16 * row_of + (row_of < 8 ? 11 : 4);
    painter.fill(x, place.value.y + 1.0f, 4.0f * kLetter, kLetter, painter.atlas().color(index));
    return text(painter, x + 5.0f * kLetter, y, control.shown(), width, true, color);
  }
  const std::string value = control.shown();
  const bool empty = value.empty() && control.kind == Control::Kind::kText;
  text(painter, x, y, empty ? "_" : value, width, true, color);
}

// Saves are written while the menu is closed, so a picture is read when its row is selected and kept till another is.
void Menu::draw_save_picture(Painter& painter, const Row* row) {
  const Box& box = layout_.picture;
  if (box.width <= 0.0f || row == nullptr || row->save.empty()) return;
  if (pictured_ != row->save) {
    const auto image = facts_.save_picture(row->save);
    has_picture_ = image && painter.atlas().replace(kSavePicture, *image);
    pictured_ = row->save;
  }
  painter.fill(box.x - 1.0f, box.y - 1.0f, box.width + 2.0f, box.height + 2.0f, kPictureFrame);
  if (const Picture* picture = has_picture_ ? painter.atlas().picture(kSavePicture, false) : nullptr)
    painter.picture(box.x, box.y, box.width, box.height, *picture);
  else
    text(painter, box.x + 8.0f, box.y + 0.5f * box.height - 4.0f, "no picture", box.width, false, kDim);
}

void Menu::draw_foot(Painter& painter) {
  const Box& page = layout_.page;
  const View& shown = view();
  const float left = page.x + (shown.page.plaque ? 56.0f : 8.0f), right = page.x + page.width;
  if (layout_.above) painter.character(right - kLetter, page.y + 25.0f, '^');
  if (layout_.below) painter.character(right - kLetter, layout_.help_y - 9.0f, 'v');
  if (shown.page.searchable || !shown.page.search_page.empty()) {
    const std::string line = shown.filter.empty() ? "(type to search)" : "search: " + shown.filter + "_";
    text(painter, left, page.y + 25.0f, line, right - left, !shown.filter.empty(),
         shown.filter.empty() ? kDim : kWhite);
  }
  const Row* row = selected();
  draw_save_picture(painter, row);
  if (row == nullptr || row->help.empty()) return;
  const float end = layout_.picture.width > 0.0f ? layout_.picture.x - kLetter : right;
  float y = layout_.help_y + 2.0f;
  std::size_t lines = 0;
  for (const std::string_view line : wrap(row->help, std::max<std::size_t>(columns(end - left), 1))) {
    if (lines++ == kHelpLines) break;
    painter.text(left, y, line, false, vec4(0.85f, 0.8f, 0.7f, 1.0f));
    y += 9.0f;
  }
}

void Menu::draw_question(Painter& painter) {
  const float width = 256.0f;
  const auto lines = wrap(question_->text, columns(width) - 4);
  const float height = 10.0f * static_cast<float>(lines.size()) + 36.0f;
  const float x = std::floor(0.5f * (static_cast<float>(painter.width()) - width));
  float y = std::floor(0.5f * (static_cast<float>(painter.height()) - height));
  painter.fill(x - 1.0f, y - 1.0f, width + 2.0f, height + 2.0f, vec4(0.6f, 0.4f, 0.2f, 1.0f));
  painter.fill(x, y, width, height, vec4(0.08f, 0.06f, 0.05f, 1.0f));
  y += 8.0f;
  for (const std::string_view line : lines) {
    painter.text(x + 2.0f * kLetter, y, line);
    y += 10.0f;
  }
  y += 6.0f;
  yes_box_ = {x + 6.0f * kLetter, y, 6.0f * kLetter, 12.0f};
  no_box_ = {x + 20.0f * kLetter, y, 6.0f * kLetter, 12.0f};
  const Box& chosen = question_->yes ? yes_box_ : no_box_;
  painter.fill(chosen.x, chosen.y, chosen.width, chosen.height, kBehindSelected);
  painter.text(yes_box_.x + kLetter, y + 2.0f, "Yes", question_->yes);
  painter.text(no_box_.x + kLetter, y + 2.0f, "No", !question_->yes);
}

}  // namespace fb::ui::menu
