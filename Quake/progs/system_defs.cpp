#include "progs/system_defs.h"

namespace fb::progs {

#define FB_ROW(type, name, offset) {ValueTraits<type>::kType, #name, offset},

std::span<const SystemDefinition> system_globals() {
  static constexpr SystemDefinition kRows[] = {FB_SYSTEM_GLOBALS(FB_ROW)};
  return kRows;
}

std::span<const SystemDefinition> system_fields() {
  static constexpr SystemDefinition kRows[] = {FB_SYSTEM_FIELDS(FB_ROW)};
  return kRows;
}

#undef FB_ROW

}  // namespace fb::progs
