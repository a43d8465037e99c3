// Numeric options of the laboratory, read as all numbers that people type (base/number.h).
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/number.h"

namespace fb::host {

// Upper limits that no measurement needs to exceed.
constexpr std::uint32_t kMostSamples = 1u << 24u;  // per pixel
constexpr std::uint32_t kMostFrames = 10000000;

// An option whose value is a number from `low` to `high`; `value` holds its default, and must outlive the app.
template <typename T>
CLI::Option* add_number(CLI::App& app, const std::string& name, T& value, T low, T high, const std::string& help) {
  const auto read = [name, &value, low, high](const std::string& text) {
    const auto number = [&] {
      if constexpr (std::integral<T>)
        return whole_number_in<T>(name, text, low, high);
      else
        return number_in(name, text, static_cast<double>(low), static_cast<double>(high));
    }();
    if (!number) throw CLI::ValidationError(number.error().message, CLI::ExitCodes::ValidationError);
    value = static_cast<T>(*number);
  };
  return app.add_option_function<std::string>(name, read, help)
      ->type_name(fmt::format("{} to {}", low, high))
      ->default_str(fmt::format("{}", value));
}

}  // namespace fb::host
