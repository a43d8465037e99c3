// Drivers that compile at the first dispatch: by the files in Mesa's cache, what is compiled, when, and how often.
#include "gpu/precompiler.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <thread>

#include "base/test_directory.h"
#include "gpu/binding_table.h"
#include "gpu/commands.h"
#include "test_arithmetic.spv.h"
#include "test_texels.spv.h"

namespace fb::gpu {
namespace {

// Devices whose driver keeps what it compiles in a folder of the test's own.
class PrecompilerTest : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("MESA_SHADER_CACHE_DIR", cache_.path().c_str(), 1);
    const auto made = Device::create({});
    if (!made) GTEST_SKIP() << "no Vulkan device: " << made.error().message;
    if (!Precompiler::helps(**made)) GTEST_SKIP() << (*made)->report().name << " compiles when pipelines are made";
  }
  void TearDown() override {
    for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_SHADER_CACHE_DISABLE"}) ::unsetenv(name);
  }
  // Bytes of code in the cache. Not its index; Mesa keeps one file for each, or all in one.
  std::uintmax_t cached_bytes() const {
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache_.path()))
      if (entry.is_regular_file() && entry.path().filename() != "index") bytes += entry.file_size();
    return bytes;
  }
  static ShaderSource arithmetic() { return {test_arithmetic_spv, "arithmetic", {}}; }
  static ShaderSource texels() { return {test_texels_spv, "texels", {}}; }

  TestDirectory cache_;
};

void dispatch_once(const ShaderSource& shader, VkDeviceSize bytes) {
  const auto device = Device::create({}).value();
  BindingTable table(*device);
  const Buffer texels(*device, BufferUse::kStorage, bytes, "texels");
  for (std::uint32_t i = 0; i < 2; ++i) table.set_texels(i, texels);
  const ComputePipeline pipeline(*device, table, shader.spirv, shader.name, shader.constants);
  device->run([&](Commands& commands) {
    commands.bind(table);
    commands.dispatch(pipeline, 1);
  });
}

TEST_F(PrecompilerTest, TheDeviceThatDrawsFindsTheCode) {
  const auto device = Device::create({}).value();
  Precompiler(*device, texels()).compile(arithmetic());
  const std::uintmax_t made = cached_bytes();
  EXPECT_GT(made, 0u);
  dispatch_once(arithmetic(), 16);
  EXPECT_EQ(cached_bytes(), made);
}

TEST_F(PrecompilerTest, SeveralThreadsCompileAtOnce) {
  const auto device = Device::create({}).value();
  {
    Precompiler precompiler(*device, texels());
    std::jthread other([&] { precompiler.compile(texels()); });
    precompiler.compile(arithmetic());
  }
  const std::uintmax_t made = cached_bytes();
  dispatch_once(arithmetic(), 16);
  EXPECT_EQ(cached_bytes(), made);
}

TEST_F(PrecompilerTest, ACacheThatIsOffIsNoHelp) {
  const auto device = Device::create({}).value();
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  EXPECT_FALSE(Precompiler::helps(*device));
}

// Sizes that were compiled for apart: a power of two, one with the bits of a first level alone, any other.
TEST_F(PrecompilerTest, NoSizeOfATexelBufferIsCompiledForAnew) {
  dispatch_once(texels(), 0x12340);
  const std::uintmax_t made = cached_bytes();
  EXPECT_GT(made, 0u);
  for (const VkDeviceSize bytes : {0x10000, 0x30000, 0x30010, 0x100, 0x40}) dispatch_once(texels(), bytes);
  EXPECT_EQ(cached_bytes(), made);
}

}  // namespace
}  // namespace fb::gpu
