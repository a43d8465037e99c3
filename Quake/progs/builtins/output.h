// Where builtins print: text comes in pieces, the log wants whole lines.
#pragma once

#include <functional>
#include <string_view>

#include "progs/builtins/builtins.h"

namespace fb::progs {

// services.print, or what collects the pieces of a line for the log.
std::function<void(std::string_view)> output_of(const Services& services);

}  // namespace fb::progs
