// How late fields of light are when a lamp goes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/techniques/test_pstf.h"
#include "scene/in_code/scenes_in_motion.h"

namespace fb::render {
namespace {

using PstfChanges = PstfTest;

struct Lag {
  double left = 0;   // of all light, a frame after the first without the lamp
  double noise = 0;  // mean square of what frames before differ by
};

// The lamp of `lightsout` goes, with which all but 0.5% of the light does. Of light that cells hand to each other a
// frame takes one reflection away, however much is forgotten: 15% of all would be left. Cells follow straight light
// (pstf_change.h), and frames before are as they were.
TEST_F(PstfChanges, LightThatCellsHandOnGoesWithItsLamp) {
  const auto assets = scene::lights_out_assets();
  RenderSettings s = pstf_settings("pstf_b_nee", 4);
  s.jitter = 0;
  auto renderer = make_renderer(s, 48, 27);
  const auto lag_of = [&](int vertex, float change) {
    s.pstf_vertex = vertex;
    s.pstf_change = change;
    renderer->reset_learning();
    Lag lag;
    double before = 0;
    std::vector<vec4> former;
    constexpr std::uint64_t kBegin = scene::kLightsOutFrame - 32, kSeen = scene::kLightsOutFrame - 8;
    for (std::uint64_t frame = kBegin; frame < scene::kLightsOutFrame + 2; ++frame) {
      renderer->render(scene::lights_out(assets, frame, 60), nullptr, s);
      if (frame < kSeen) continue;
      const std::vector<vec4> now = renderer->read().linear();
      double sum = 0;
      for (const vec4& pixel : now) sum += static_cast<double>(pixel.y);
      if (frame < scene::kLightsOutFrame) {
        before += sum / 8;
        for (std::size_t i = 0; i < former.size(); ++i) {
          const double off = static_cast<double>(now[i].y - former[i].y);
          lag.noise += std::min(off * off, 1.0);
        }
      }
      lag.left = sum / before;
      former = now;
    }
    return lag;
  };
  for (const int vertex : {1, 2}) {
    const Lag with = lag_of(vertex, RenderSettings{}.pstf_change), without = lag_of(vertex, 0);
    const std::string name = "vertex " + std::to_string(vertex);
    RecordProperty("left" + std::to_string(vertex), std::to_string(with.left));
    RecordProperty("left_without" + std::to_string(vertex), std::to_string(without.left));
    EXPECT_LT(with.left, 0.05) << name;
    EXPECT_GT(without.left, 0.2) << name;
    EXPECT_LT(with.noise, 1.05 * without.noise) << name;
  }
}

}  // namespace
}  // namespace fb::render
