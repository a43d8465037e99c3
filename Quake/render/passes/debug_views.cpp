#include "render/passes/debug_views.h"

#include <algorithm>
#include <array>

namespace fb::render {

std::span<const DebugView> debug_views() {
#define FB_ROW(constant, number, owner, name, help) DebugView{number, shared::owner, name, help},
  static constexpr std::array kViews{FB_DEBUG_VIEWS(FB_ROW)};
#undef FB_ROW
  return kViews;
}

std::uint32_t last_debug_view() { return std::ranges::max(debug_views(), {}, &DebugView::number).number; }

std::uint32_t view_owner(std::uint32_t number) {
  for (const DebugView& view : debug_views())
    if (view.number == number) return view.owner;
  return shared::kViewOfFrame;
}

}  // namespace fb::render
