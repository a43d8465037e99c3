// The whole renderer on scenes made in code: closed forms, motion, determinism, agreement of the two intersectors.
#include "render/renderer.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/hash.h"
#include "render/picture/frame_constants.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_motion.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

using RendererTest = DeviceTest;

RenderSettings settings_for(Intersector intersector, int spp, int bounces) {
  RenderSettings s;
  s.intersector = intersector;
  s.spp = spp;
  s.bounces = bounces;
  return s;
}

TEST_F(RendererTest, FurnaceGivesItsClosedForm) {
  for (const Intersector intersector : intersectors()) {
    for (const bool objects : {false, true}) {
      for (const float albedo : {0.3f, 0.9f}) {
        const float emission = 0.7f;
        auto renderer = make_renderer(settings_for(intersector, 4, 2), 96, 64);
        renderer->render(scene::furnace(albedo, emission, objects), nullptr, settings_for(intersector, 4, 2));
        const ImageEstimate e = image_estimate(renderer->read().linear());
        const double expected = emission * (1.0 + albedo + albedo * albedo);
        // Every path has the same value, so the spread comes from lost rays alone: 4.5 sigma and rounding.
        EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 4e-6 * expected)
            << renderer->intersector_name() << objects << albedo;
        EXPECT_LT(e.error, 1e-3 * expected);
        EXPECT_EQ(renderer->read().counters().not_finite, 0u);
      }
    }
  }
}

TEST_F(RendererTest, SamplesThatAreNotFiniteAreCountedAndShown) {
  RenderSettings s = settings_for(Intersector::kBvh, 2, 1);
  s.debug_view = 30;
  s.fxaa = 0;
  for (const bool lost : {false, true}) {
    auto renderer = make_renderer(s, 16, 16);
    renderer->render(scene::furnace(0.5f, lost ? std::numeric_limits<float>::infinity() : 1.0f), nullptr, s);
    EXPECT_EQ(renderer->read().counters().not_finite, lost ? 16u * 16u * 2u : 0u);
    for (const std::uint32_t pixel : renderer->read().output()) {
      const std::uint32_t red = pixel & 255u, green = (pixel >> 8) & 255u;
      ASSERT_EQ(lost, red == 255u && green == 0u) << red << ' ' << green;
    }
  }
}

TEST_F(RendererTest, BouncesAreCounted) {
  const float albedo = 0.8f;
  for (int bounces = 0; bounces <= 5; ++bounces) {
    auto renderer = make_renderer(settings_for(Intersector::kBvh, 1, bounces), 16, 16);
    renderer->render(scene::furnace(albedo, 1.0f), nullptr, settings_for(Intersector::kBvh, 1, bounces));
    double expected = 0;
    for (int k = 0; k <= bounces; ++k) expected += std::pow(albedo, k);
    EXPECT_NEAR(image_estimate(renderer->read().linear()).mean, expected, 1e-4 * expected) << bounces;
  }
}

TEST_F(RendererTest, OneLightLightsTheFloorAsTheFormulaSays) {
  const float radius = 24, radiance = 50, albedo = 0.5f;
  scene::FrameSnapshot snapshot = scene::one_light(radius, radiance, albedo);
  // Straight at the floor's middle, a narrow view: every pixel sees nearly the same irradiance.
  snapshot.camera.position = {60, 0, -100};
  const vec3 target(0, 0, -128);
  const vec3 d = glm::normalize(target - snapshot.camera.position);
  snapshot.camera.angles = {degrees(std::asin(-d.z)), degrees(std::atan2(d.y, d.x)), 0};
  snapshot.camera.fov_x = 2;
  snapshot.prev_camera = snapshot.camera;
  const RenderSettings s = settings_for(Intersector::kBvh, 256, 1);
  auto renderer = make_renderer(s, 48, 48);
  renderer->render(snapshot, nullptr, s);
  const ImageEstimate e = image_estimate(renderer->read().linear());
  const double distance = 128, expected = albedo * radiance * radius * radius / (distance * distance);
  // 2%: the mesh of 80 triangles stands for the sphere only on average over its orientations.
  EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 0.02 * expected);
}

TEST_F(RendererTest, HolesLetTheWallShine) {
  for (const Intersector intersector : intersectors()) {
    RenderSettings s = settings_for(intersector, 1, 0);
    s.jitter = 1;
    auto renderer = make_renderer(s, 128, 128);
    renderer->render(scene::alpha_panel(), nullptr, s);
    std::size_t bright = 0, dark = 0;
    for (const vec4& p : renderer->read().linear()) (p.x > 0 ? bright : dark) += 1;
    EXPECT_GT(bright, 1000u) << renderer->intersector_name();
    EXPECT_GT(dark, 1000u) << renderer->intersector_name();
  }
}

// Panes in one place: each stops its share of the rays, an opaque one among them the rest, in whatever order they are
// found.
TEST_F(RendererTest, PanesInOnePlaceAllHaveTheirTurn) {
  scene::FrameSnapshot snapshot = scene::alpha_panel();
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  const std::uint32_t wall = 0, black = 1;
  assets->materials[black].frames.clear();
  assets->materials[black].flags = 0;
  const auto add_square = [&](float x, float half, std::uint32_t material) {
    scene::Mesh mesh;
    scene::add_quad(mesh, {x, -half, -half}, {0, 0, 2 * half}, {0, 2 * half, 0}, material);
    scene::finish_mesh(mesh);
    assets->meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(assets->meshes.size() - 1);
  };
  scene::Instance instance = snapshot.instances.at(0);
  instance.mesh = add_square(200, 400, wall);
  snapshot.instances = {instance};
  instance.mesh = add_square(100, 400, black);
  snapshot.assets = assets;
  for (const std::vector<float>& alphas : {std::vector<float>{0.5f}, {0.5f, 0.5f, 0.5f}, {0.3f, 1.0f, 0.3f}}) {
    snapshot.instances.resize(1);
    double passed = 1;
    for (const float alpha : alphas) {
      instance.alpha = alpha;
      instance.id = static_cast<std::uint32_t>(100 + snapshot.instances.size());
      snapshot.instances.push_back(instance);
      passed *= 1.0 - static_cast<double>(alpha);
    }
    for (const Intersector intersector : intersectors()) {
      const RenderSettings s = settings_for(intersector, 1, 0);
      auto renderer = make_renderer(s, 128, 128);
      renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, passed, 4.5 * e.error) << renderer->intersector_name() << ' ' << alphas.size();
    }
  }
}

TEST_F(RendererTest, TexelsHaveTheirPaletteColours) {
  const RenderSettings s = settings_for(Intersector::kBvh, 1, 1);
  auto renderer = make_renderer(s, 160, 160);
  renderer->render(scene::textured_quad(), nullptr, s);
  const auto image = renderer->read().linear();
  const auto gbuffer = renderer->read().gbuffer();
  const auto linear = [](int c) {
    const double x = c / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const formats::Palette palette = scene::code_palette();
  std::vector<bool> seen(256, false);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (gbuffer[i].position_t.w == 0) continue;
    // Sky of radiance 1 all around: radiance is the albedo. It must be one of the palette's colours.
    const vec4& albedo = gbuffer[i].albedo_roughness;
    EXPECT_NEAR(image[i].x, albedo.x, 1e-4);
    bool found = false;
    for (std::size_t k = 0; k < 256 && !found; ++k) {
      found = std::abs(albedo.x - linear(palette.rgb[k][0])) < 1e-4 &&
              std::abs(albedo.y - linear(palette.rgb[k][1])) < 1e-4 &&
              std::abs(albedo.z - linear(palette.rgb[k][2])) < 1e-4;
      if (found) seen[k] = true;
    }
    ASSERT_TRUE(found) << albedo.x << ' ' << albedo.y << ' ' << albedo.z;
  }
  EXPECT_GE(std::count(seen.begin(), seen.end(), true), 250);
}

TEST_F(RendererTest, ColoursOfFourBytesAreThoseOfThePalette) {
  const RenderSettings s = settings_for(Intersector::kBvh, 1, 1);
  auto renderer = make_renderer(s, 160, 160);
  scene::FrameSnapshot snapshot = scene::textured_quad();
  renderer->render(snapshot, nullptr, s);
  const auto indexed = renderer->read().gbuffer();
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  int changed = 0;
  for (scene::Image& image : assets->images) {
    if (image.encoding != scene::ImageEncoding::kPalette) continue;
    std::vector<std::uint8_t> texels;
    for (const std::uint8_t index : image.texels) {
      const auto& c = assets->palette.rgb[index];
      texels.insert(texels.end(), {c[0], c[1], c[2], 255});
    }
    image.texels = std::move(texels);
    image.encoding = scene::ImageEncoding::kSrgba;
    ++changed;
  }
  ASSERT_GT(changed, 0);
  snapshot.assets = assets;
  renderer->render(snapshot, nullptr, s);
  const auto colored = renderer->read().gbuffer();
  ASSERT_EQ(indexed.size(), colored.size());
  for (std::size_t i = 0; i < indexed.size(); ++i)
    ASSERT_EQ(indexed[i].albedo_roughness, colored[i].albedo_roughness) << i;
}

// --- motion ---

TEST_F(RendererTest, MotionCarriesPointsToWhereTheyWere) {
  const auto assets = scene::moving_assets();
  for (const Intersector intersector : intersectors()) {
    const RenderSettings s = settings_for(intersector, 1, 0);
    auto renderer = make_renderer(s, 320, 180);
    const double dt = 1.0 / 60;
    for (int frame = 1; frame <= 3; ++frame) {
      const scene::FrameSnapshot snapshot = scene::moving(assets, frame * dt, (frame - 1) * dt);
      renderer->render(snapshot, nullptr, s);
      auto checked = test::check_motion(snapshot, *renderer);
      EXPECT_GT(checked[scene::kMovingBox], 50);
      EXPECT_GT(checked[scene::kMovingPosed], 50);
      EXPECT_GT(checked[scene::kMovingViewModel], 50);
    }
  }
}

// --- repetition and agreement ---

TEST_F(RendererTest, TheSameSeedGivesTheSameBitsAndAnotherSeedDoesNot) {
  RenderSettings s = settings_for(Intersector::kBvh, 2, 2);
  const scene::FrameSnapshot snapshot = scene::cornell_box(scene::CornellVariant::kGlossy);
  std::vector<std::uint64_t> hashes;
  for (int run = 0; run < 3; ++run) {
    s.seed = run == 2 ? 7 : 0;
    auto renderer = make_renderer(s, 64, 64);
    renderer->render(snapshot, nullptr, s);
    hashes.push_back(image_hash(*renderer));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(hashes[0], hashes[2]);
}

TEST_F(RendererTest, AccumulatingNarrowsTheMeanAndAChangeStartsAnew) {
  const RenderSettings s = settings_for(Intersector::kBvh, 1, 2);
  scene::FrameSnapshot snapshot = scene::cornell_box();
  auto renderer = make_renderer(s, 64, 64);
  double early = 0;
  for (int i = 0; i < 64; ++i) {
    renderer->render(snapshot, nullptr, s);
    if (i == 7) early = image_estimate(renderer->read().variance_of_mean()).mean;
  }
  EXPECT_EQ(renderer->accumulated_frames(), 64u);
  const double late = image_estimate(renderer->read().variance_of_mean()).mean;
  EXPECT_LT(late, early * 0.35) << "eight times the frames, an eighth of the variance, give or take";
  snapshot.camera.position.x += 1;
  renderer->render(snapshot, nullptr, s);
  EXPECT_EQ(renderer->accumulated_frames(), 1u);
}

TEST_F(RendererTest, ArraysGiveTheSameBitsBoundAndByAddress) {
  if (!device_->has_addresses()) GTEST_SKIP() << device_->report().name << " has no buffer device addresses";
  std::vector<std::vector<vec4>> pictures;
  for (const ArrayAccess arrays : {ArrayAccess::kBound, ArrayAccess::kAddress}) {
    RenderSettings s = settings_for(Intersector::kBvh, 1, 2);
    s.estimator = "mcpg";
    s.deterministic = 1;
    s.arrays = arrays;
    auto renderer = make_renderer(s, 64, 64);
    for (int frame = 0; frame < 3; ++frame) renderer->render(scene::many_lights(20), nullptr, s);
    pictures.push_back(renderer->read().linear());
  }
  EXPECT_EQ(pictures[0], pictures[1]);
}

// Many lights, and holes, of which hits must be asked.
TEST_F(RendererTest, LanesOfAGpuGiveTheSameBitsAsAProcessors) {
  for (const char* estimator : {"nee", "mcpg"}) {
    for (const scene::FrameSnapshot& snapshot : {scene::many_lights(200), scene::alpha_panel()}) {
      std::vector<std::vector<vec4>> pictures;
      for (const Lanes lanes : {Lanes::kProcessor, Lanes::kGpu}) {
        RenderSettings s = settings_for(Intersector::kBvh, 1, 2);
        s.estimator = estimator;
        s.deterministic = 1;
        s.lanes = lanes;
        auto renderer = make_renderer(s, 64, 64);
        for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
        pictures.push_back(renderer->read().linear());
      }
      EXPECT_EQ(pictures[0], pictures[1]) << estimator;
    }
  }
}

TEST_F(RendererTest, IntersectorsAgree) {
  if (!device_->has_ray_query()) GTEST_SKIP() << device_->report().name << " has no ray query";
  for (const int fast_build : {0, 1}) {
    for (const auto& snapshot : {scene::cornell_box(scene::CornellVariant::kGlossy), scene::many_lights(100)}) {
      std::vector<std::vector<shared::GBufferTexel>> hits;
      std::vector<std::vector<vec4>> means, variances;
      for (const Intersector intersector : {Intersector::kBvh, Intersector::kQuery}) {
        RenderSettings s = settings_for(intersector, 4, 2);
        s.jitter = 0;
        s.fast_build = fast_build;
        s.seed = intersector == Intersector::kQuery ? 1 : 0;  // independent, as the z-test wants
        auto renderer = make_renderer(s, 128, 128);
        for (int frame = 0; frame < 32; ++frame) renderer->render(snapshot, nullptr, s);
        hits.push_back(renderer->read().gbuffer());
        means.push_back(renderer->read().linear());
        variances.push_back(renderer->read().variance_of_mean());
      }
      std::size_t different = 0;
      for (std::size_t i = 0; i < hits[0].size(); ++i) {
        const auto &a = hits[0][i], &b = hits[1][i];
        different += a.id != b.id || std::abs(a.position_t.w - b.position_t.w) > 1e-3f * (1 + a.position_t.w);
      }
      EXPECT_LT(static_cast<double>(different), std::max(2.0, 1e-4 * static_cast<double>(hits[0].size())));
      // z-test over blocks of 16x16 pixels, Bonferroni over 64 blocks at a false-alarm rate of 1e-4: |z| < 4.95.
      for (std::size_t by = 0; by < 8; ++by) {
        for (std::size_t bx = 0; bx < 8; ++bx) {
          double difference = 0, variance = 0;
          for (std::size_t y = by * 16; y < by * 16 + 16; ++y) {
            for (std::size_t x = bx * 16; x < bx * 16 + 16; ++x) {
              const std::size_t i = y * 128 + x;
              difference += means[0][i].x - means[1][i].x;
              variance += variances[0][i].x + variances[1][i].x;
            }
          }
          EXPECT_LT(std::abs(difference), 4.95 * std::sqrt(variance) + 1e-3) << "block " << bx << ',' << by;
        }
      }
    }
  }
}

TEST_F(RendererTest, EmptySnapshotsAreBlackAndEveryDebugViewDraws) {
  RenderSettings s;
  auto renderer = make_renderer(s, 65, 37);
  renderer->render(scene::FrameSnapshot{}, nullptr, s);
  for (const vec4& p : renderer->read().linear()) EXPECT_EQ(p.x, 0);
  // Smooth and flat surfaces, several materials, motion: all that views show.
  const scene::FrameSnapshot snapshot = scene::moving(scene::moving_assets(), 0.1, 0.0);
  std::vector<std::uint64_t> pictures;
  for (int view = 0; view <= 11; ++view) {
    s.debug_view = view;
    renderer->render(snapshot, nullptr, s);
    renderer->render(snapshot, nullptr, s);
    const auto pixels = renderer->read().output();
    pictures.push_back(hash_span(std::span<const std::uint32_t>(pixels)));
  }
  std::sort(pictures.begin(), pictures.end());
  EXPECT_EQ(std::unique(pictures.begin(), pictures.end()), pictures.end()) << "no two views are the same";
}

// The former frame's G-buffer holds what that frame saw: where it stands still, the same; nothing after a cut.
TEST_F(RendererTest, TheFormerGBufferIsTheFormerFrames) {
  constexpr int kFormer = shared::kViewFormer, kAlbedo = shared::kViewAlbedo;
  RenderSettings s;
  s.jitter = 0;
  s.fxaa = 0;
  const auto assets = scene::moving_assets();
  const auto frame = [&](Renderer& renderer, double step, int number, int view, bool cut) {
    scene::FrameSnapshot snapshot = scene::moving(assets, number * step, (number - 1) * step);
    snapshot.frame = static_cast<std::uint64_t>(number);
    snapshot.cut = cut;
    s.debug_view = view;
    renderer.render(snapshot, nullptr, s);
    return renderer.read().output();
  };
  const auto is_red = [](std::uint32_t pixel) { return (pixel & 0xffffffu) == 0xffu; };
  for (const double step : {0.0, 0.05}) {
    auto renderer = make_renderer(s, 96, 54);
    for (const std::uint32_t pixel : frame(*renderer, step, 1, kFormer, false))
      ASSERT_EQ(pixel & 0xffffffu, 0u) << "there was no frame before";
    const auto former = frame(*renderer, step, 2, kFormer, false);
    const auto albedo = frame(*renderer, step, 2, kAlbedo, false);
    std::size_t same = 0, unknown = 0;
    for (std::size_t i = 0; i < former.size(); ++i) {
      same += former[i] == albedo[i];
      unknown += is_red(former[i]);
    }
    if (step == 0.0) {
      EXPECT_EQ(same, former.size());
    } else {
      EXPECT_GT(same, former.size() * 8 / 10);
      EXPECT_GT(unknown, 0u) << "the box uncovers something";
      EXPECT_LT(unknown, former.size() / 10);
    }
    frame(*renderer, step, 2, kFormer, false);  // remembered again from here
    for (const std::uint32_t pixel : frame(*renderer, step, 3, kFormer, true)) ASSERT_EQ(pixel & 0xffffffu, 0u);
  }
}

TEST_F(RendererTest, DrawsQuadsInOrderOverThePicture) {
  RenderSettings s;
  auto renderer = make_renderer(s, 100, 50);
  auto atlas = std::make_shared<scene::DrawAtlas>();
  atlas->width = 2;
  atlas->height = 1;
  atlas->texels = {0xff0000ffu, 0x00000000u};  // red; clear
  scene::DrawList list;
  list.atlas = atlas;
  list.quads.push_back({{10, 10}, {90, 40}, {0, 0}, {0, 0}, {0, 1, 0, 1}});  // green
  list.quads.push_back({{20, 20}, {40, 30}, {0, 0}, {2, 1}, {1, 1, 1, 1}});  // left half red, right half clear
  renderer->render(scene::FrameSnapshot{}, &list, s);
  const auto pixels = renderer->read().output();
  const auto at = [&](std::size_t x, std::size_t y) { return pixels[y * 100 + x] & 0xffffffu; };
  EXPECT_EQ(at(5, 5), 0u);
  EXPECT_EQ(at(15, 15), 0x00ff00u);
  EXPECT_EQ(at(25, 25), 0x0000ffu);
  EXPECT_EQ(at(35, 25), 0x00ff00u);
  EXPECT_EQ(at(89, 39), 0x00ff00u);
  EXPECT_EQ(at(90, 39), 0u);
}

TEST_F(RendererTest, APictureHasItsPlaceInTheOutput) {
  const uvec2 output(72, 48);
  scene::FrameSnapshot snapshot = scene::furnace(0.3f, 0.7f, true);
  scene::DrawList list;
  list.picture = {{10, 6}, {40, 24}};
  for (const float scale : {1.0f, 0.5f}) {
    RenderSettings s = settings_for(Intersector::kBvh, 2, 1);
    s.denoise = s.taa = 1;
    s.scale = scale;
    auto alone = make_renderer(s, list.picture.size.x, list.picture.size.y);
    auto placed = make_renderer(s, output.x, output.y);
    for (snapshot.frame = 1; snapshot.frame < 4; ++snapshot.frame) {
      alone->render(snapshot, nullptr, s);
      placed->render(snapshot, &list, s);
    }
    const auto wanted = alone->read().output(), shown = placed->read().output();
    ASSERT_EQ(shown.size(), std::size_t{72} * 48);
    std::size_t outside = 0, inside = 0;
    for (std::uint32_t y = 0; y < output.y; ++y)
      for (std::uint32_t x = 0; x < output.x; ++x) {
        const uvec2 at = uvec2(x, y) - list.picture.min;
        const bool in = at.x < list.picture.size.x && at.y < list.picture.size.y;
        const std::uint32_t is = shown[std::size_t{y} * output.x + x];
        const std::uint32_t expected = in ? wanted[std::size_t{at.y} * list.picture.size.x + at.x] : 0xff000000u;
        (in ? inside : outside) += is == expected;
      }
    EXPECT_EQ(inside, 40u * 24u) << scale;
    EXPECT_EQ(outside, 72u * 48u - 40u * 24u) << scale;
    placed->render(snapshot, nullptr, s);  // and everywhere again
    EXPECT_NE(placed->read().output()[0], 0xff000000u);
    list.picture.min = {60, 40};  // it ends where the output does
    placed->render(snapshot, &list, s);
    EXPECT_EQ(placed->read().output()[std::size_t{39} * output.x + 60], 0xff000000u);
    EXPECT_NE(placed->read().output().back(), 0xff000000u);
    list.picture.min = {10, 6};
  }
}

TEST_F(RendererTest, TintThenQuadsThenContrastAndGamma) {
  RenderSettings s;
  s.contrast = 1.5f;
  s.gamma = 0.5f;
  auto renderer = make_renderer(s, 16, 8);
  scene::DrawList list;
  list.atlas = std::make_shared<scene::DrawAtlas>(scene::DrawAtlas{1, 1, {0u}, 1});
  list.quads.push_back({{8, 0}, {16, 4}, {0, 0}, {0, 0}, {0.25f, 0.8f, 0, 1}});
  scene::FrameSnapshot dark;
  dark.screen_tint = vec4(1.0f, 0.5f, 0.0f, 0.4f);  // over black
  renderer->render(dark, &list, s);
  const auto pixels = renderer->read().output();
  const auto level = [](float color) { return std::round(255.0f * std::sqrt(std::min(1.0f, 1.5f * color))); };
  const auto expect = [&](std::size_t x, float red, float green) {
    EXPECT_NEAR(static_cast<float>(pixels[x] & 255u), level(red), 1.0f) << x;
    EXPECT_NEAR(static_cast<float>(pixels[x] >> 8u & 255u), level(green), 1.0f) << x;
  };
  expect(2, 0.4f, 0.2f);
  expect(12, 0.25f, 0.8f);
  renderer->render(dark, &list, RenderSettings{});
  const auto plain = renderer->read().output();
  EXPECT_EQ(plain[2] & 255u, 102u);
  EXPECT_EQ(plain[12] & 255u, 64u);
}

// Of two samples x1 and x2 the variance of their mean is (x1 - x2)^2 / 4; of one nothing is known.
TEST_F(RendererTest, VarianceOfTheMeanOfTwoFrames) {
  RenderSettings s;
  s.estimator = "pt";
  s.jitter = 0;
  auto renderer = make_renderer(s, 32, 24);
  const scene::FrameSnapshot scene = scene::cornell_box();
  renderer->render(scene, nullptr, s);
  const std::vector<vec4> first = renderer->read().linear();
  for (const vec4& v : renderer->read().variance_of_mean()) ASSERT_EQ(v.x, 0.0f);
  renderer->render(scene, nullptr, s);
  const std::vector<vec4> mean = renderer->read().linear(), variance = renderer->read().variance_of_mean();
  double sum = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const float step = first[i].x - mean[i].x;  // half of x1 - x2
    ASSERT_NEAR(variance[i].x, step * step, 1e-4f * (step * step + mean[i].x * mean[i].x)) << i;
    sum += static_cast<double>(variance[i].x);
  }
  EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace fb::render
