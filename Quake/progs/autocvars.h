// Globals named autocvar_NAME, which hold what the cvar NAME is (DP_QC_AUTOCVARS): floats, strings and vectors ("1 2
// 3").
#pragma once

#include <string>
#include <vector>

#include "progs/vm.h"

namespace fb::con {
class Console;
}

namespace fb::progs {

class Autocvars {
 public:
  // Makes the cvars that are missing, with what the globals hold as defaults; then refreshes. Vm and console must
  // outlive it.
  Autocvars(Vm& vm, con::Console& console);
  // Gives the globals what the cvars are now. What QuakeC itself has stored in one stays until its cvar changes.
  void refresh();

 private:
  struct Bound {
    Definition global;
    std::string cvar, value;  // that the global has been given
  };
  Vm& vm_;
  con::Console& console_;
  std::vector<Bound> bound_;
};

}  // namespace fb::progs
