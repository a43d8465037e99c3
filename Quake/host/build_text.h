// Which build this is.
#pragma once

#include <string>

namespace fb::host {

// "optimised, compiler 12.2.0, program 0123456789abcdef": tells builds of one version apart, by the program's own bytes
// where the system says where they are. Reads the whole program.
std::string build_text();

}  // namespace fb::host
