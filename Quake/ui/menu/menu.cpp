#include "ui/menu/menu.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"

namespace fb::ui::menu {
namespace {

constexpr std::string_view kMoved = "misc/menu1.wav", kChosen = "misc/menu2.wav";

}  // namespace

Menu::Menu(con::Console& console, con::Bindings& bindings, Facts& facts)
    : console_(console), bindings_(bindings), facts_(facts), sources_{console, bindings, facts, form_} {
  register_commands();
}

void Menu::register_commands() {
  console_.add_command("togglemenu", "togglemenu: open the menu, or go back to the main page and to the game",
                       [this](const con::Args&) { toggle(); });
  for (const PageInfo& info : page_list()) {
    if (*info.command == '\0') continue;
    console_.add_command(info.command, fmt::format("{}: open this page of the menus", info.command),
                         [this, name = info.name](const con::Args&) { show(name); });
  }
}

void Menu::sound(std::string_view name) const {
  if (sound_) sound_(name);
}

const std::string& Menu::page_name() const {
  static const std::string none;
  return open() ? view().name : none;
}

Row* Menu::selected_row() {
  if (!open() || view().cursor >= view().shown.size()) return nullptr;
  Row& row = view().page.rows[view().shown[view().cursor]];
  return selectable(row) ? &row : nullptr;
}
const Row* Menu::selected() const { return const_cast<Menu*>(this)->selected_row(); }

std::string_view Menu::filter() const { return open() ? std::string_view(view().filter) : std::string_view(); }

bool Menu::takes_text() const {
  return open() && (editing_ || view().page.searchable || !view().page.search_page.empty());
}

Menu::View Menu::make_view(const PageInfo& info) const {
  View view;
  view.name = info.name;
  view.page = info.make(sources_);
  return view;
}

void Menu::filter_rows(View& view) {
  view.shown.clear();
  for (std::size_t i = 0; i < view.page.rows.size(); ++i) {
    const Row& row = view.page.rows[i];
    const bool shown = view.filter.empty() || (selectable(row) && holds(row, view.filter));
    if (shown) view.shown.push_back(i);
  }
  view.cursor = std::min(view.cursor, view.shown.empty() ? 0 : view.shown.size() - 1);
  step_to_selectable(view, 1);
}

// From the cursor on to the next row that can be selected, else back.
void Menu::step_to_selectable(View& view, int direction) {
  const auto count = static_cast<int>(view.shown.size());
  for (const int step : {direction, -direction}) {
    for (int at = static_cast<int>(view.cursor); at >= 0 && at < count; at += step) {
      if (!selectable(view.page.rows[view.shown[static_cast<std::size_t>(at)]])) continue;
      view.cursor = static_cast<std::size_t>(at);
      return;
    }
  }
}

void Menu::push(std::string_view name) {
  const PageInfo* info = find_page(name);
  if (info == nullptr) return;
  if (open()) cursors_[view().name] = view().cursor;
  View made = make_view(*info);
  if (const auto found = cursors_.find(name); found != cursors_.end()) made.cursor = found->second;
  filter_rows(made);
  if (!made.page.opening.empty()) console_.append(made.page.opening + "\n");
  views_.push_back(std::move(made));
  revision_ = facts_.revision();
  column_ = 0;
  capturing_ = editing_ = false;
  question_.reset();
  layout_ = {};
}

void Menu::show(std::string_view name) {
  const bool was_open = open();
  if (was_open) cursors_[view().name] = view().cursor;
  views_.clear();
  std::vector<std::string_view> path;
  for (std::string_view at = name; !at.empty();) {
    const PageInfo* info = find_page(at);
    if (info == nullptr) break;
    path.insert(path.begin(), at);
    at = info->parent;
  }
  for (const std::string_view page : path) push(page);
  if (!open()) return;
  if (!was_open && opened_) opened_();
  sound(kChosen);
}

void Menu::close() {
  if (open()) cursors_[view().name] = view().cursor;
  views_.clear();
  question_.reset();
  capturing_ = editing_ = false;
  pictured_.reset();
}

void Menu::toggle() {
  if (open() && view().name == "main") return close();
  show("main");
}

void Menu::back() {
  cursors_[view().name] = view().cursor;
  views_.pop_back();
  if (!open()) return;
  rebuild(view());
  sound(kChosen);
}

void Menu::rebuild(View& view) {
  const PageInfo* info = find_page(view.name);
  if (info == nullptr) return;
  const bool had_row = view.cursor < view.shown.size();
  const std::string label = had_row ? view.page.rows[view.shown[view.cursor]].label : std::string();
  view.page = info->make(sources_);
  filter_rows(view);
  const auto at = [&](std::size_t i) -> const std::string& { return view.page.rows[view.shown[i]].label; };
  if (!had_row || (view.cursor < view.shown.size() && at(view.cursor) == label)) return;
  // Rows may have come before it.
  for (std::size_t i = 0; i < view.shown.size(); ++i) {
    if (at(i) != label) continue;
    view.cursor = i;
    return;
  }
}

// A value or a question is answered on the page as it was when that began.
void Menu::update() {
  if (!open() || facts_.revision() == revision_ || editing_ || question_) return;
  revision_ = facts_.revision();
  if (view().page.live) rebuild(view());
}

void Menu::move(int rows, bool around) {
  View& shown = view();
  const auto count = static_cast<int>(shown.shown.size());
  if (count == 0) return;
  int at = static_cast<int>(shown.cursor) + rows;
  if (around) at = (at % count + count) % count;
  const std::size_t before = shown.cursor;
  shown.cursor = static_cast<std::size_t>(std::clamp(at, 0, count - 1));
  // Past headings, round the end too.
  for (int tries = 0; tries < count && !selectable(shown.page.rows[shown.shown[shown.cursor]]); ++tries) {
    if (around)
      shown.cursor = static_cast<std::size_t>((static_cast<int>(shown.cursor) + (rows < 0 ? -1 : 1) + count) % count);
    else
      step_to_selectable(shown, rows < 0 ? -1 : 1);
  }
  if (shown.cursor != before) sound(kMoved);
}

void Menu::press(Key key) {
  if (!open()) return;
  if (capturing_) {
    if (key == Key::kBack) capturing_ = false;
    return;
  }
  if (question_) return press_question(key);
  if (editing_) return press_edit(key);
  View& shown = view();
  const std::size_t pictures = shown.page.pictures.size();
  const Row* row = selected();
  switch (key) {
    case Key::kUp:
    case Key::kDown:
      if (pictures > 0) return press(key == Key::kUp ? Key::kLeft : Key::kRight);
      return move(key == Key::kUp ? -1 : 1, true);
    case Key::kPageUp:
    case Key::kPageDown: {
      const int room = static_cast<int>(std::max<std::size_t>(layout_.room, 1));
      return move(key == Key::kPageUp ? -room : room, false);
    }
    case Key::kHome:
    case Key::kEnd:
      return move(key == Key::kHome ? -1000000 : 1000000, false);
    case Key::kLeft:
    case Key::kRight: {
      const int direction = key == Key::kLeft ? -1 : 1;
      if (pictures > 0) {
        shown.picture =
            (shown.picture + pictures + static_cast<std::size_t>(direction + static_cast<int>(pictures))) % pictures;
        return sound(kChosen);
      }
      if (row == nullptr || !row->enabled) return;
      if (row->kind == Row::Kind::kBinding) column_ = key == Key::kLeft ? 0 : 1;
      if (row->kind == Row::Kind::kSetting) change(*row, direction);
      return;
    }
    case Key::kEnter:
      if (pictures > 0) return press(Key::kRight);
      return enter();
    case Key::kBack:
      if (!shown.filter.empty()) {
        shown.filter.clear();
        return filter_rows(shown);
      }
      return back();
    case Key::kDelete:
      return reset();
    case Key::kErase:
      return erase();
  }
}

void Menu::enter() {
  const Row* row = selected();
  if (row == nullptr || !row->enabled) return;
  switch (row->kind) {
    case Row::Kind::kHeading:
      return;
    case Row::Kind::kBinding:
      capturing_ = true;
      return sound(kChosen);
    case Row::Kind::kSetting:
      if (row->control->kind == Control::Kind::kText || row->control->kind == Control::Kind::kSlider)
        return begin_edit(*row->control);
      return change(*row, 1);
    case Row::Kind::kAction:
      sound(kChosen);
      if (row->question.empty()) return choose(Row(*row));
      question_ = Question{row->question};
      return;
  }
}

void Menu::choose(const Row& row) {
  if (row.choose) row.choose();
  const std::string command = row.command_now ? row.command_now() : row.command;
  if (row.closes) close();
  if (!command.empty()) console_.append(command + "\n");
  if (!open()) return;
  if (row.goes_back) return back();
  if (!row.page.empty()) push(row.page);
}

void Menu::press_question(Key key) {
  switch (key) {
    case Key::kUp:
    case Key::kLeft:
    case Key::kDown:
    case Key::kRight:
      question_->yes = !question_->yes;
      return sound(kMoved);
    case Key::kEnter:
      return answer(question_->yes);
    case Key::kBack:
      return answer(false);
    default:
      return;
  }
}

void Menu::answer(bool yes) {
  question_.reset();
  const Row* row = selected();
  if (yes && row != nullptr) choose(Row(*row));
}

void Menu::type(std::string_view text) {
  if (!open() || capturing_) return;
  if (question_) {
    if (text == "y" || text == "Y") answer(true);
    if (text == "n" || text == "N") answer(false);
    return;
  }
  if (editing_) return edit_.type(text);
  for (std::size_t i = 0; i < view().shown.size(); ++i) {
    const char letter = view().page.rows[view().shown[i]].letter;
    if (letter == 0 || !con::same_name(text, std::string_view(&letter, 1))) continue;
    view().cursor = i;
    return enter();
  }
  if (!view().page.search_page.empty()) push(std::string(view().page.search_page));
  if (!view().page.searchable || (view().filter.empty() && text == " ")) return;
  view().filter += text;
  view().cursor = view().first = 0;
  filter_rows(view());
}

}  // namespace fb::ui::menu
