// The options of the command line, one row each: what parsing knows and what -help says are the same. Those of
// QuakeSpasm and its descendants are all there, so that their launchers and scripts start this program too.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/options.h"

namespace fb::host {

struct Option {
  const char* name;
  const char* value;  // what -help calls it: "N" must follow, "[N]" may follow as a number, "" nothing does
  // Takes the value, "" where none is given. nullptr: the option is taken, what follows it too, and does nothing.
  Status (*apply)(GameOptions& options, const std::string& value);
  const char* help;  // what it does, or why it does nothing; nullptr: another name, which -help does not list
};

std::span<const Option> option_table();
const Option* find_option(std::string_view name);
// The option that a mistyped one is nearest to; nullptr where none is near.
const Option* nearest_option(std::string_view name);

}  // namespace fb::host
