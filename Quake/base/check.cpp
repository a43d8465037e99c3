#include "base/check.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace fb {
namespace {
std::function<std::string()>& hint_function() {
  static std::function<std::string()> hint;
  return hint;
}
}  // namespace

void fatal(const char* file, int line, const std::string& message) {
  std::fprintf(stderr, "fatal: %s:%d: %s\n", file, line, message.c_str());
  if (auto hint = std::exchange(hint_function(), nullptr)) {
    std::fprintf(stderr, "to reproduce: %s\n", hint().c_str());
  }
  std::fflush(stderr);
  std::abort();
}

void set_reproduction_hint(std::function<std::string()> hint) { hint_function() = std::move(hint); }

}  // namespace fb
