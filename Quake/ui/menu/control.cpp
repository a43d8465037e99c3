#include "ui/menu/control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "console/args.h"

namespace fb::ui::menu {
namespace {

constexpr double kMostChoices = 8.0;  // a range of whole numbers up to this size is stepped through

double number_of(const std::string& text) { return std::atof(text.c_str()); }
// The decimal number that the user sees: 0.1 rather than what a float holds of it.
double decimal(float value) { return number_of(con::number_text(value)); }
std::string text_of(double value) { return con::number_text(static_cast<float>(value)); }

Control of_cvar(const con::Cvar& cvar, Control::Kind kind) {
  Control control;
  control.kind = kind;
  control.read = [&cvar] { return cvar.string(); };
  control.command = [&cvar](std::string_view value) {
    return fmt::format("{} {}", cvar.name(), con::in_quotes(std::string(value)));
  };
  control.default_value = cvar.default_string();
  return control;
}

bool is_switch(const con::Cvar& cvar) {
  const con::CvarSpec& spec = cvar.spec();
  const bool says_so = spec.help.starts_with("1:") || spec.help.starts_with("0:");
  if (spec.min && spec.max) return (spec.integer || says_so) && *spec.min == 0.0f && *spec.max == 1.0f;
  const bool binary = spec.default_value == "0" || spec.default_value == "1";
  return binary && says_so && !cvar.has_range();
}

// A twentieth of the range; of a range that is far wider than the value, a tenth of the value.
double step_for(const con::Cvar& cvar, double min, double max, bool integer) {
  double step = (max - min) / 20.0;
  const double size = std::max({std::abs(number_of(cvar.default_string())), std::abs(decimal(cvar.value())), 1.0});
  if (max - min > 100.0 * size) step = size / 10.0;
  step = round_step(step);
  return integer ? std::max(1.0, std::round(step)) : step;
}

}  // namespace

double round_step(double number) {
  if (!(number > 0.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(number)));
  const double digit = number / power;
  return power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

std::string Control::shown() const {
  const std::string value = read();
  if (kind == Kind::kToggle) return number_of(value) != 0.0 ? "on" : "off";
  if (kind != Kind::kChoice) return value;
  for (const Choice& choice : choices) {
    if (choice.value == value) return choice.label;
  }
  return value;
}

double Control::fraction() const {
  return max > min ? std::clamp((number_of(read()) - min) / (max - min), 0.0, 1.0) : 0.0;
}

std::string Control::at_fraction(double fraction) const {
  const double steps = std::round(std::clamp(fraction, 0.0, 1.0) * (max - min) / step);
  const double value = std::clamp(min + steps * step, min, max);
  return text_of(integer ? std::round(value) : value);
}

std::string Control::moved(int steps) const {
  const std::string value = read();
  switch (kind) {
    case Kind::kToggle:
      return number_of(value) != 0.0 ? "0" : "1";
    case Kind::kSlider: {
      // Onto the grid of steps first, so that 0.07 goes to 0.1 and not to 0.17; a rounding error is no step.
      const double place = (number_of(value) - min) / step;
      const double from = steps > 0 ? std::floor(place + 1e-3) : std::ceil(place - 1e-3);
      return text_of(std::clamp(min + (from + steps) * step, min, max));
    }
    case Kind::kColor: {
      const int last = static_cast<int>(max);
      const int at = static_cast<int>(number_of(value)) + steps;
      return std::to_string(((at % (last + 1)) + last + 1) % (last + 1));
    }
    case Kind::kChoice: {
      if (choices.empty()) return value;
      const auto count = static_cast<int>(choices.size());
      const auto found = std::ranges::find(choices, value, &Choice::value);
      const int at = found == choices.end() ? (steps > 0 ? -1 : count) : static_cast<int>(found - choices.begin());
      return choices[static_cast<std::size_t>(((at + steps) % count + count) % count)].value;
    }
    case Kind::kText:
      break;
  }
  return value;
}

Control toggle_of(const con::Cvar& cvar) { return of_cvar(cvar, Control::Kind::kToggle); }

Control slider_of(const con::Cvar& cvar, double min, double max, double step) {
  Control control = of_cvar(cvar, Control::Kind::kSlider);
  control.min = min;
  control.max = max;
  control.step = step;
  control.integer = cvar.spec().integer;
  return control;
}

Control choice_of(const con::Cvar& cvar, std::vector<Control::Choice> choices) {
  Control control = of_cvar(cvar, Control::Kind::kChoice);
  control.choices = std::move(choices);
  return control;
}

Control control_of(const con::Cvar& cvar) {
  const con::CvarSpec& spec = cvar.spec();
  if (is_switch(cvar)) return toggle_of(cvar);
  if (!spec.min || !spec.max) return of_cvar(cvar, Control::Kind::kText);
  const double min = decimal(*spec.min), max = decimal(*spec.max);
  const bool few = spec.integer && max - min < kMostChoices;
  if (!few && spec.words.empty()) return slider_of(cvar, min, max, step_for(cvar, min, max, spec.integer));
  std::vector<Control::Choice> choices;
  if (few) {
    for (double value = min; value <= max; value += 1.0) choices.push_back({text_of(value), text_of(value)});
  }
  for (const auto& [word, value] : spec.words) {
    const std::string text = con::number_text(value);
    const auto found = std::ranges::find(choices, text, &Control::Choice::value);
    if (found != choices.end())
      found->label = word;
    else
      choices.push_back({text, word});
  }
  return choice_of(cvar, std::move(choices));
}

}  // namespace fb::ui::menu
