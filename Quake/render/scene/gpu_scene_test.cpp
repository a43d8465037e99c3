// Both intersectors against a brute-force one on the host: random triangles under transforms, interpolated poses,
// masks, alpha tests, zero, one and two thousand instances, changing scenes; and the boxes of the tree.
#include "render/scene/gpu_scene.h"

#include <gtest/gtest.h>

#include <utility>

#include "render/passes/settings.h"
#include "render/scene/test_gpu_scene.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

TEST_F(GpuSceneTest, FindsTheWorldsTriangles) {
  Case c;
  c.add(c.add_mesh(soup(3000, 500, 60, 1)));
  expect_all_agree(c, random_rays(3000, 500, 2));
}

TEST_F(GpuSceneTest, FindsTransformedInstancesBesideTheWorld) {
  Case c;
  Rng rng(3);
  c.add(c.add_mesh(soup(400, 600, 60, 4)));
  std::uint32_t mesh = c.add_mesh(soup(40, 50, 20, 5)), tiny = c.add_mesh(soup(1, 1, 20, 6));
  for (int i = 0; i < 40; ++i) c.add(i % 4 == 0 ? tiny : mesh, random_transform(rng, 500));
  expect_all_agree(c, random_rays(3000, 600, 7));
}

TEST_F(GpuSceneTest, FindsNothingInNothing) {
  Case c;
  for (const GpuSceneOptions& way : ways()) {
    for (const ListHit& hit : trace(c, random_rays(100, 10, 1), way)) EXPECT_EQ(hit.instance, shared::kNoIndex);
  }
}

TEST_F(GpuSceneTest, FindsOneInstanceAlone) {
  Case c;
  Rng rng(8);
  c.add(c.add_mesh(soup(60, 50, 40, 9)), random_transform(rng, 10));
  expect_all_agree(c, random_rays(1000, 60, 10));
}

TEST_F(GpuSceneTest, FindsTwoThousandInstances) {
  Case c;
  Rng rng(11);
  std::uint32_t mesh = c.add_mesh(soup(4, 6, 12, 12));
  for (int i = 0; i < 2000; ++i) c.add(mesh, random_transform(rng, 400));
  expect_all_agree(c, random_rays(1000, 400, 13));
}

// Long triangles across the whole scene, whose boxes overlap at every level of the tree: more subtrees wait than the
// traversal's stack holds, and those that fell out are found again.
TEST_F(GpuSceneTest, FindsWhatFellOutOfTheStack) {
  Case c;
  Rng rng(17);
  Mesh mesh;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const vec3 at = vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)) * 300.0f;
    const vec3 along = random_direction(rng) * 600.0f;
    for (const vec3& p : {at - along, at + along, at + random_direction(rng) * 120.0f}) mesh.positions.push_back(p);
    mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0, {}});
  }
  scene::finish_mesh(mesh);
  c.add(c.add_mesh(std::move(mesh)));
  expect_all_agree(c, random_rays(1500, 300, 18));
}

TEST_F(GpuSceneTest, SeesByMaskAlone) {
  Case c;
  Rng rng(14);
  std::uint32_t mesh = c.add_mesh(soup(60, 100, 60, 15));
  const std::uint32_t seen[]{scene::kSeenByAll, scene::kSeenByCamera, scene::kSeenByIndirect};
  for (int i = 0; i < 12; ++i) c.add(mesh, i < 3 ? mat4x3(1.0f) : random_transform(rng, 80)).visibility = seen[i % 3];
  for (std::uint32_t mask : seen) expect_all_agree(c, random_rays(500, 150, 16, mask));
}

TEST_F(GpuSceneTest, AsksOnlyAlphaTestedAndTranslucent) {
  Case c;
  c.assets->materials.resize(3);
  c.assets->materials[1].flags = scene::kMaterialAlphaTest;
  c.assets->materials[2].alpha = 0.5f;
  Mesh world = soup(1500, 300, 60, 17);
  for (std::size_t i = 0; i < world.triangles.size(); ++i)
    world.triangles[i].material = i % 5 == 0 ? 1 : i % 7 == 0 ? 2 : 0;
  c.add(c.add_mesh(std::move(world)));
  Rng rng(18);
  std::uint32_t mesh = c.add_mesh(soup(60, 60, 30, 19)), posed = c.add_mesh(posed_soup(60, 3, 20));
  c.add(mesh, random_transform(rng, 200));                    // opaque
  c.add(mesh, random_transform(rng, 200)).alpha = 0.5f;       // translucent as a whole
  c.add(mesh, random_transform(rng, 200)).material_base = 1;  // alpha-tested by its base
  c.add(posed, random_transform(rng, 200)).material_base = 1;
  c.add(posed, random_transform(rng, 200)).pose = {0, 1, 0.5f};
  expect_all_agree(c, random_rays(3000, 300, 21), true);

  Case opaque;
  opaque.add(opaque.add_mesh(soup(10, 10, 5, 1)));
  gpu::BindingTable table(*device_);
  GpuScene scene(*device_, table, {});
  scene.prepare(c.snapshot, {});
  scene.stage();
  EXPECT_TRUE(scene.features().alpha_test);
  EXPECT_TRUE(scene.features().translucent);
  EXPECT_FALSE(scene.features().specular);
  scene.prepare(opaque.snapshot, {});
  scene.stage();
  EXPECT_FALSE(scene.features().alpha_test);
  EXPECT_FALSE(scene.features().translucent);
}

TEST_F(GpuSceneTest, KnowsTheFeaturesOfModelsThatComeLater) {
  Case c;
  c.add(c.add_mesh(soup(10, 10, 5, 1)));
  gpu::BindingTable table(*device_);
  GpuScene scene(*device_, table, {});
  scene.prepare(c.snapshot, {});
  scene.stage();
  EXPECT_EQ(scene.features().surfaces, 0u);
  c.assets->materials.emplace_back().flags = scene::kMaterialWarp;
  scene.prepare(c.snapshot, {});
  scene.stage();
  EXPECT_EQ(scene.features().surfaces, shared::kFeatureWarp);
  c.add(c.add_mesh(posed_soup(10, 2, 2)));
  scene.prepare(c.snapshot, {});
  scene.stage();
  EXPECT_EQ(scene.features().surfaces, shared::kFeatureWarp | shared::kFeatureSmooth);
}

// Uploaded where it changed, and until the frame that has it is recorded.
TEST_F(GpuSceneTest, UploadsTheListOfLightsOnlyWhereItChanged) {
  scene::FrameSnapshot s = scene::many_lights(20);
  gpu::BindingTable table(*device_);
  GpuScene scene(*device_, table, {});
  const auto uploaded = [&](bool wants_lights = true) {
    scene.prepare(s, emission_scales(RenderSettings{}), wants_lights);
    scene.stage();
    return scene.statistics().uploaded_bytes;
  };
  const auto record = [&] {
    device_->run([&](gpu::Commands& commands) {
      commands.bind(table);
      scene.record(commands);
    });
  };
  uploaded(false);
  record();  // the first frame has copies, too
  const std::uint64_t without = uploaded(false);
  record();
  const std::uint64_t with = uploaded();
  // Where each of the former frame's instances is, always.
  const std::uint64_t unchanged = without + scene.statistics().instances * sizeof(std::uint32_t);
  EXPECT_GE(with, unchanged + scene.lights().count * sizeof(shared::GpuLight));
  EXPECT_GE(uploaded(), with) << "it was not recorded";
  record();
  EXPECT_EQ(unchanged, uploaded());
  record();
  s.instances.back().flags |= scene::kInstanceColor;
  s.instances.back().emission = vec3(3, 1, 1);
  EXPECT_EQ(with, uploaded()) << "one was painted";
  record();
  EXPECT_EQ(unchanged, uploaded());
  record();
  scene.forget();
  EXPECT_GE(uploaded(), with) << "nobody knows what the device has";
  record();
  EXPECT_EQ(without, uploaded(false));
  record();
  EXPECT_EQ(with, uploaded()) << "wanted again";
}

TEST_F(GpuSceneTest, PosesAndRefits) {
  Rng rng(22);
  Case c;
  c.add(c.add_mesh(soup(50, 300, 50, 23)));
  std::uint32_t large = c.add_mesh(posed_soup(500, 5, 24)), small = c.add_mesh(posed_soup(2, 3, 25));
  const float blends[]{0, 0.25f, 0.5f, 0.9f, 1};
  for (int i = 0; i < 12; ++i) {
    Instance& instance = c.add(i % 4 == 3 ? small : large, random_transform(rng, 150));
    instance.pose = {static_cast<std::uint32_t>(i) % 3, static_cast<std::uint32_t>(i / 2) % 3, blends[i % 5]};
  }
  c.add(large, random_transform(rng, 150)).pose = c.snapshot.instances[1].pose;  // shares the copy
  expect_all_agree(c, random_rays(2000, 250, 26));
}

// A scene that changes from frame to frame: poses, counts, new meshes, new assets.
TEST_F(GpuSceneTest, FollowsTheFrames) {
  for (const GpuSceneOptions& way : ways()) {
    SCOPED_TRACE(way.ray_query ? "query" : "bvh");
    RayList list(*device_, way, false);
    Rng rng(27);
    Case c;
    c.add(c.add_mesh(soup(50, 300, 50, 28)));
    std::uint32_t posed = c.add_mesh(posed_soup(80, 4, 29));
    for (int frame = 0; frame < 6; ++frame) {
      if (frame == 3) {
        std::uint32_t more = c.add_mesh(posed_soup(120, 4, 30)), rigid = c.add_mesh(soup(400, 50, 20, 31));
        for (int i = 0; i < 30; ++i) c.add(i % 2 == 0 ? more : rigid, random_transform(rng, 200));
      } else if (frame == 5) {
        Case other;
        other.add(other.add_mesh(soup(300, 200, 50, 32)));
        other.add(other.add_mesh(posed_soup(30, 4, 33)), random_transform(rng, 100));
        c = other;
      } else if (frame != 2) {  // the third frame repeats the second
        c.add(posed, random_transform(rng, 200));
        for (Instance& instance : c.snapshot.instances) {
          instance.pose = {rng.below(4), rng.below(4), instance.id % 2 == 0 ? rng.uniform() : 0.5f};
        }
      }
      std::vector<ListRay> rays = random_rays(600, 300, 100 + static_cast<std::uint64_t>(frame));
      list.load(c.snapshot, rays);
      list.trace();
      expect_agreement(c, rays, list.hits(), false);
    }
  }
}

// The frame's whole tree: every box holds what is below it, every triangle hangs in it once and says whose it is.
TEST_F(GpuSceneTest, RefittedBoxesHoldTheirTriangles) {
  Case c;
  Rng rng(46);
  c.add(c.add_mesh(soup(1500, 300, 40, 48)));
  std::uint32_t posed = c.add_mesh(posed_soup(700, 4, 47)), rigid = c.add_mesh(soup(90, 40, 20, 49)),
                tiny = c.add_mesh(soup(3, 10, 20, 50));
  c.add(posed, random_transform(rng, 100)).pose = {0, 3, 0.3f};
  c.add(rigid, random_transform(rng, 100));
  c.add(tiny, random_transform(rng, 100));
  c.add(posed, random_transform(rng, 100)).pose = {2, 1, 0.7f};
  RayList list(*device_, {}, false);
  list.load(c.snapshot, random_rays(1, 1, 1));
  const SceneBuffers buffers = list.scene().buffers();
  const auto nodes =
      gpu::read_now<shared::BvhNode>(*device_, *buffers.nodes, buffers.nodes->size() / sizeof(shared::BvhNode));
  const auto triangles = gpu::read_now<shared::GpuTriangle>(*device_, *buffers.triangles,
                                                            buffers.triangles->size() / sizeof(shared::GpuTriangle));
  const auto instances = gpu::read_now<shared::GpuInstance>(*device_, *buffers.instances, c.snapshot.instances.size());
  struct Visit {
    std::uint32_t ref;
    Bounds box;
  };
  std::vector<Visit> stack{{0, {vec3(-1e9f), vec3(1e9f)}}};
  std::vector<std::vector<int>> seen(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) seen[i].resize(instances[i].triangle_count);
  std::size_t outside = 0;
  const auto expect_inside = [&](const Bounds& box, const vec3& p) {
    const vec3 rounding(300 * 2.4e-7f);  // of putting corners together, on the host as here
    outside += glm::any(glm::lessThan(p, box.min - rounding)) || glm::any(glm::greaterThan(p, box.max + rounding));
  };
  while (!stack.empty()) {
    const Visit at = stack.back();
    stack.pop_back();
    if (at.ref < shared::kRefLeaf) {
      const shared::BvhNode& node = nodes.at(at.ref);
      stack.push_back({node.child0, {node.min0, node.max0}});
      stack.push_back({node.child1, {node.min1, node.max1}});
      continue;
    }
    const std::uint32_t first = at.ref & shared::kRefFirstMask;
    const std::uint32_t count = (at.ref >> shared::kRefCountShift & shared::kRefCountMask) + 1;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const shared::GpuTriangle& t = triangles.at(i);
      const std::uint32_t owner = shared::floatBitsToUint(t.v0.w) >> shared::kTriangleInstanceShift;
      ++seen.at(owner).at(i - instances[owner].world_triangle);
      for (const vec3& p : {vec3(t.v0), vec3(t.v0) + vec3(t.e1), vec3(t.v0) + vec3(t.e2)}) expect_inside(at.box, p);
    }
  }
  EXPECT_EQ(outside, 0u);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].size(), c.assets->meshes[c.snapshot.instances[instances[i].id].mesh].triangles.size());
    for (int times : seen[i]) EXPECT_EQ(times, 1);
  }
}

}  // namespace
}  // namespace fb::render
