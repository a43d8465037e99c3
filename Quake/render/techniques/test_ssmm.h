// What tests of screen-space mixtures in the whole renderer share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/test_device.h"

namespace fb::render {

class SsmmTest : public DeviceTest {
 protected:
  static RenderSettings ssmm_settings(const std::string& estimator) {
    RenderSettings s;
    s.estimator = estimator;
    s.accumulate = 0;
    return s;
  }
  static constexpr std::uint64_t kEmptyArrays = 3 * 16;  // of the world, which is not kept
  // The pixels of a view of states: black where there is none.
  static std::vector<std::uint32_t> view_of(Renderer& renderer, const scene::FrameSnapshot& scene, RenderSettings s,
                                            std::uint32_t view) {
    s.debug_view = static_cast<int>(view);
    renderer.render(scene, nullptr, s);
    std::vector<std::uint32_t> seen;
    for (const std::uint32_t pixel : renderer.read().output()) seen.push_back(pixel & 0xffffffu);
    return seen;
  }
  static std::ptrdiff_t valid_states(Renderer& renderer, const scene::FrameSnapshot& scene, const RenderSettings& s) {
    return std::ranges::count_if(view_of(renderer, scene, s, shared::kViewSsmmCount),
                                 [](std::uint32_t pixel) { return pixel != 0; });
  }
};

}  // namespace fb::render
