// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace fb::lab {

struct ProgramEnd {
  int status = 0;      // exit status; 128 + the signal that ended it
  std::string output;  // what it printed, standard output and error together
};
// The first argument is the program: a path, or a name to be found in PATH. Fails if it cannot be started.
Result<ProgramEnd> run_program(const std::vector<std::string>& arguments);

}  // namespace fb::lab
