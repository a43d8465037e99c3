// Acceleration structures, seen through a shader that asks them (only where the device has ray query).
#include <gmock/gmock.h>

#include <array>
#include <bit>

#include "gpu/acceleration_structure.h"
#include "gpu/test_device.h"
#include "test_ray_triangle.spv.h"

namespace fb::gpu {
namespace {

struct Ray {
  vec3 origin;
  float t_max = 1000.0f;
  vec3 direction{0, 0, 1};
  std::uint32_t mask = 0xff;
};
struct Hit {
  std::uint32_t instance, triangle, front, candidates;
  float t, u, v, unused;
};

// Triangle 0 in z = 5 over the corner of the positive x and y; triangle 1 the same in z = 9.
constexpr std::array<float, 18> kVertices{0, 0, 5, 4, 0, 5, 0, 4, 5, 0, 0, 9, 4, 0, 9, 0, 4, 9};
constexpr std::array<std::uint32_t, 6> kIndices{0, 1, 2, 3, 4, 5};

class RayQueryTest : public DeviceTest, public testing::WithParamInterface<BuildPreference> {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (!device_) return;
    if (!device_->has_ray_query()) GTEST_SKIP() << device_->report().name << " has no ray query";
    vertices_ = Buffer(*device_, BufferUse::kGeometry, sizeof(kVertices), "vertices");
    indices_ = Buffer(*device_, BufferUse::kGeometry, sizeof(kIndices), "indices");
    upload_now(*device_, vertices_, std::span<const float>(kVertices));
    upload_now(*device_, indices_, std::span<const std::uint32_t>(kIndices));
    table_ = std::make_unique<BindingTable>(*device_);
    pipeline_ = ComputePipeline(*device_, *table_, test_ray_triangle_spv, "ray triangle");
  }
  void TearDown() override {
    pipeline_ = {};
    table_.reset();
    vertices_ = {};
    indices_ = {};
    DeviceTest::TearDown();
  }

  TriangleGeometry triangles(std::uint32_t first, std::uint32_t count, bool opaque = true) const {
    TriangleGeometry geometry;
    geometry.vertices = &vertices_;
    geometry.vertex_count = 6;
    geometry.indices = &indices_;
    geometry.index_offset = first * 12;
    geometry.triangle_count = count;
    geometry.opaque = opaque;
    return geometry;
  }
  void build(BottomLevel& bottom, const TriangleGeometry& geometry) {
    device_->run([&](Commands& commands) { bottom.build(*device_, commands, geometry, GetParam()); });
  }
  void build(TopLevel& top, std::span<const TopLevelInstance> instances) {
    device_->run([&](Commands& commands) { top.build(*device_, commands, instances, GetParam()); });
  }
  std::vector<Hit> trace(const TopLevel& top, const std::vector<Ray>& rays, std::uint32_t ray_flags = 0) {
    Buffer in(*device_, BufferUse::kStorage, rays.size() * sizeof(Ray), "rays");
    Buffer out(*device_, BufferUse::kStorage, rays.size() * sizeof(Hit), "hits");
    upload_now(*device_, in, std::span<const Ray>(rays));
    table_->set_array(shared::kSetScene, 0, in);
    table_->set_array(shared::kSetFrame, 0, out);
    table_->set_tlas(top.handle());
    const auto count = static_cast<std::uint32_t>(rays.size());
    device_->run([&](Commands& commands) {
      commands.bind(*table_);
      commands.push(std::array{count, ray_flags});
      commands.dispatch(pipeline_, (count + 63) / 64);
    });
    return read_now<Hit>(*device_, out, rays.size());
  }

  Buffer vertices_, indices_;
  std::unique_ptr<BindingTable> table_;
  ComputePipeline pipeline_;
};

TEST_P(RayQueryTest, HitsATriangleWhereItIs) {
  BottomLevel bottom;
  EXPECT_FALSE(bottom);
  build(bottom, triangles(0, 2));
  EXPECT_TRUE(bottom);
  TopLevel top;
  build(top, std::vector<TopLevelInstance>{{.custom_index = 77, .bottom_level = bottom.address()}});
  const auto hits = trace(top, {{.origin = {1, 2, 0}},
                                {.origin = {1, 2, 20}, .direction = {0, 0, -1}},
                                {.origin = {3, 3, 0}},
                                {.origin = {1, 1, 6}},
                                {.origin = {1, 1, 0}, .t_max = 4.5f}});
  EXPECT_FLOAT_EQ(hits[0].t, 5.0f);
  EXPECT_EQ(hits[0].instance, 77u);
  EXPECT_EQ(hits[0].triangle, 0u);
  EXPECT_FLOAT_EQ(hits[0].u, 0.25f);
  EXPECT_FLOAT_EQ(hits[0].v, 0.5f);
  EXPECT_EQ(hits[0].candidates, 0u);
  EXPECT_FLOAT_EQ(hits[1].t, 11.0f) << "faces are not culled from behind";
  EXPECT_EQ(hits[1].triangle, 1u);
  EXPECT_NE(hits[0].front, hits[1].front);
  EXPECT_EQ(hits[2].t, -1.0f);
  EXPECT_FLOAT_EQ(hits[3].t, 3.0f);
  EXPECT_EQ(hits[3].triangle, 1u);
  EXPECT_EQ(hits[4].t, -1.0f);
}

TEST_P(RayQueryTest, FacesAreNotCulledThoughTheRayAsks) {
  BottomLevel bottom;
  build(bottom, triangles(0, 1));
  TopLevel top;
  build(top, std::vector<TopLevelInstance>{{.bottom_level = bottom.address()}});
  constexpr std::uint32_t kCullBack = 0x10, kCullFront = 0x20;  // SPIR-V's ray flags
  for (const std::uint32_t flags : {kCullBack, kCullFront}) {
    const auto hits = trace(top, {{.origin = {1, 1, 0}}, {.origin = {1, 1, 9}, .direction = {0, 0, -1}}}, flags);
    EXPECT_FLOAT_EQ(hits[0].t, 5.0f);
    EXPECT_FLOAT_EQ(hits[1].t, 4.0f);
  }
}

TEST_P(RayQueryTest, TransformsMasksAndIndicesAreTheInstances) {
  BottomLevel bottom;
  build(bottom, triangles(0, 1));
  // Turned a quarter about x (y to z, z to -y), doubled, and moved; rows and columns must not be mixed up.
  TopLevelInstance turned{.custom_index = 0xabcdef, .mask = 0x02, .bottom_level = bottom.address()};
  turned.transform[0] = {2, 0, 0};
  turned.transform[1] = {0, 0, 2};
  turned.transform[2] = {0, -2, 0};
  turned.transform[3] = {100, 50, 25};
  const TopLevelInstance plain{.custom_index = 1, .mask = 0x01, .bottom_level = bottom.address()};
  TopLevel top;
  build(top, std::vector<TopLevelInstance>{plain, turned});
  // (1, 2, 5) goes to (2, -10, 4) + (100, 50, 25).
  const auto hits = trace(top, {{.origin = {102, 0, 29}, .direction = {0, 1, 0}},
                                {.origin = {102, 0, 29}, .direction = {0, 1, 0}, .mask = 0x01},
                                {.origin = {1, 2, 0}, .mask = 0x01},
                                {.origin = {1, 2, 0}, .mask = 0x02}});
  EXPECT_FLOAT_EQ(hits[0].t, 40.0f);
  EXPECT_EQ(hits[0].instance, 0xabcdefu);
  EXPECT_NEAR(hits[0].u, 0.25f, 1e-5f);
  EXPECT_NEAR(hits[0].v, 0.5f, 1e-5f);
  EXPECT_EQ(hits[1].t, -1.0f);
  EXPECT_FLOAT_EQ(hits[2].t, 5.0f);
  EXPECT_EQ(hits[2].instance, 1u);
  EXPECT_EQ(hits[3].t, -1.0f);
}

TEST_P(RayQueryTest, OnlyWhatIsNotOpaqueIsACandidate) {
  BottomLevel opaque, clear;
  build(opaque, triangles(0, 1, true));
  build(clear, triangles(0, 1, false));
  TopLevel top;
  build(top, std::vector<TopLevelInstance>{{.bottom_level = opaque.address()}});
  EXPECT_EQ(trace(top, {{.origin = {1, 1, 0}}})[0].candidates, 0u);
  build(top, std::vector<TopLevelInstance>{{.bottom_level = clear.address()}});
  const auto hits = trace(top, {{.origin = {1, 1, 0}}});
  EXPECT_EQ(hits[0].candidates, 1u);
  EXPECT_FLOAT_EQ(hits[0].t, 5.0f);
}

TEST_P(RayQueryTest, NothingCanBeBuiltAndMissed) {
  BottomLevel none;
  build(none, TriangleGeometry{});
  EXPECT_TRUE(none);
  TopLevel top;
  build(top, {});
  ASSERT_NE(top.handle(), VK_NULL_HANDLE);
  EXPECT_EQ(trace(top, {{.origin = {0, 0, 0}}})[0].t, -1.0f);
  // An instance of nothing, one without a structure, and a real one beside them.
  BottomLevel bottom;
  build(bottom, triangles(1, 1));
  build(top, std::vector<TopLevelInstance>{{.bottom_level = none.address()},
                                           {.bottom_level = 0},
                                           {.custom_index = 3, .bottom_level = bottom.address()}});
  const auto hits = trace(top, {{.origin = {1, 1, 0}}, {.origin = {0, 0, -1}, .direction = {0, 0, -1}}});
  EXPECT_FLOAT_EQ(hits[0].t, 9.0f);
  EXPECT_EQ(hits[0].instance, 3u);
  EXPECT_EQ(hits[1].t, -1.0f);
}

TEST_P(RayQueryTest, RebuildsInPlace) {
  BottomLevel bottom;
  build(bottom, triangles(0, 2));
  const VkDeviceAddress address = bottom.address();
  TopLevel top;
  const std::vector<TopLevelInstance> two(2, {.bottom_level = bottom.address()});
  build(top, two);
  const VkAccelerationStructureKHR handle = top.handle();
  const std::uint64_t allocated = device_->allocated_bytes();
  // The vertices move, and there are fewer of them and of the instances: same memory, other hits.
  std::array<float, 18> moved = kVertices;
  for (std::size_t i = 2; i < moved.size(); i += 3) moved[i] += 1.0f;
  upload_now(*device_, vertices_, std::span<const float>(moved));
  device_->run([&](Commands& commands) {
    bottom.build(*device_, commands, triangles(0, 1), GetParam());
    commands.barrier();
    top.build(*device_, commands, std::span(two).first(1), GetParam());
  });
  EXPECT_EQ(bottom.address(), address);
  EXPECT_EQ(top.handle(), handle);
  EXPECT_EQ(device_->allocated_bytes(), allocated);
  const auto hits = trace(top, {{.origin = {1, 1, 0}}, {.origin = {1, 1, 8}}});
  EXPECT_FLOAT_EQ(hits[0].t, 6.0f);
  EXPECT_EQ(hits[1].t, -1.0f);
}

TEST_P(RayQueryTest, ReservedRoomKeepsTheHandle) {
  BottomLevel bottom;
  build(bottom, triangles(0, 1));
  TopLevel top;
  EXPECT_TRUE(top.reserve(*device_, 100, GetParam()));
  const VkAccelerationStructureKHR handle = top.handle();
  for (const std::size_t count : {1u, 100u, 50u}) {
    std::vector<TopLevelInstance> instances(count, {.bottom_level = bottom.address()});
    build(top, instances);
    EXPECT_EQ(top.handle(), handle);
    EXPECT_FLOAT_EQ(trace(top, {{.origin = {1, 1, 0}}})[0].t, 5.0f);
  }
  EXPECT_FALSE(top.reserve(*device_, 100, GetParam()));
  std::vector<TopLevelInstance> many(1000, {.bottom_level = bottom.address()});
  build(top, many);
  EXPECT_FLOAT_EQ(trace(top, {{.origin = {1, 1, 0}}})[0].t, 5.0f);
  TopLevel taken = std::move(top);
  EXPECT_EQ(top.handle(), VK_NULL_HANDLE);
  EXPECT_FLOAT_EQ(trace(taken, {{.origin = {1, 1, 0}}})[0].t, 5.0f);
}

INSTANTIATE_TEST_SUITE_P(Preferences, RayQueryTest,
                         testing::Values(BuildPreference::kFastTrace, BuildPreference::kFastBuild), [](const auto& p) {
                           return p.param == BuildPreference::kFastTrace ? "FastTrace" : "FastBuild";
                         });

}  // namespace
}  // namespace fb::gpu
