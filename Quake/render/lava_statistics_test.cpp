// Light of teleporters that are less than opaque, over many frames, by every estimator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "render/renderer.h"
#include "render/techniques/test_techniques.h"
#include "render/test_image.h"
#include "render/test_lava.h"

namespace fb::render {
namespace {

using LavaStatistics = LavaTest;

// Share of a hemisphere's light, by its cosine, that a square straight above brings (Howell, configuration factor B-3).
double share_of_square(double half, double height) {
  const double a = half / height, root = std::sqrt(1 + a * a);
  return 4 / kPi * (a / root) * std::atan(a / root);
}

// A floor under a teleporter's face, and a lamp above that: no way is bent, so every estimator has the sum of both
// squares' light, of the first by its opaque share and of the second by the rest.
TEST_F(LavaStatistics, IsALampByItsShareAndLetsTheRestOfLightThrough) {
  constexpr float kAlbedo = 0.6f, kLamp = 0.5f;
  for (const std::string& estimator : one_of_each_family(Whose::kUnbiased)) {
    scene::FrameSnapshot snapshot;
    auto assets = std::make_shared<scene::Assets>();
    assets->materials.push_back(constant(vec3(0.0f), vec3(kAlbedo)));
    assets->materials.push_back(glowing_liquid(*assets, scene::EmissionKind::kTeleport, scene::OpacityFrom::kItself));
    assets->materials[1].flags |= scene::kMaterialDielectric;
    assets->materials[1].alpha = 0.5f;
    assets->materials[1].index = 1.0f;
    assets->materials.push_back(constant(vec3(kLamp), vec3(0.0f)));
    add_level(snapshot, *assets, 0, 40, 0);
    add_level(snapshot, *assets, 100, 200, 1);
    add_level(snapshot, *assets, 200, 150, 2);
    snapshot.assets = assets;
    look(snapshot, {0, 0, 60}, 90, 4);
    RenderSettings s = water_settings(estimator, 1);
    s.emit_teleport = 1.0f;
    s.spp = 16;
    auto renderer = make_renderer(s, 48, 48);
    for (int frame = 0; frame < 8; ++frame) {
      snapshot.frame = static_cast<std::uint64_t>(frame);
      renderer->render(snapshot, nullptr, s);
    }
    const ImageEstimate e = image_estimate(renderer->read().linear());
    const double expected = kAlbedo * (0.5 * share_of_square(200, 100) + 0.5 * kLamp * share_of_square(150, 200));
    EXPECT_NEAR(e.mean, expected, 4 * e.error + 1e-3 * expected) << estimator;
    EXPECT_LT(e.error, 0.02 * expected) << estimator << ": says something";
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  }
}

}  // namespace
}  // namespace fb::render
