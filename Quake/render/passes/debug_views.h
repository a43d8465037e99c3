// Debug views by name and number: the rows of Shaders/shared/debug_views.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "shared/debug_views.h"

namespace fb::render {

struct DebugView {
  std::uint32_t number;
  std::uint32_t owner;  // shared::kViewOf*
  std::string_view name, help;
};
std::span<const DebugView> debug_views();

// Who draws a view; shared::kViewOfFrame where there is none of that number.
std::uint32_t view_owner(std::uint32_t number);

}  // namespace fb::render
