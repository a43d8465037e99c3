// A gloss image of a byte a texel is read as one of four bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

class GlossTest : public DeviceTest {
 protected:
  static std::uint8_t gloss(int x, int y) { return static_cast<std::uint8_t>(5 + 9 * x + y); }
  // Roughness of each pixel of the quad, with a gloss image of 15 x 7 texels, whose rows begin within words.
  static std::vector<float> roughness(scene::ImageEncoding encoding) {
    scene::FrameSnapshot snapshot = scene::textured_quad();
    auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
    scene::Image image{"gloss", encoding, 15, 7, {}};
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 15; ++x) {
        image.texels.push_back(gloss(x, y));
        if (scene::texel_bytes(encoding) == 4) image.texels.insert(image.texels.end(), {1, 2, 255});
      }
    // An odd number of bytes before it.
    assets->images.push_back({"before", scene::ImageEncoding::kLinearGray, 3, 1, {0, 0, 0}});
    assets->images.push_back(std::move(image));
    scene::Material& material = assets->materials.back();
    material.frames[0].gloss = static_cast<std::uint32_t>(assets->images.size() - 1);
    material.specular = 0.04f;
    snapshot.assets = assets;
    RenderSettings settings;
    settings.bounces = 0;
    settings.accumulate = 0;
    settings.jitter = 0;
    const auto renderer = make_renderer(settings, 90, 90);
    renderer->render(snapshot, nullptr, settings);
    std::vector<float> values;
    for (const auto& texel : renderer->read().gbuffer())
      values.push_back(texel.id == scene::kIdWorld ? texel.albedo_roughness.w : -1.0f);
    return values;
  }
};

TEST_F(GlossTest, OneByteATexelIsReadAsFour) {
  const std::vector<float> bytes = roughness(scene::ImageEncoding::kLinearGray);
  EXPECT_EQ(bytes, roughness(scene::ImageEncoding::kLinearRgba));
  int seen = 0;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 15; ++x) {
      const float wanted = 1.0f - static_cast<float>(gloss(x, y)) / 255.0f;
      seen += std::ranges::any_of(bytes, [&](float value) { return std::abs(value - wanted) < 1e-4f; }) ? 1 : 0;
    }
  EXPECT_EQ(seen, 15 * 7) << "of every texel";
}

}  // namespace
}  // namespace fb::render
