// What a map's baked light asks of the picture: gains at the first vertex, skies that shine unseen, spots.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/renderer.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"
#include "shared/baked_past.h"
#include "shared/baked_words.h"
#include "shared/debug_views.h"
#include "shared/denoise.h"
#include "shared/gain_field.h"
#include "shared/light_change.h"
#include "shared/spot.h"
#include "shared/tone.h"

namespace fb::render {
namespace {

using AuthoredTest = DeviceTest;

// One cell all around, of that factor.
void add_gain(scene::FrameSnapshot& snapshot, const vec3& gain) {
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  scene::Image field{
      "gain field", scene::ImageEncoding::kWords, 2 * 2 * 2 * static_cast<int>(shared::kGainWays), 1, {}};
  const std::uint32_t word = shared::pack_rgb9e5(gain, 0.5f);
  for (int i = 0; i < field.width; ++i)
    for (int byte = 0; byte < 4; ++byte) field.texels.push_back(static_cast<std::uint8_t>(word >> (8 * byte)));
  assets->images.push_back(std::move(field));
  snapshot.gains = {static_cast<std::uint32_t>(assets->images.size() - 1), vec3(-1000.0f), 1000.0f, 2, 2, 2};
  snapshot.assets = std::move(assets);
  snapshot.authored = true;
}

TEST_F(AuthoredTest, GainsAreAFactorOnAllThatTheFirstVertexReflects) {
  const float albedo = 0.5f, emission = 0.25f;
  RenderSettings s = plain_settings("pt", 2);
  s.deterministic = 1;
  scene::FrameSnapshot snapshot = scene::furnace(albedo, emission);
  auto renderer = make_renderer(s, 24, 16);
  renderer->render(snapshot, nullptr, s);
  const auto plain = renderer->read().linear();
  add_gain(snapshot, vec3(0.5f, 1.0f, 1.5f));
  renderer->render(snapshot, nullptr, s);
  const auto gained = renderer->read().linear();
  ASSERT_EQ(plain.size(), gained.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const vec3 reflected = vec3(plain[i]) - emission;
    EXPECT_NEAR(gained[i].x - emission, 0.5f * reflected.x, 4e-3f);
    EXPECT_NEAR(gained[i].y - emission, reflected.y, 4e-3f);
    EXPECT_NEAR(gained[i].z - emission, 1.5f * reflected.z, 4e-3f);
  }
  snapshot.authored = false;
  renderer->render(snapshot, nullptr, s);
  EXPECT_EQ(renderer->read().linear(), plain);
}

// A closed room with a lamp that the camera does not see.
scene::FrameSnapshot lamp_room(const vec3& position, float radius) {
  scene::FrameSnapshot snapshot = scene::furnace(0.5f, 0.0f);
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  scene::Material glows;
  glows.name = "lamp";
  glows.emission_kind = scene::EmissionKind::kConstant;
  glows.emission = vec3(1.0f);
  assets->materials.push_back(glows);
  assets->meshes.push_back(scene::make_sphere());
  scene::Instance lamp;
  lamp.id = scene::kIdEntityLight;
  lamp.mesh = static_cast<std::uint32_t>(assets->meshes.size() - 1);
  lamp.material_base = static_cast<std::uint32_t>(assets->materials.size() - 1);
  lamp.visibility = scene::kSeenByIndirect;
  lamp.flags = scene::kInstanceColor;
  lamp.color = vec3(0.0f);
  lamp.emission = vec3(100.0f);
  lamp.transform = lamp.prev_transform = mat4x3(vec3(radius, 0, 0), vec3(0, radius, 0), vec3(0, 0, radius), position);
  snapshot.instances.push_back(lamp);
  snapshot.assets = std::move(assets);
  return snapshot;
}

// The same random numbers, so that pictures differ by the law alone: at each pixel by its value for a point of the
// lamp.
TEST_F(AuthoredTest, LampsFallOffByTheirOwnLaws) {
  const vec3 at(64, 20, 10);
  const float radius = 2.0f, scale = 1.0f / 60.0f;
  RenderSettings s = plain_settings("nee", 1);
  s.deterministic = 1;
  scene::FrameSnapshot snapshot = lamp_room(at, radius);
  const auto picture = [&] {
    auto renderer = make_renderer(s, 24, 16);  // which has learnt nothing yet
    renderer->render(snapshot, nullptr, s);
    return renderer->read().linear();
  };
  const auto plain = picture();
  for (const std::uint32_t law : {shared::kFallLinear, shared::kFallInverse, shared::kFallNone, shared::kFallOffset}) {
    scene::Instance& lamp = snapshot.instances.back();
    lamp.flags = scene::kInstanceColor | scene::kInstanceSpot | law << scene::kInstanceFallShift;
    lamp.color = vec3(-2.0f, -2.0f, scale);
    const auto fallen = picture();
    int compared = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (plain[i].x < 1e-3f) continue;
      const float across = (static_cast<float>(i % 24) + 0.5f) / 12.0f - 1.0f;
      const float down = (static_cast<float>(i / 24) + 0.5f) / 12.0f - 16.0f / 24.0f;
      const float d =
          glm::length(vec3(128.0f, -128.0f * across, -128.0f * down) - at);  // the wall ahead fills the picture
      const float a = shared::fall_share(law, (d - 1.1f * radius) * scale),
                  b = shared::fall_share(law, (d + 1.1f * radius) * scale);
      const float ratio = fallen[i].x / plain[i].x;
      EXPECT_GE(ratio, std::min(a, b) - 1e-2f) << law << " at " << d;
      EXPECT_LE(ratio, std::max(a, b) + 1e-2f + 0.02f * b) << law << " at " << d;
      ++compared;
    }
    EXPECT_GT(compared, 100);
  }
}

// r_authored changed in play: the first frame is as if there had been none before it.
TEST_F(AuthoredTest, AToggleLeavesNothingOfTheOtherLight) {
  for (const char* estimator : {"nee", "mcpg_nee"}) {
    RenderSettings s = plain_settings(estimator, 2);
    s.denoise = 1;
    s.taa = 1;
    s.deterministic = 1;
    scene::FrameSnapshot snapshot = lamp_room(vec3(64, 20, 10), 4.0f);
    const auto draw = [&](Renderer& renderer, std::uint64_t frame, bool authored) {
      snapshot.authored = authored;
      snapshot.instances.back().emission = vec3(authored ? 10.0f : 1000.0f);
      snapshot.frame = frame;
      snapshot.prev_time = static_cast<double>(frame) / 60.0;
      snapshot.time = static_cast<double>(frame + 1) / 60.0;
      snapshot.cut = frame == 0;
      renderer.render(snapshot, nullptr, s);
      return renderer.read().output();
    };
    auto played = make_renderer(s, 48, 32), fresh = make_renderer(s, 48, 32);
    for (std::uint64_t frame = 0; frame < 12; ++frame) draw(*played, frame, true);
    const auto after = draw(*played, 12, false), anew = draw(*fresh, 12, false);
    double apart = 0;
    for (std::size_t i = 0; i < after.size(); ++i)
      apart += std::abs(static_cast<double>(after[i] & 255u) - static_cast<double>(anew[i] & 255u)) /
               static_cast<double>(after.size());
    EXPECT_LT(apart, 1.0) << estimator << ": bytes, on average";
    EXPECT_EQ(played->accumulated_frames(), fresh->accumulated_frames()) << estimator;
  }
}

TEST_F(AuthoredTest, ScatteredRaysFindTheSameLightOfSuchLamps) {
  scene::FrameSnapshot snapshot = lamp_room(vec3(64, 20, 10), 24.0f);
  scene::Instance& lamp = snapshot.instances.back();
  lamp.flags = scene::kInstanceColor | scene::kInstanceSpot | shared::kFallLinear << scene::kInstanceFallShift;
  lamp.color = vec3(0.0f, 0.5f, 1.0f / 80.0f);  // a spot besides
  const auto mean = [&](const char* estimator) {
    RenderSettings s = plain_settings(estimator, 2);
    auto renderer = make_renderer(s, 24, 16);
    double sum = 0;
    for (int frame = 0; frame < 128; ++frame) {
      snapshot.frame = static_cast<std::uint32_t>(frame);
      renderer->render(snapshot, nullptr, s);
      for (const vec4& p : renderer->read().linear()) sum += static_cast<double>(p.x);
    }
    return sum;
  };
  const double looked_for = mean("nee");
  EXPECT_GT(looked_for, 0.0);
  EXPECT_NEAR(mean("pt") / looked_for, 1.0, 0.05);
}

TEST_F(AuthoredTest, ASkyMayShineUnseen) {
  RenderSettings s = plain_settings("pt", 1);
  scene::FrameSnapshot snapshot = scene::furnace(0.5f, 0.0f);
  snapshot.instances.clear();  // nothing but the sky
  snapshot.sky.mode = scene::SkyMode::kConstant;
  snapshot.sky.color = vec3(0.125f);
  snapshot.sky.even = vec3(3.0f);
  snapshot.sky.beyond_everything = true;
  auto renderer = make_renderer(s, 24, 16);
  renderer->render(snapshot, nullptr, s);
  for (const vec4& p : renderer->read().linear()) ASSERT_NEAR(p.x, 0.125f, 1e-6f);
}

TEST_F(AuthoredTest, AnInstancesEvenLightIsReflectedByItAlone) {
  RenderSettings s = plain_settings("pt", 1);
  scene::FrameSnapshot snapshot = scene::furnace(0.5f, 0.0f);
  auto renderer = make_renderer(s, 24, 16);
  const auto mean = [&] {
    renderer->render(snapshot, nullptr, s);
    vec3 sum(0.0f);
    const auto image = renderer->read().linear();
    for (const vec4& p : image) sum += vec3(p) / static_cast<float>(image.size());
    return sum;
  };
  EXPECT_EQ(mean(), vec3(0.0f));
  for (scene::Instance& instance : snapshot.instances) instance.emission = vec3(0.5f, 1.0f, 0.0f);
  const vec3 lit = mean();  // albedo times it, once: nothing of it is traced
  EXPECT_NEAR(lit.x, 0.25f, 1e-5f);
  EXPECT_NEAR(lit.y, 0.5f, 1e-5f);
  EXPECT_EQ(lit.z, 0.0f);
}

// A wall across the view, a face of two luxels in each of two styles.
scene::FrameSnapshot baked_wall() {
  auto assets = scene::new_code_assets();
  const std::uint32_t wall = scene::add_material(*assets, "wall", vec3(0.25f, 0.5f, 0.1f), vec3(0.0f));
  scene::Mesh mesh;
  scene::add_quad(mesh, {100, -200, 200}, {0, 400, 0}, {0, 0, -400}, wall);
  for (scene::MeshTriangle& t : mesh.triangles) t.face = 0;
  std::vector<std::uint32_t> words(shared::kBakedFaceWords, 0u);
  words[shared::kBakedAxes + 1] = std::bit_cast<std::uint32_t>(0.02f);  // y from -25 to 25
  words[shared::kBakedAxes + 3] = std::bit_cast<std::uint32_t>(0.5f);
  words[shared::kBakedSize] = 2u | 1u << 16u;
  words[shared::kBakedFirst] = shared::kBakedFaceWords;
  words[shared::kBakedStyles] = 0xffff0500u;  // 0 and 5
  for (const std::uint32_t luxel : {0x204080u, 0x808080u, 0x404040u, 0x404040u}) words.push_back(luxel);
  scene::Image image{"words", scene::ImageEncoding::kWords, static_cast<int>(words.size()), 1, {}};
  for (const std::uint32_t word : words)
    for (int byte = 0; byte < 4; ++byte) image.texels.push_back(static_cast<std::uint8_t>(word >> (8 * byte)));
  assets->images.push_back(std::move(image));
  scene::FrameSnapshot snapshot = scene::still(assets, scene::camera_at(vec3(0.0f), vec3(0.0f), 60.0f));
  snapshot.baked.image = static_cast<std::uint32_t>(assets->images.size() - 1);
  snapshot.baked.faces = 1;
  snapshot.baked.styles[0] = 1.0f;
  snapshot.baked.styles[5] = 0.5f;
  snapshot.instances.push_back(
      scene::make_instance(scene::kIdWorld, scene::add_finished(*assets, std::move(mesh), "wall")));
  return snapshot;
}

TEST_F(AuthoredTest, TheViewOfBakedLightIsPaintTimesLuxelsAsDisplaysHaveThem) {
  RenderSettings s = plain_settings("pt", 1);
  s.debug_view = shared::kViewAuthored;
  auto renderer = make_renderer(s, 32, 18);
  scene::FrameSnapshot snapshot = baked_wall();
  const auto expect_picture = [&](bool baked) {
    renderer->render(snapshot, nullptr, s);
    const auto picture = renderer->read().output();
    const auto gbuffer = renderer->read().gbuffer();
    const vec3 painted = shared::srgb_from_linear(vec3(0.25f, 0.5f, 0.1f));
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const float f = std::clamp(gbuffer[i].position_t.y * 0.02f + 0.5f, 0.0f, 1.0f);
      vec3 light = glm::mix(vec3(0x80, 0x40, 0x20), vec3(0x80), f) / 128.0f + 0.5f * vec3(0x40) / 128.0f;
      if (!baked) light = vec3(1.0f);
      for (int c = 0; c < 3; ++c) {
        const auto byte = static_cast<float>(picture[i] >> (8 * c) & 255u);
        ASSERT_NEAR(byte, 255.0f * std::min(painted[c] * light[c], 1.0f), 0.6f) << i << " channel " << c;
      }
    }
  };
  expect_picture(true);
  snapshot.baked = {};
  ++snapshot.frame;
  expect_picture(false);
}

// Under a sky that is the same everywhere each sample is the sky's light, so that all of the denoiser's blending shows.
class BakedPastTest : public DeviceTest {
 protected:
  static constexpr float kSky = 0.5f, kAlbedo = 0.5f;  // of green
  static constexpr int kFirst = 4;

  BakedPastTest() {
    settings_ = plain_settings("pt", 1);
    settings_.denoise = 1;
    settings_.taa = 0;
    settings_.light_scale = 1;
    settings_.first_spp = kFirst;
    settings_.accumulate = 0;
    snapshot_ = baked_wall();
    snapshot_.authored = true;
    snapshot_.baked.styles[5] = 0.0f;
    snapshot_.sky.mode = scene::SkyMode::kConstant;
    snapshot_.sky.color = vec3(kSky);
    snapshot_.sky.beyond_everything = true;
  }

  void draw(Renderer& renderer, int frame) {
    snapshot_.frame = static_cast<std::uint64_t>(frame);
    snapshot_.prev_time = (frame - 1) / 60.0;
    snapshot_.time = frame / 60.0;
    renderer.render(snapshot_, nullptr, settings_);
  }
  static constexpr std::uint32_t kWidth = 64, kHeight = 18, kTilesX = 4, kTilesY = 2;
  struct Seen {
    float light, first;  // as it is shown, and as a frame without a past begins
  };
  // Of each pixel whose neighbours have the same baked light.
  std::vector<Seen> seen(const Renderer& renderer, float gain = 1.0f) const {
    const auto picture = renderer.read().denoised();
    const auto gbuffer = renderer.read().gbuffer();
    std::vector<float> across;
    std::vector<vec3> baked;
    std::vector<shared::BakedSums> tiles(kTilesX * kTilesY);
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
      across.push_back(gbuffer[i].position_t.y * 0.02f + 0.5f);
      const vec3 luxels = glm::mix(vec3(0x80, 0x40, 0x20), vec3(0x80), std::clamp(across[i], 0.0f, 1.0f)) / 128.0f;
      baked.push_back(shared::baked_irradiance(luxels, vec3(gain), snapshot_.ambient));
      shared::BakedSums& tile = tiles[i / kWidth / shared::kChangeTile * kTilesX + i % kWidth / shared::kChangeTile];
      tile.samples += kSky;
      tile.baked += luminance(vec4(baked[i], 1.0f));
      tile.squares += kSky * kSky;
    }
    const float share = kFirst / (kFirst + settings_.baked_past);
    std::vector<Seen> result;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
      if (across[i] >= 0.0f && across[i] <= 1.0f) continue;
      const vec2 place = (vec2(i % kWidth, i / kWidth) + 0.5f) / static_cast<float>(shared::kChangeTile) - 0.5f;
      shared::BakedSums sums{};
      for (std::uint32_t t = 0; t < tiles.size(); ++t) {
        const vec2 near = glm::max(1.5f - glm::abs(vec2(t % kTilesX, t / kTilesX) - place), vec2(0.0f));
        sums.samples += near.x * near.y * tiles[t].samples;
        sums.baked += near.x * near.y * tiles[t].baked;
        sums.squares += near.x * near.y * tiles[t].squares;
      }
      const float past = baked[i].y * shared::baked_factor(sums);
      result.push_back({picture[i].y / (kAlbedo * gain) - snapshot_.ambient.y, glm::mix(past, kSky, share)});
    }
    return result;
  }
  void expect_first(Renderer& renderer, int frame, float gain = 1.0f) {
    draw(renderer, frame);
    float least = 1e9f, most = 0.0f;
    for (const Seen& p : seen(renderer, gain)) {
      ASSERT_NEAR(p.light / p.first, 1.0f, 0.03f);
      least = std::min(least, p.light);
      most = std::max(most, p.light);
    }
    EXPECT_GT(most, 1.1f * least) << "there is something to see";
  }

  RenderSettings settings_;
  scene::FrameSnapshot snapshot_;
};

TEST_F(BakedPastTest, AFrameWithoutAPastBeginsWithBakedLight) {
  ASSERT_GT(settings_.baked_past, 0.0f);
  auto renderer = make_renderer(settings_, kWidth, kHeight);
  expect_first(*renderer, 0);
  float before = 1.0f;  // of the difference
  for (int frame = 1; frame < 96; ++frame) {
    draw(*renderer, frame);
    float most = 0.0f, begins = 0.0f;
    for (const Seen& p : seen(*renderer)) {
      most = std::max(most, std::abs(p.light - kSky));
      begins = std::max(begins, std::abs(p.first - kSky));
    }
    EXPECT_LT(most / begins, before + 0.02f) << "frame " << frame;
    if (frame == 2) {
      EXPECT_GT(most / begins, 0.5f) << "it does not go at once";
    }
    before = most / begins;
  }
  EXPECT_LT(before, 0.1f);
  snapshot_.cut = true;
  expect_first(*renderer, 96);
}

TEST_F(BakedPastTest, OnlyWhereLightsAreFittedToItAndItIsAskedFor) {
  const auto raw = [&] {
    auto renderer = make_renderer(settings_, kWidth, kHeight);
    renderer->render(snapshot_, nullptr, settings_);
    return renderer->read().linear();
  };
  const auto with = raw();
  const auto expect_none = [&] {
    auto renderer = make_renderer(settings_, kWidth, kHeight);
    draw(*renderer, 0);
    for (const Seen& p : seen(*renderer)) ASSERT_NEAR(p.light, kSky, 0.01f);
  };
  snapshot_.authored = false;
  expect_none();
  snapshot_.authored = true;
  settings_.baked_past = 0;
  expect_none();
  EXPECT_EQ(raw(), with) << "the raw mean has nothing of it";
}

TEST_F(BakedPastTest, EvenLightAndGainsAreTakenOff) {
  snapshot_.ambient = vec3(0.1f);
  add_gain(snapshot_, vec3(0.5f));
  auto renderer = make_renderer(settings_, kWidth, kHeight);
  expect_first(*renderer, 0, 0.5f);
}

TEST(BakedFactor, SamplesTellItAsFarAsTheirNoiseLets) {
  const shared::BakedSums sure{200.0f, 100.0f, 200.0f * 200.0f / 1e6f};
  EXPECT_NEAR(shared::baked_factor(sure), 2.0f, 1e-2f);
  const shared::BakedSums noisy{200.0f, 100.0f, 200.0f * 200.0f};
  EXPECT_NEAR(shared::baked_factor(noisy), 1.0f, 0.05f);
  EXPECT_EQ(shared::baked_factor({0.0f, 100.0f, 0.0f}), 1.0f);
  EXPECT_EQ(shared::baked_factor({100.0f, 0.0f, 1.0f}), 1.0f);
  EXPECT_LE(shared::baked_factor({1e6f, 1.0f, 1.0f}), shared::kMostBakedFactor);
}

}  // namespace
}  // namespace fb::render
