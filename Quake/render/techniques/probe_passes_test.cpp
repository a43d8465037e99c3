// The passes over probes, one by one, with rays whose light and distances are known: what a probe holds of them, where
// it moves, when it sleeps, and whose turn it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "estimators/ddgi/ddgi.h"
#include "gpu/buffer.h"
#include "render/passes/shader_code.h"
#include "render/techniques/technique_memory.h"
#include "render/test_device.h"
#include "shared/denoise.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

constexpr ArrayRow kPassRows[]{FB_DDGI_ARRAYS(FB_ARRAY_ROW)};
constexpr double kPassPi = 3.14159265358979323846;
constexpr float kPassSpacing = 100, kPassFarthest = 400;

// What a ray in a direction brings: radiance, and the distance, negative at a back face.
struct ProbeRay {
  vec3 light{0.0f};
  float distance = kPassFarthest;
};
using Around = std::function<ProbeRay(const vec3& direction)>;
struct ProbeRecord {
  vec3 offset{0.0f};
  std::uint32_t cell = 0, state = 0, turn = 0, asked = 0;
  float light = 0;
  std::uint32_t updates() const { return state & shared::kDdgiUpdates; }
  bool asleep() const { return (state & shared::kDdgiAsleep) != 0; }
};
static_assert(sizeof(ProbeRecord) == 32);

class ProbePassesTest : public DeviceTest {
 protected:
  void TearDown() override {
    memory_.reset();
    table_.reset();
    uniform_ = gpu::Buffer();
    frame_ = gpu::Buffer();
    DeviceTest::TearDown();
  }
  // `probes` in a row along x, of which `turns` have one in a frame.
  void make(int probes, std::uint32_t turns, std::uint32_t rays) {
    memory_.reset();
    table_ = std::make_unique<gpu::BindingTable>(*device_);
    memory_ = std::make_unique<TechniqueMemory>(*device_, *table_, kPassRows, "probes reset");
    uniform_ = gpu::Buffer(*device_, gpu::BufferUse::kUniform, sizeof(shared::DdgiConstants), "constants of probes");
    table_->set_uniform(shared::kSetTechnique, uniform_);
    frame_ = gpu::Buffer(*device_, gpu::BufferUse::kUniform, sizeof(shared::FrameConstants), "constants of the frame");
    table_->set_uniform(shared::kSetScene, frame_);
    constants_ = {};
    copy_settings(RenderSettings{}, constants_);
    constants_.origin = vec4(0, 0, 0, kPassFarthest);
    constants_.spacing = vec4(kPassSpacing);
    constants_.count_x = probes;
    constants_.count_y = constants_.count_z = 1;
    constants_.probes = static_cast<std::uint32_t>(probes);
    constants_.turns = turns;
    constants_.rays = rays;
    constants_.ddgi_hysteresis = 0.9f;
    for (const std::uint32_t array : {shared::kDdgiProbes, shared::kDdgiLight, shared::kDdgiDepth, shared::kDdgiTurns})
      memory_->set_count(array, constants_.probes);
    memory_->set_count(shared::kDdgiRays, std::uint64_t{turns} * rays);
    memory_->make();
    device_->run([&](gpu::Commands& commands) {
      for (const ArrayRow& row : kPassRows) commands.fill(memory_->buffer(row.binding), 0);
      commands.barrier();
    });
  }
  void run(const char* shader, std::uint32_t groups, std::uint32_t constant = 0) {
    std::memcpy(uniform_.mapped(), &constants_, sizeof(constants_));
    shared::FrameConstants frame{};
    frame.frame = constants_.frame_number;  // by which light is rounded
    std::memcpy(frame_.mapped(), &frame, sizeof(frame));
    const gpu::SpecializationConstant constants[]{{shared::kSpecTechnique, constant}};
    const gpu::ComputePipeline pipeline =
        make_pipeline(*device_, *table_, shader, false, arrays_by_address(*device_), constants);
    device_->run([&](gpu::Commands& commands) {
      commands.bind(*table_);
      commands.dispatch(pipeline, groups, 1);
      commands.barrier();
    });
  }
  gpu::Buffer& array(std::uint32_t binding) { return const_cast<gpu::Buffer&>(memory_->buffer(binding)); }
  std::vector<ProbeRecord> records() {
    return gpu::read_now<ProbeRecord>(*device_, array(shared::kDdgiProbes), constants_.probes);
  }
  void set_record(std::uint32_t probe, const ProbeRecord& record) {
    gpu::upload_now(*device_, array(shared::kDdgiProbes), &record, sizeof(record), probe * sizeof(record));
  }
  // A turn of probe 0: its rays, then both passes that take them up. `turned`: which rotation of its directions.
  void turn(const Around& around, const vec3& turned) {
    std::vector<vec4> rays;
    for (std::uint32_t i = 0; i < constants_.rays; ++i) {
      const vec3 d = shared::ddgi_turned(shared::ddgi_sphere_point(i, constants_.rays), turned);
      const ProbeRay ray = around(d);
      rays.emplace_back(d, ray.distance);
      const vec3 stands_for = ray.light * static_cast<float>(4 * kPassPi);
      rays.emplace_back(stands_for, std::bit_cast<float>(shared::pack_rgb9e5(stands_for, 0.5f)));
    }
    gpu::upload_now(*device_, array(shared::kDdgiRays), std::span<const vec4>(rays));
    ++constants_.frame_number;
    run("ddgi_relocate", 1);
    run("ddgi_blend", 1);
  }
  vec3 light(std::uint32_t texel) {
    const auto words = gpu::read_now<std::uint32_t>(*device_, array(shared::kDdgiLight), texel + 1);
    return shared::unpack_rgb9e5(words[texel]);
  }
  // Mean and mean square of distances, units.
  std::array<double, 2> depth(std::uint32_t texel) {
    const auto words = gpu::read_now<std::uint32_t>(*device_, array(shared::kDdgiDepth), shared::kDdgiDepthTexels);
    const double far = static_cast<double>(kPassFarthest);
    return {(words[texel] & 0xffffu) / 65535.0 * far, (words[texel] >> 16u) / 65535.0 * far * far};
  }

  std::unique_ptr<gpu::BindingTable> table_;
  std::unique_ptr<TechniqueMemory> memory_;
  gpu::Buffer uniform_, frame_;
  shared::DdgiConstants constants_{};
};

// Radiance 1 + axis . direction has the mean 1 + 2/3 axis . n over the cosine about n. Were it divided by 2 pi, the sum
// of all cosines would be taken for twice what it is.
TEST_F(ProbePassesTest, LightIsTheMeanOverTheCosine) {
  make(1, 1, 1024);
  const vec3 axis(0.3f, -0.4f, 0.5f);
  turn([&](const vec3& d) { return ProbeRay{vec3(1, 2, 0.5f) * (1 + dot(axis, d)), 50}; }, {0.3f, 0.7f, 0.2f});
  for (const std::uint32_t texel : {0u, 7u, 9u, 20u, 27u, 36u, 45u, 63u}) {
    const float expected = 1 + 2.0f / 3 * dot(axis, shared::ddgi_direction(texel, shared::kDdgiLightSide));
    EXPECT_NEAR(light(texel).x, expected, 0.012f) << texel;
    EXPECT_NEAR(light(texel).y, 2 * expected, 0.024f) << texel;
  }
}

// Where it is asked for, what is reflected from the directions of each texel, by their own solid angle.
TEST_F(ProbePassesTest, ReflectedLightIsKeptByDirection) {
  make(1, 1, 1024);
  constants_.ddgi_control = 1;
  memory_->set_count(shared::kDdgiLight, 2);
  memory_->make();
  const vec3 axis(0.3f, -0.4f, 0.5f);
  for (int i = 0; i < 30; ++i)
    turn(
        [&](const vec3& d) {
          return ProbeRay{vec3(1, 2, 0.5f) * (1 + dot(axis, d)), 50};
        },
        {static_cast<float>(i) / 30, std::fmod(0.3f * static_cast<float>(i), 1.0f), 0.2f});
  double off = 0;
  for (std::uint32_t texel = 0; texel < shared::kDdgiLightTexels; ++texel) {
    const float expected = 1 + dot(axis, shared::ddgi_direction(texel, shared::kDdgiLightSide));
    // Some 480 directions of turned lattices, 180 in the least texel.
    EXPECT_NEAR(light(shared::kDdgiLightTexels + texel).y, 2 * expected, 0.4f * expected) << texel;
    off +=
        static_cast<double>(light(shared::kDdgiLightTexels + texel).y / (2 * expected) - 1) / shared::kDdgiLightTexels;
  }
  EXPECT_NEAR(off, 0, 0.02);
}

// Distances in a box about its middle: a texel's moments are those over the 50th power of the cosine about it.
TEST_F(ProbePassesTest, DistancesInABoxHaveTheirMoments) {
  make(1, 1, 1024);
  const vec3 half(90, 140, 60);
  const auto distance = [&](const vec3& d) {
    const vec3 t = half / max(abs(d), vec3(1e-6f));
    return std::min({t.x, t.y, t.z});
  };
  for (int i = 0; i < 16; ++i) {
    const float k = static_cast<float>(i) / 16;
    turn(
        [&](const vec3& d) {
          return ProbeRay{vec3(0.0f), distance(d)};
        },
        {k, std::fmod(5 * k, 1.0f), std::fmod(3 * k, 1.0f)});
  }
  for (const std::uint32_t texel : {0u, 17u, 85u, 119u, 136u, 200u, 255u}) {
    const vec3 about = shared::ddgi_direction(texel, shared::kDdgiDepthSide);
    double sum = 0, mean = 0, square = 0;
    for (std::uint32_t i = 0; i < 200000; ++i) {
      const vec3 d = shared::ddgi_sphere_point(i, 200000);
      const double weight = std::pow(std::max(static_cast<double>(dot(d, about)), 0.0), 50);
      const double t = static_cast<double>(distance(d));
      sum += weight;
      mean += weight * t;
      square += weight * t * t;
    }
    EXPECT_NEAR(depth(texel)[0], mean / sum, 0.02 * mean / sum) << texel;
    EXPECT_NEAR(depth(texel)[1], square / sum, 0.04 * square / sum) << texel;
  }
}

// All turns count alike until the newest has its least share; light that changes all of a sudden takes the place of
// what was known.
TEST_F(ProbePassesTest, TurnsAreBlended) {
  make(1, 1, 64);
  const auto even = [](float light) { return [light](const vec3&) { return ProbeRay{vec3(light), 50}; }; };
  constants_.ddgi_change = 0;
  for (const float l : {1.0f, 2.0f, 3.0f, 6.0f}) turn(even(l), vec3(0.1f));
  EXPECT_NEAR(light(3).x, 3, 0.04f);
  EXPECT_EQ(records()[0].updates(), 4u);
  // Rounded by chance to 1/64, of which a tenth is new in each turn: the deviation is 0.02 at most.
  for (int i = 0; i < 60; ++i) turn(even(5), vec3(0.1f));
  EXPECT_NEAR(light(3).x, 5, 0.08f);
  turn(even(15), vec3(0.1f));
  EXPECT_NEAR(light(3).x, 6, 0.08f);
  constants_.ddgi_change = 6;
  turn(even(1), vec3(0.1f));
  EXPECT_NEAR(light(3).x, 1, 0.02f);
  EXPECT_EQ(records()[0].updates(), 1u);
}

// Within a wall, whose nearer side is at +x: out through it, and nothing is known there yet. Where that is too far, or
// it has moved too often, it sleeps.
TEST_F(ProbePassesTest, ProbesMoveOutOfWalls) {
  for (const float thick : {30.0f, 80.0f}) {
    make(1, 1, 256);
    const auto in_wall = [&](const vec3& d) { return ProbeRay{vec3(0.0f), d.x > 0 ? -thick / d.x : 60.0f}; };
    turn(in_wall, vec3(0.5f));
    const ProbeRecord r = records()[0];
    if (thick < 40) {
      EXPECT_GT(r.offset.x, thick);
      EXPECT_LT(r.offset.x, 0.45f * kPassSpacing);
      EXPECT_EQ(r.updates(), 0u);
      EXPECT_FALSE(r.asleep());
    } else {
      EXPECT_EQ(r.offset, vec3(0.0f));
      EXPECT_TRUE(r.asleep());
    }
  }
  make(1, 1, 256);
  constants_.ddgi_relocate = 0;
  turn([](const vec3&) { return ProbeRay{vec3(0.0f), -5}; }, vec3(0.5f));
  EXPECT_TRUE(records()[0].asleep());
}

TEST_F(ProbePassesTest, ProbesMoveOffWalls) {
  make(1, 1, 256);
  turn([](const vec3& d) { return ProbeRay{vec3(0.0f), d.z < -0.1f ? 3 / -d.z : 150.0f}; }, vec3(0.5f));
  EXPECT_NEAR(records()[0].offset.z, 17, 1);
  EXPECT_EQ(records()[0].updates(), 0u);
}

// Nothing near: it sleeps until a path asks.
TEST_F(ProbePassesTest, ProbesFarFromAllSurfacesSleep) {
  make(1, 1, 64);
  const auto far = [](const vec3&) { return ProbeRay{vec3(1), 390}; };
  turn(far, vec3(0.2f));
  EXPECT_TRUE(records()[0].asleep());
  ProbeRecord r = records()[0];
  r.asked = constants_.frame_number;
  set_record(0, r);
  turn(far, vec3(0.2f));
  EXPECT_FALSE(records()[0].asleep());
  EXPECT_GT(records()[0].updates(), 0u);
  constants_.ddgi_sleep = 0;
  set_record(0, {});
  turn(far, vec3(0.2f));
  EXPECT_FALSE(records()[0].asleep());
}

// Those that were never asked about come first, then in turns, those in sight more often; a volume that moves on
// forgets what its new cells' probes knew.
TEST_F(ProbePassesTest, ProbesTakeTurns) {
  constexpr int kProbes = 130, kTurns = 10;
  make(kProbes, kTurns, 16);
  std::array<int, kProbes> times{};
  const auto frame = [&] {
    ++constants_.frame_number;
    run("ddgi_turns", 3, 0);
    run("ddgi_turns", 3, 1);
    const auto chosen = gpu::read_now<std::uint32_t>(*device_, array(shared::kDdgiTurns), kTurns);
    std::set<std::uint32_t> different(chosen.begin(), chosen.end());
    EXPECT_EQ(different.size(), static_cast<std::size_t>(kTurns));
    for (const std::uint32_t probe : chosen) {
      ASSERT_LT(probe, static_cast<std::uint32_t>(kProbes));
      ++times[probe];
      ProbeRecord r = records()[probe];
      r.turn = constants_.frame_number;
      r.state = 1;
      set_record(probe, r);
    }
  };
  for (int i = 0; i < kProbes / kTurns; ++i) frame();
  EXPECT_EQ(*std::ranges::min_element(times), 1);
  EXPECT_EQ(*std::ranges::max_element(times), 1);
  times = {};
  for (int i = 0; i < 40; ++i) {
    for (std::uint32_t probe = 0; probe < 13; ++probe) {
      ProbeRecord r = records()[probe];
      r.asked = constants_.frame_number;
      set_record(probe, r);
    }
    frame();
  }
  for (std::size_t probe = 0; probe < kProbes; ++probe) {
    EXPECT_GE(times[probe], probe < 13 ? 6 : 1) << probe;
    EXPECT_LE(times[probe], probe < 13 ? 14 : 4) << probe;
  }
  constants_.first_x = 3;
  times = {};
  frame();
  for (std::size_t probe = 0; probe < 3; ++probe) EXPECT_EQ(times[probe], 1) << "cells " << probe + kProbes;
}

}  // namespace
}  // namespace fb::render
