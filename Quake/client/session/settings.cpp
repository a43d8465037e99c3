#include "client/session/settings.h"

#include <algorithm>

namespace fb::cl {

std::vector<std::string> split_names(const std::string& list) {
  std::vector<std::string> names;
  std::size_t start = 0;
  while (start <= list.size()) {
    const std::size_t end = std::min(list.find(',', start), list.size());
    if (end > start) names.push_back(list.substr(start, end - start));
    start = end + 1;
  }
  return names;
}

// Models whose poses jump on purpose: flames, and weapons with turning parts (QuakeSpasm's list).
const char* const kNoLerpModels =
    "progs/flame.mdl,progs/flame2.mdl,progs/braztall.mdl,progs/brazshrt.mdl,progs/longtrch.mdl,progs/flame_pyre.mdl,"
    "progs/v_saw.mdl,progs/v_xfist.mdl,progs/h2stuff/newfire.mdl";

std::vector<std::string> Settings::default_nolerp_models() { return split_names(kNoLerpModels); }

}  // namespace fb::cl
