// Pipelines made for a frame, and those made beside the frames.
#include "render/passes/shader_set.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <thread>

#include "base/test_directory.h"
#include "gpu/binding_table.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

class ShaderSetTest : public DeviceTest {
 protected:
  // Of a shader that is small, whatever they are specialised for.
  static Variant whole() {
    Variant variant;
    variant.specular = true;
    return variant;
  }
  static Variant small() {
    Variant variant;
    variant.small = true;
    return variant;
  }
};

TEST_F(ShaderSetTest, WhatIsAskedForIsMadeAtOnce) {
  const gpu::BindingTable table(*device_);
  ShaderSet set(*device_, table, false, false);
  set.set_precompiles(true);
  const gpu::ComputePipeline& made = set.get("exposure", whole(), small());
  EXPECT_FALSE(made);
  set.make();
  EXPECT_TRUE(made);
  EXPECT_EQ(&made, &set.get("exposure", whole()));
  EXPECT_TRUE(set.settled());
}

TEST_F(ShaderSetTest, ASetThatHurriesGivesASmallOneMeanwhile) {
  const gpu::BindingTable table(*device_);
  ShaderSet set(*device_, table, false, false);
  set.set_precompiles(true);
  set.set_hurries(true);
  const bool waits = device_->is_software() && !gpu::Precompiler::helps(*device_);
  const gpu::ComputePipeline& first = set.get("exposure", whole(), small());
  set.make();
  EXPECT_TRUE(first);
  EXPECT_EQ(&first == &set.get("exposure", small()), !waits);
  EXPECT_EQ(set.settled(), waits);
  const auto start = std::chrono::steady_clock::now();
  while (!set.settled() && std::chrono::steady_clock::now() - start < std::chrono::minutes(2)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    set.get("exposure", whole(), small());
    set.make();
  }
  EXPECT_TRUE(set.settled());
  const gpu::ComputePipeline& last = set.get("exposure", whole(), small());
  EXPECT_TRUE(last);
  EXPECT_EQ(&last, &set.get("exposure", whole()));
  EXPECT_EQ(&last == &first, waits);
}

TEST_F(ShaderSetTest, WhoeverWaitsMayLeave) {
  const gpu::BindingTable table(*device_);
  ShaderSet set(*device_, table, false, false);
  int calls = 0;
  set.set_waiting([&] {
    ++calls;
    return false;
  });
  set.get("nee", whole());  // takes any driver longer than it is waited for until the first call
  EXPECT_THROW(set.make(), ShadersAbandoned);
  EXPECT_EQ(calls, 1);
  EXPECT_FALSE(set.settled()) << "a thread still compiles";
}

TEST_F(ShaderSetTest, OneThatHurriesNoLongerWaitsForWhatIsUnderWay) {
  const gpu::BindingTable table(*device_);
  ShaderSet set(*device_, table, false, false);
  set.set_precompiles(true);
  set.set_hurries(true);
  for (int frame = 0; frame < 4; ++frame) {  // until what can wait is begun
    set.get("exposure", whole(), small());
    set.make();
  }
  set.set_hurries(false);
  const gpu::ComputePipeline& whole_one = set.get("exposure", whole(), small());
  set.make();
  EXPECT_TRUE(set.settled());
  EXPECT_TRUE(whole_one);
  EXPECT_EQ(&whole_one, &set.get("exposure", whole()));
}

// By the bytes in Mesa's cache: the devices that compile ahead make what the one that draws asks for, and nothing else.
TEST(Precompiled, TheDeviceThatDrawsCompilesNothingElse) {
  const auto cached_bytes = [](bool precompiles) -> std::uintmax_t {
    const TestDirectory cache;
    ::setenv("MESA_SHADER_CACHE_DIR", cache.path().c_str(), 1);
    {
      const auto device = gpu::Device::create({});
      if (!device || !gpu::Precompiler::helps(**device)) return 0;
      RenderSettings settings;
      settings.intersector = Intersector::kBvh;
      const auto renderer = Renderer::create(**device, settings).value();
      renderer->resize(8, 8);
      renderer->set_precompiles(precompiles);
      renderer->render(scene::cornell_box(), nullptr, settings);
    }
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache.path()))
      if (entry.is_regular_file() && entry.path().filename() != "index") bytes += entry.file_size();
    return bytes;
  };
  const std::uintmax_t plain = cached_bytes(false), ahead = cached_bytes(true);
  ::unsetenv("MESA_SHADER_CACHE_DIR");
  if (plain == 0) GTEST_SKIP() << "no driver that compiles at the first dispatch";
  // Times of compilation and the like may be in it: less than any shader's code.
  EXPECT_NEAR(static_cast<double>(ahead), static_cast<double>(plain), 1000);
}

}  // namespace
}  // namespace fb::render
