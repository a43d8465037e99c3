#include "base/out_of_memory.h"

namespace fb {

std::string sentence_of(const std::bad_alloc& failure) {
  const auto* ours = dynamic_cast<const OutOfMemory*>(&failure);
  return ours ? ours->what() : "the system has no memory left for this program";
}

}  // namespace fb
