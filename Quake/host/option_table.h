// The options of the command line, one row each, for parsing and for -help. All options of QuakeSpasm and its
// descendants are here, so that their launchers and scripts can start this program, too.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/options.h"

namespace fb::host {

struct Option {
  const char* name;
  const char* value;  // its name in -help: "N" must follow, "[N]" is an optional number, "" has no value
  // Applies the value, "" if none is given. nullptr: the option and its value are accepted without effect.
  Status (*apply)(GameOptions& options, const std::string& value);
  const char* help;  // what it does, or why it has no effect; nullptr: a second name, which -help does not list
};

std::span<const Option> option_table();
const Option* find_option(std::string_view name);
// The option with the name nearest to a mistyped one; nullptr if none is near.
const Option* nearest_option(std::string_view name);

}  // namespace fb::host
