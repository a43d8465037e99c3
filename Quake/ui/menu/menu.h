// The menus: which page is open, which row is selected, what a key or the mouse does. No window and no host: keys come
// as Key, what is done goes out as console command text, what there is comes from Facts.
//
//   Menu menu({console, bindings, facts});  // registers togglemenu, menu_main, menu_options, ...
//   menu.press(Key::kDown); menu.type("vol"); menu.point(x, y); menu.click(true);
//   if (menu.open()) menu.draw(list, atlas, width, height, view);
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/bindings.h"
#include "console/console.h"
#include "console/input_line.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/menu/layout.h"
#include "ui/menu/pages.h"
#include "ui/painter.h"

namespace fb::ui::menu {

enum class Key { kUp, kDown, kLeft, kRight, kEnter, kBack, kDelete, kErase, kPageUp, kPageDown, kHome, kEnd };

// What surrounds the menus in a frame.
struct Scenery {
  double time = 0.0;  // seconds, for what moves
  int scale = 0;      // as menu_scale's
};

class Menu {
 public:
  // Console, bindings and facts must outlive it, and the console executes none of its commands afterwards.
  Menu(con::Console& console, con::Bindings& bindings, Facts& facts);
  Menu(const Menu&) = delete;
  Menu& operator=(const Menu&) = delete;

  // Called with the name of a sound when the player moves, chooses and changes: "misc/menu1.wav" and others.
  void set_sound(std::function<void(std::string_view)> sound) { sound_ = std::move(sound); }
  // Called when the menu opens.
  void set_opened(std::function<void()> opened) { opened_ = std::move(opened); }

  bool open() const { return !views_.empty(); }
  void show(std::string_view page);  // with the pages that lead to it behind it
  void toggle();                     // togglemenu: to the main page, and from there to the game
  void close();

  // A key of the menus; nothing happens while it is not open.
  void press(Key key);
  // Text that was typed: for a search, a value that is edited, y and n.
  void type(std::string_view text);
  // The line of a setting that is typed; null: none is.
  con::InputLine* edited_line() { return open() && editing_ ? &edit_ : nullptr; }
  // Whether the next key of any device is to be given to bind().
  bool capturing() const { return open() && capturing_; }
  // The key for the command of the selected row; 0: none, as before.
  void bind(int key);
  // The pointer, in output pixels, and its button: `again`, the second one, goes back.
  void point(float x, float y);
  void click(bool again = false);
  void wheel(int rows);  // up is negative

  // Once a frame, before drawing: lists that changed.
  void update();
  void draw(scene::DrawList& list, Atlas& atlas, int width, int height, const Scenery& scenery);

  // For tests and the host.
  const std::string& page_name() const;
  const Row* selected() const;
  std::string_view filter() const;
  bool editing() const { return editing_; }
  bool asking() const { return question_.has_value(); }
  bool takes_text() const;  // typed letters mean something here

 private:
  struct View {
    std::string name;
    Page page;
    std::vector<std::size_t> shown;  // rows that pass the filter
    std::size_t cursor = 0;          // in shown
    std::size_t first = 0;           // scrolled to
    std::size_t picture = 0;         // of Page::pictures
    std::string filter;
  };
  struct Question {
    std::string text;
    bool yes = true;  // selected
  };

  View& view() { return views_.back(); }
  const View& view() const { return views_.back(); }
  Row* selected_row();
  View make_view(const PageInfo& info) const;
  void push(std::string_view page);
  void back();
  void rebuild(View& view);
  void filter_rows(View& view);
  void move(int rows, bool around);
  void step_to_selectable(View& view, int direction);
  void enter();
  void choose(const Row& row);
  void change(const Row& row, int steps);
  void apply(const Control& control, std::string_view value);
  void reset();
  void erase();
  void begin_edit(const Control& control);
  void end_edit(bool keep);
  void press_edit(Key key);
  void press_question(Key key);
  void answer(bool yes);
  void sound(std::string_view name) const;
  void register_commands();

  // menu_draw.cpp
  void draw_title(Painter& painter) const;
  void draw_row(Painter& painter, const RowPlace& place, const Scenery& scenery) const;
  void draw_value(Painter& painter, const Row& row, const RowPlace& place, const Scenery& scenery) const;
  void draw_foot(Painter& painter);
  void draw_save_picture(Painter& painter, const Row* row);
  void draw_question(Painter& painter);

  con::Console& console_;
  con::Bindings& bindings_;
  Facts& facts_;
  HostForm form_;
  Sources sources_;
  std::function<void(std::string_view)> sound_;
  std::function<void()> opened_;
  std::vector<View> views_;                                  // the last is shown; empty: closed
  std::map<std::string, std::size_t, std::less<>> cursors_;  // where pages were left, by name
  std::optional<Question> question_;
  bool capturing_ = false, editing_ = false;
  std::size_t column_ = 0;  // of keys: 0 or 1
  con::InputLine edit_;
  std::uint64_t revision_ = 0;
  Layout layout_;
  Box yes_box_, no_box_;
  std::optional<std::string> pictured_;  // the save whose picture the atlas has now, or which has none
  bool has_picture_ = false;
  int scale_ = 1;
  float pointer_x_ = -1.0f, pointer_y_ = -1.0f;  // virtual pixels
};

}  // namespace fb::ui::menu
