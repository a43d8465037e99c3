// What a setting's row edits and how: a toggle, a slider, a choice, a colour or a text. Where a cvar is behind it, its
// kind and limits follow from the cvar's specification, so that every cvar has a row without more being said.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/cvar.h"

namespace fb::ui::menu {

struct Control {
  enum class Kind { kToggle, kSlider, kChoice, kColor, kText };
  struct Choice {
    std::string value, label;
  };

  Kind kind = Kind::kText;
  std::function<std::string()> read;                           // the value as text
  std::function<std::string(std::string_view value)> command;  // console text that sets it
  std::optional<std::string> default_value;                    // none: it cannot be reset
  double min = 0.0, max = 1.0, step = 0.1;                     // kSlider; kColor: up to max
  bool integer = false;
  std::vector<Choice> choices;  // kChoice

  // The value for people: "on", "3.5", a choice's label.
  std::string shown() const;
  // Where the value lies between the slider's ends, 0 to 1.
  double fraction() const;
  // The text of the value `steps` further: the other one of a toggle, the next choice (round again), the next step of a
  // slider within its limits. A text's is unchanged.
  std::string moved(int steps) const;
  // The slider's value at this fraction, on its steps.
  std::string at_fraction(double fraction) const;
};

// The control of a cvar. A cvar that has no limits is a toggle if its help begins with "0:" or "1:" and its default is
// 0 or 1; else its text is edited. The cvar must outlive the control.
Control control_of(const con::Cvar& cvar);
// A slider over a part of the cvar's range.
Control slider_of(const con::Cvar& cvar, double min, double max, double step);
Control choice_of(const con::Cvar& cvar, std::vector<Control::Choice> choices);
// 1 and 0.
Control toggle_of(const con::Cvar& cvar);

// "1", "2" or "5" times a power of ten, near the number; 1 where the number is not above 0.
double round_step(double number);

}  // namespace fb::ui::menu
