// The part of the menus that changes things: settings, bindings, and the mouse.
#include <algorithm>

#include "ui/menu/menu.h"

namespace fb::ui::menu {
namespace {

constexpr std::string_view kChangedSound = "misc/menu3.wav", kChosenSound = "misc/menu2.wav";

void erase_last(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0u) == 0x80u) text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

// At once, since the row shows it in this frame.
void Menu::apply(const Control& control, std::string_view value) {
  const std::string command = control.command(value);
  std::size_t start = 0;
  while (start < command.size()) {
    const std::size_t end = con::command_end(command, start);
    console_.execute_line(std::string_view(command).substr(start, end - start));
    start = end + 1;
  }
}

void Menu::change(const Row& row, int steps) {
  const Control& control = *row.control;
  if (control.kind == Control::Kind::kText) return;
  apply(control, control.moved(steps));
  sound(kChangedSound);
}

void Menu::reset() {
  const Row* row = selected();
  if (row == nullptr || !row->enabled) return;
  if (row->kind == Row::Kind::kBinding) {
    const std::vector<int> keys = bindings_.keys_of(row->bound);
    if (column_ < keys.size()) bindings_.bind(keys[column_], "");
    sound(kChangedSound);
  } else if (row->kind == Row::Kind::kSetting && row->control->default_value) {
    apply(*row->control, *row->control->default_value);
    sound(kChangedSound);
  }
}

// A letter of the search; without one it means what DEL does.
void Menu::erase() {
  if (view().filter.empty()) return reset();
  erase_last(view().filter);
  filter_rows(view());
}

void Menu::begin_edit(const Control& control) {
  editing_ = true;
  edit_.set_text(control.read());
  sound(kChosenSound);
}

void Menu::end_edit(bool keep) {
  editing_ = false;
  const Row* row = selected();
  if (!keep || row == nullptr || !row->control) return;
  apply(*row->control, edit_.text());
  sound(kChangedSound);
}

void Menu::press_edit(Key key) {
  switch (key) {
    case Key::kEnter:
      return end_edit(true);
    case Key::kBack:
      return end_edit(false);
    case Key::kLeft:
      return edit_.move(-1);
    case Key::kRight:
      return edit_.move(1);
    case Key::kHome:
      return edit_.home();
    case Key::kEnd:
      return edit_.end();
    case Key::kErase:
      return edit_.erase_before();
    case Key::kDelete:
      return edit_.erase_at();
    case Key::kUp:
    case Key::kDown:
      end_edit(true);
      return press(key);
    default:
      return;
  }
}

// The key takes the place of the one in the selected column.
void Menu::bind(int key) {
  if (!capturing()) return;
  capturing_ = false;
  const Row* row = selected();
  if (key == 0 || row == nullptr || row->kind != Row::Kind::kBinding) return;
  const std::string command = row->bound;
  const std::vector<int> keys = bindings_.keys_of(command);
  if (column_ < keys.size() && keys[column_] != key) bindings_.bind(keys[column_], "");
  bindings_.bind(key, command);
  sound(kChangedSound);
}

void Menu::point(float x, float y) {
  pointer_x_ = x / static_cast<float>(scale_);
  pointer_y_ = y / static_cast<float>(scale_);
  if (!open() || capturing_ || editing_) return;
  if (question_) {
    if (yes_box_.contains(pointer_x_, pointer_y_)) question_->yes = true;
    if (no_box_.contains(pointer_x_, pointer_y_)) question_->yes = false;
    return;
  }
  for (const RowPlace& place : layout_.places) {
    if (!place.box.contains(pointer_x_, pointer_y_) || !selectable(view().page.rows[place.row])) continue;
    const auto found = std::ranges::find(view().shown, place.row);
    const auto at = static_cast<std::size_t>(found - view().shown.begin());
    if (found != view().shown.end() && at != view().cursor) {
      view().cursor = at;
      sound("misc/menu1.wav");
    }
    if (view().page.rows[place.row].kind == Row::Kind::kBinding)
      column_ = pointer_x_ < place.value.x + 0.5f * place.value.width ? 0 : 1;
  }
}

void Menu::click(bool again) {
  if (!open() || capturing_) return;
  if (again) return press(Key::kBack);
  if (question_) {
    if (yes_box_.contains(pointer_x_, pointer_y_)) return answer(true);
    if (no_box_.contains(pointer_x_, pointer_y_)) return answer(false);
    return;
  }
  if (editing_) end_edit(true);
  if (!view().page.pictures.empty()) return press(Key::kRight);
  for (const RowPlace& place : layout_.places) {
    if (!place.box.contains(pointer_x_, pointer_y_)) continue;
    const Row& row = view().page.rows[place.row];
    if (&row != selected()) continue;
    const bool slides = row.kind == Row::Kind::kSetting && row.control->kind == Control::Kind::kSlider;
    const Box slider = slider_box(place);
    if (slides && row.enabled && slider.contains(pointer_x_, pointer_y_)) {
      const float part =
          (pointer_x_ - slider.x - 1.5f * kLetter) / (slider.width - 3.0f * kLetter);  // the knob's middle
      apply(*row.control, row.control->at_fraction(static_cast<double>(part)));
      return sound(kChangedSound);
    }
    return enter();
  }
}

void Menu::wheel(int rows) {
  if (!open() || capturing_ || question_ || editing_) return;
  if (!view().page.pictures.empty()) return press(rows < 0 ? Key::kLeft : Key::kRight);
  move(rows, false);
}

}  // namespace fb::ui::menu
