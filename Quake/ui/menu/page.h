// A page of the menus as data: its title and its rows. A row's work is console command text, another page, or a setting
// (control.h), so that a page is a short table (pages_*.cpp).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ui/menu/control.h"

namespace fb::ui::menu {

struct Row {
  enum class Kind { kHeading, kAction, kSetting, kBinding };

  Kind kind = Kind::kAction;
  std::string label;
  std::string value;  // shown beside the label of an action
  std::string help;   // shown at the foot while the row is selected
  std::string save;   // whose picture is shown at the foot while the row is selected
  bool enabled = true;
  char letter = 0;  // chooses the row wherever the cursor is, on a page that is not searched; lower case

  // kAction, in this order: where there is a question, all this happens once it is answered with yes.
  std::string question;
  std::function<void()> choose;              // changes what other rows of the menu read
  std::string command;                       // console text
  std::function<std::string()> command_now;  // or, where it depends on what was chosen meanwhile
  std::string page;                          // opened above this one
  bool closes = false;                       // the menu
  bool goes_back = false;                    // to the page before

  std::optional<Control> control;  // kSetting
  std::string bound;               // kBinding: the command whose keys it shows and changes
};

struct Page {
  std::string title, title_picture;
  // A picture of the first rows' names, 20 pixels each, and how many rows it shows; without the picture the names are
  // drawn large.
  std::string list_picture;
  std::size_t listed_rows = 0;
  std::vector<Row> rows;
  bool searchable = false;            // typing shows only the rows that hold every typed word
  std::string search_page;            // typing opens this page, which is searchable
  bool live = false;                  // made anew when the facts change (Facts::revision)
  bool plaque = true;                 // the game's plaque at the left, where there is room
  bool save_pictures = false;         // rows have a `save`: the foot has room for its picture
  float value_column = 0.5f;          // where values begin, as a fraction of the page's width
  std::vector<std::string> pictures;  // help: pages of pictures, turned with left and right
  std::string empty;                  // what is said where there is no row
  std::string opening;                // console text that runs when the page is opened
};

// Whether every word of the filter is in the row's label, value or help, in any case.
bool holds(const Row& row, std::string_view filter);
inline bool selectable(const Row& row) { return row.kind != Row::Kind::kHeading; }

}  // namespace fb::ui::menu
