// More than the device's buffers hold of each thing that a game can have too much of, on a device that allows one
// mebibyte: what is left out is said once, and the picture goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/log.h"
#include "render/renderer.h"
#include "render/scene/test_gpu_scene.h"

namespace fb::render {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr VkDeviceSize kMostBytes = 1u << 20;

class TooMuchTest : public GpuSceneTest {
 protected:
  void SetUp() override {
    GpuSceneTest::SetUp();
    if (IsSkipped()) return;
    gpu::DeviceOptions options;
    options.validation = true;
    options.most_buffer_bytes = kMostBytes;
    auto made = gpu::Device::create(options);
    ASSERT_TRUE(made.ok()) << made.error().message;
    small_ = std::move(*made);
    listener_ = add_log_listener([this](LogLevel level, std::string_view line) {
      if (level >= LogLevel::kWarning) said_.emplace_back(line);
    });
  }
  void TearDown() override {
    if (listener_ != 0) remove_log_listener(listener_);
    if (small_) {
      EXPECT_EQ(small_->validation_messages(), 0u);
    }
    GpuSceneTest::TearDown();
  }

  // Two frames of a scene by each intersector; `check` sees it after each.
  template <typename Check>
  void draw(const Case& c, bool wants_lights, Check check) {
    for (const GpuSceneOptions& way : ways()) {
      said_.clear();
      gpu::BindingTable table(*small_);
      GpuScene scene(*small_, table, way);
      EmissionScales scales;
      scales.fill(1.0f);
      for (int frame = 0; frame < 2; ++frame) {
        scene.prepare(c.snapshot, scales, wants_lights);
        scene.stage();
        small_->run([&](gpu::Commands& commands) {
          commands.bind(table);
          scene.record(commands);
        });
        check(scene);
      }
    }
  }
  std::vector<std::uint32_t> drawn_ids(GpuScene& scene) {
    std::vector<std::uint32_t> ids;
    for (const shared::GpuInstance& instance :
         gpu::read_now<shared::GpuInstance>(*small_, *scene.buffers().instances, scene.statistics().instances))
      ids.push_back(instance.id);
    return ids;
  }

  std::unique_ptr<gpu::Device> small_;
  std::vector<std::string> said_;
  int listener_ = 0;
};

mat4x3 at(float x) {
  mat4x3 m(1.0f);
  m[3] = vec3(x, 0, 0);
  return m;
}

TEST_F(TooMuchTest, TheFarthestModelsInSightAreNotDrawn) {
  Case c;
  Mesh room;
  scene::add_box(room, vec3(-64), vec3(64), 0, true);
  scene::finish_mesh(room);
  c.add(c.add_mesh(room));
  const std::uint32_t monster = c.add_mesh(posed_soup(300, 2, 1));
  constexpr std::uint32_t kMonsters = 200;
  for (std::uint32_t i = 1; i <= kMonsters; ++i)  // the nearest come last
    c.add(monster, at(1000.0f * static_cast<float>(kMonsters + 1 - i)));
  draw(c, false, [&](GpuScene& scene) {
    const std::vector<std::uint32_t> ids = drawn_ids(scene);
    ASSERT_GT(ids.size(), 10u);
    ASSERT_LT(ids.size(), kMonsters);
    EXPECT_EQ(ids.front(), 0u) << "the room is always there";
    EXPECT_EQ(*std::min_element(ids.begin() + 1, ids.end()), kMonsters + 2 - ids.size());
    EXPECT_EQ(ids.back(), kMonsters);
    EXPECT_THAT(said_, ElementsAre(HasSubstr("of 201 models and particles are not drawn, the farthest")));
  });
}

TEST_F(TooMuchTest, AMapTooLargeIsDrawnInPart) {
  Case c;
  Mesh map = soup(40000, 1000, 20, 2);
  map.name = "maps/huge.bsp";
  c.add(c.add_mesh(std::move(map)));
  c.add(c.add_mesh(posed_soup(50, 1, 3)), at(10));
  draw(c, false, [&](GpuScene& scene) {
    EXPECT_GT(scene.statistics().triangles, 5000u);
    EXPECT_LT(scene.statistics().triangles, 40000u);
    EXPECT_EQ(scene.statistics().instances, 2u) << "there is room for a monster";
    EXPECT_THAT(said_, ElementsAre(HasSubstr("maps/huge.bsp: not drawn whole")));
  });
}

// What fits is traced as ever.
TEST_F(TooMuchTest, WhatIsLeftOfAMapIsHit) {
  Case whole, left;
  whole.add(whole.add_mesh(soup(40000, 1000, 20, 2)));
  Mesh map = whole.assets->meshes[0];
  left.add(left.add_mesh(std::move(map)));
  const std::vector<ListRay> rays = random_rays(500, 900, 4);
  for (const GpuSceneOptions& way : ways()) {
    gpu::BindingTable table(*small_);
    GpuScene scene(*small_, table, way);
    scene.prepare(whole.snapshot, {});
    scene.stage();
    RayList list(*small_, way, false);
    list.load(whole.snapshot, rays);
    list.trace();
    left.assets->meshes[0].triangles.resize(scene.statistics().triangles);
    const Agreement found = expect_agreement(left, rays, list.hits(), false);
    EXPECT_GT(found.hits, rays.size() / 10);
    left.assets->meshes[0].triangles = whole.assets->meshes[0].triangles;
  }
}

TEST_F(TooMuchTest, ModelsWhosePosesDoNotFitStandStillOrAreNotDrawn) {
  Case c;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Mesh mesh = posed_soup(100, 300, 5 + i);  // 720,000 bytes of poses
    mesh.name = "progs/" + std::to_string(i) + ".mdl";
    c.add(c.add_mesh(std::move(mesh)), at(10.0f * static_cast<float>(i))).pose = {299, 298, 0.5f};
  }
  draw(c, false, [&](GpuScene& scene) {
    EXPECT_EQ(scene.statistics().posed_instances, 2u);
    EXPECT_THAT(said_, ElementsAre(HasSubstr("progs/1.mdl and 1 more: not drawn whole")));
  });
}

TEST_F(TooMuchTest, ImagesBeyondTheBufferAreOneTexel) {
  Case c;
  c.add(c.add_mesh(soup(20, 50, 20, 10)));
  for (int i = 0; i < 20; ++i)
    c.assets->images.push_back(
        {"big", scene::ImageEncoding::kSrgba, 256, 256, std::vector<std::uint8_t>(std::size_t{4} * 256 * 256, 255)});
  draw(c, false, [&](GpuScene&) { EXPECT_THAT(said_, ElementsAre(HasSubstr("16 images are shown as one texel"))); });
}

// The whole renderer, with everything at once.
TEST_F(TooMuchTest, APictureOfTooMuchIsDrawn) {
  Case c;
  c.assets->materials[0].emission_kind = scene::EmissionKind::kConstant;
  c.assets->materials[0].emission = vec3(1.0f);
  c.add(c.add_mesh(soup(40000, 1000, 20, 11)));
  const std::uint32_t monster = c.add_mesh(posed_soup(300, 2, 12));
  for (int i = 0; i < 300; ++i) c.add(monster, at(static_cast<float>(i)));
  scene::DrawList list;
  auto atlas = std::make_shared<scene::DrawAtlas>();
  atlas->width = atlas->height = 16;
  atlas->texels.assign(std::size_t{16} * 16, 0xffffffffu);
  list.atlas = atlas;
  // The red is at the bottom; the white above all is one of many.
  for (int i = 0; i < 60000; ++i) {
    const bool top = i == 59999;
    list.quads.push_back({vec2(0.0f), vec2(64.0f), vec2(0.0f), vec2(0.0f), top ? vec4(1.0f) : vec4(1, 0, 0, 1)});
  }
  RenderSettings settings = plain_settings("pt", 1);
  settings.host_present = 0;  // the host has room
  auto renderer = Renderer::create(*small_, settings);
  ASSERT_TRUE(renderer.ok()) << renderer.error().message;
  (*renderer)->resize(48, 32);
  for (int frame = 0; frame < 2; ++frame) (*renderer)->render(c.snapshot, &list, settings);
  const auto picture = (*renderer)->read().output();
  EXPECT_EQ(picture.size(), std::size_t{48} * 32);
  EXPECT_THAT(picture, Each(picture.front()));
  EXPECT_EQ(picture.front() & 0xffffffu, 0xffffffu) << "the top is there";
  EXPECT_THAT(said_, Contains(HasSubstr("pictures and letters over the game are not drawn")).Times(1));
}

}  // namespace
}  // namespace fb::render
