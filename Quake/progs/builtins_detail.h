// The standard builtins, a file for each kind.
#pragma once

#include "progs/builtins.h"

namespace fb::progs {

void add_math_builtins(BuiltinTable& table, const Services& services);

}  // namespace fb::progs
