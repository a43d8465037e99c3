// Debug views by name and number: the rows of Shaders/shared/debug_views.h and of techniques' headers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "estimators/techniques.h"
#include "shared/debug_views.h"

#define FB_DEBUG_VIEWS(X) \
  FB_FRAME_VIEWS(X)       \
  FB_TECHNIQUE_VIEWS(X)

namespace fb::render {

struct DebugView {
  std::uint32_t number;
  std::uint32_t owner;  // shared::kViewOf*
  std::string_view name, help;
};
std::span<const DebugView> debug_views();
// The largest number of one.
std::uint32_t last_debug_view();

// Whether a view needs FrameSnapshot::baked.
inline bool shows_baked_light(std::uint32_t number) { return number == shared::kViewAuthored; }

// Who draws a view; shared::kViewOfFrame where there is none of that number.
std::uint32_t view_owner(std::uint32_t number);

}  // namespace fb::render
