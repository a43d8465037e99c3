#include "console/cvar.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/check.h"
#include "base/number.h"

namespace fb::con {
namespace {

// Compares in double, so that whole numbers up to int's range are exact.
std::optional<double> parse_value(std::string_view text) {
  const auto value = parse_number(text);
  return value && std::isfinite(static_cast<float>(*value)) ? value : std::nullopt;
}

std::string double_text(double value) { return fmt::format("{}", value == 0.0 ? 0.0 : value); }

}  // namespace

std::string number_text(float value) { return fmt::format("{}", value == 0.0f ? 0.0f : value); }

Cvar::Cvar(CvarSpec spec) : spec_(std::move(spec)) {
  FB_CHECK(!spec_.name.empty());
  if (spec_.on_change) listeners_.push_back(std::move(spec_.on_change));
  assign(spec_.default_value);
  if (has_range()) {
    const auto value = parse_value(spec_.default_value);
    FB_CHECK(value.has_value());
    if (spec_.min) FB_CHECK_LE(*spec_.min, static_cast<float>(*value));
    if (spec_.max) FB_CHECK_LE(static_cast<float>(*value), *spec_.max);
  }
}

std::string Cvar::range_text() const {
  const std::string whole = spec_.integer ? "whole numbers " : "";
  if (spec_.least_above_zero && spec_.max)
    return fmt::format("0, or {} to {}", number_text(*spec_.least_above_zero), number_text(*spec_.max));
  if (spec_.min && spec_.max) return fmt::format("{}{} to {}", whole, number_text(*spec_.min), number_text(*spec_.max));
  if (spec_.min) return fmt::format("{}at least {}", whole, number_text(*spec_.min));
  if (spec_.max) return fmt::format("{}at most {}", whole, number_text(*spec_.max));
  return spec_.integer ? "whole numbers" : "";
}

void Cvar::assign(std::string text) {
  const double parsed = std::strtod(text.c_str(), nullptr);
  const double value = std::isfinite(parsed) ? parsed : 0.0;
  value_ = std::isfinite(static_cast<float>(value)) ? static_cast<float>(value) : 0.0f;
  integer_ = static_cast<int>(std::clamp(value, static_cast<double>(INT_MIN), static_cast<double>(INT_MAX)));
  string_ = std::move(text);
}

void Cvar::notify() {
  // By index, because a listener may add one.
  for (std::size_t i = 0; i < listeners_.size(); ++i) {
    const auto listener = listeners_[i];
    listener(*this);
  }
}

std::string Cvar::set(std::string_view text) {
  std::string sentence, taken(text);
  const auto word =
      std::find_if(spec_.words.begin(), spec_.words.end(), [&](const auto& w) { return w.first == text; });
  if (word != spec_.words.end()) return set(word->second);
  if (has_range()) {
    const auto given = parse_value(text);
    if (!given)
      return fmt::format("{}: \"{}\" is not a number, so it stays {} ({}).", name(), text, string_, range_text());
    // As the limits are, a float: 0.001 is not below a limit of 0.001.
    const double asked = spec_.integer ? *given : static_cast<double>(static_cast<float>(*given));
    double value = spec_.integer ? std::round(asked) : asked;
    if (spec_.least_above_zero && value > 0.0) value = std::max(value, static_cast<double>(*spec_.least_above_zero));
    if (spec_.min) value = std::max(value, static_cast<double>(*spec_.min));
    if (spec_.max) value = std::min(value, static_cast<double>(*spec_.max));
    if (value != asked) {
      taken = spec_.integer ? double_text(value) : number_text(static_cast<float>(value));  // a limit, which is a float
      sentence = fmt::format("{}: {} is not allowed ({}), so it is {} now.", name(), text, range_text(), taken);
    }
  }
  if (taken == string_) return sentence;
  assign(std::move(taken));
  notify();
  return sentence;
}

std::string Cvar::set(float value) { return set(std::string_view(number_text(value))); }

}  // namespace fb::con
