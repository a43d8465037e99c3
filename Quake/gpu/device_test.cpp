#include "gpu/device.h"

#include <algorithm>
#include <gmock/gmock.h>

#include <bit>
#include <numeric>

#include "base/out_of_memory.h"
#include "base/rng.h"
#include "gpu/commands.h"
#include "gpu/test_device.h"
#include "test_arithmetic.spv.h"
#include "test_constants.spv.h"

namespace fb::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

Words random_words(std::size_t count) {
  Rng rng(7);
  Words words(count);
  for (std::uint32_t& word : words) word = rng.next();
  return words;
}

struct Factors {
  std::uint32_t a, b, count, rounds;
};

class GpuTest : public DeviceTest {};

TEST_F(GpuTest, BufferSizesAreRoundedUp) {
  EXPECT_EQ(Buffer(*device_, BufferUse::kStorage, 0, "none").size(), 16u);
  EXPECT_EQ(Buffer(*device_, BufferUse::kReadback, 17, "some").size(), 32u);
  EXPECT_FALSE(Buffer());
}

TEST_F(GpuTest, BuffersCountTheirMemoryAndGiveItBack) {
  const std::uint64_t before = device_->allocated_bytes();
  {
    Buffer buffer(*device_, BufferUse::kStorage, 1u << 20u, "a megabyte");
    EXPECT_GE(device_->allocated_bytes(), before + (1u << 20u));
    Buffer moved = std::move(buffer);
    EXPECT_FALSE(buffer);
    EXPECT_TRUE(moved);
    moved = Buffer();
    EXPECT_EQ(device_->allocated_bytes(), before);
  }
  EXPECT_EQ(device_->allocated_bytes(), before);
}

TEST_F(GpuTest, ReserveGrowsByHalfAgainAndOnlyWhenItMust) {
  Buffer buffer(*device_, BufferUse::kUpload, 1024, "grows");
  const std::uint64_t serial = buffer.serial();
  EXPECT_FALSE(buffer.reserve(1024));
  EXPECT_EQ(buffer.serial(), serial);
  EXPECT_TRUE(buffer.reserve(1025));
  EXPECT_NE(buffer.serial(), serial);
  EXPECT_EQ(buffer.size(), 1536u);
  EXPECT_NE(buffer.mapped(), nullptr);
  EXPECT_TRUE(buffer.reserve(10000));
  EXPECT_EQ(buffer.size(), 10000u);
}

TEST_F(GpuTest, ReserveGrowsNoFurtherThanTheDeviceBinds) {
  const VkDeviceSize most = std::min(device_->limits().max_storage_buffer_range, VkDeviceSize{1} << 27u);
  if (most < device_->limits().max_storage_buffer_range)
    GTEST_SKIP() << "the device binds more than this test allocates";
  Buffer buffer(*device_, BufferUse::kStorage, most / 4 * 3, "grows");
  EXPECT_TRUE(buffer.reserve(buffer.size() + 16));
  EXPECT_EQ(buffer.size(), most / 16 * 16);
}

TEST_F(GpuTest, UploadsComeBack) {
  // More than a staging buffer at once, to an odd place.
  const Words words = random_words(5'000'001);
  Buffer buffer(*device_, BufferUse::kStorage, words.size() * 4 + 12, "round trip");
  upload_now(*device_, buffer, std::span<const std::uint32_t>(words), 12);
  EXPECT_EQ(read_now<std::uint32_t>(*device_, buffer, words.size(), 12), words);
  EXPECT_EQ(read_now<std::uint32_t>(*device_, buffer, 2, 12 + 4 * 4'000'000),
            Words({words[4'000'000], words[4'000'001]}));
}

TEST_F(GpuTest, MappedBuffersAreUploadedAndReadWithoutStaging) {
  const Words words = random_words(64);
  Buffer upload(*device_, BufferUse::kUpload, 256, "upload"), readback(*device_, BufferUse::kReadback, 256, "readback");
  upload_now(*device_, upload, std::span<const std::uint32_t>(words));
  device_->run([&](Commands& commands) { commands.copy(upload, readback, 256); });
  EXPECT_TRUE(std::equal(words.begin(), words.end(), readback.mapped_as<std::uint32_t>().begin()));
  EXPECT_EQ(read_now<std::uint32_t>(*device_, readback, 64), words);
}

TEST_F(GpuTest, FillsAndCopies) {
  Buffer a(*device_, BufferUse::kStorage, 64, "a"), b(*device_, BufferUse::kStorage, 64, "b");
  device_->run([&](Commands& commands) {
    commands.fill(a, 0xabcd0123u);
    commands.fill(b, 5);
    commands.barrier();
    commands.copy(a, b, 8, 0, 56);
  });
  Words expected(16, 5);
  expected[14] = expected[15] = 0xabcd0123u;
  EXPECT_EQ(read_now<std::uint32_t>(*device_, b, 16), expected);
}

TEST_F(GpuTest, PipelinesOfTheSameCodeAndConstantsAreOne) {
  const std::vector<SpecializationConstant> some{{0, 32}}, others{{0, 64}};
  const BindingTable table(*device_), another(*device_);
  const ComputePipeline first(*device_, table, test_constants_spv, "first", some);
  EXPECT_EQ(ComputePipeline(*device_, another, test_constants_spv, "again", some).handle(), first.handle());
  EXPECT_NE(ComputePipeline(*device_, table, test_constants_spv, "other constants", others).handle(), first.handle());
  EXPECT_NE(ComputePipeline(*device_, table, test_arithmetic_spv, "other code").handle(), first.handle());
}

TEST_F(GpuTest, ShadersGetSpecialisationAndPushConstants) {
  BindingTable table(*device_);
  Buffer result(*device_, BufferUse::kStorage, 7 * 4, "result");
  table.set_array(shared::kSetFrame, 0, result);
  const std::vector<SpecializationConstant> constants{
      {0, 32}, {1, 0xfedcba98u}, {2, std::bit_cast<std::uint32_t>(0.75f)}, {3, 1}};
  const ComputePipeline pipeline(*device_, table, test_constants_spv, "constants", constants);
  const ComputePipeline plain(*device_, table, test_constants_spv, "plain constants",
                              std::vector<SpecializationConstant>{{0, 1}});
  struct Push {
    std::uint32_t a;
    float b;
    std::uint32_t words[30];
  } push{17, -2.5f, {}};
  push.words[29] = 99;
  static_assert(sizeof(Push) == kPushConstantBytes);
  const auto run = [&](const ComputePipeline& what) {
    device_->run([&](Commands& commands) {
      commands.bind(table);
      commands.push(push);
      commands.dispatch(what, 1);
    });
    return read_now<std::uint32_t>(*device_, result, 7);
  };
  const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
  EXPECT_EQ(run(pipeline), Words({32, 0xfedcba98u, bits(0.75f), 1, 17, bits(-2.5f), 99}));
  EXPECT_EQ(run(plain), Words({1, 1, bits(1.0f), 0, 17, bits(-2.5f), 99}));
}

void expect_bindings_follow_changes(Device& device) {
  constexpr std::uint32_t kCount = 1000;
  BindingTable table(device);
  const ComputePipeline pipeline(device, table, test_arithmetic_spv, "arithmetic");
  const Words words = random_words(kCount);
  Buffer source(device, BufferUse::kStorage, kCount * 4, "source");
  upload_now(device, source, std::span<const std::uint32_t>(words));
  Buffer factors(device, BufferUse::kUniform, sizeof(Factors), "factors");
  factors.mapped_as<Factors>()[0] = {3, 5, kCount, 1};
  table.set_array(shared::kSetScene, 3, source);
  table.set_uniform(shared::kSetScene, factors);
  for (int pass = 0; pass < 4; ++pass) {
    Buffer target(device, BufferUse::kStorage, kCount * 4 << pass, "target");
    table.set_array(shared::kSetFrame, 10, target);
    table.flush();
    device.run([&](Commands& commands) {
      commands.bind(table);
      commands.fill(target, 100);
      commands.barrier();
      commands.dispatch(pipeline, (kCount + 63) / 64);
      commands.barrier();
      commands.dispatch(pipeline, (kCount + 63) / 64);
    });
    const Words result = read_now<std::uint32_t>(device, target, kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(result[i], 100 + 2 * (3 * words[i] + 5)) << i;
  }
}

TEST_F(GpuTest, BindingsReachShadersAndFollowChanges) { expect_bindings_follow_changes(*device_); }

// Buffers that come and go get the same handles again, unless the layers give out their own: the table must notice.
TEST(Bindings, FollowChangesWhereHandlesAreUsedAgain) {
  auto made = Device::create({});
  if (!made) GTEST_SKIP() << "no Vulkan device: " << made.error().message;
  expect_bindings_follow_changes(**made);
}

TEST_F(GpuTest, UnsetBindingsAreHarmless) {
  BindingTable table(*device_);
  const ComputePipeline pipeline(*device_, table, test_arithmetic_spv, "arithmetic");
  device_->run([&](Commands& commands) {
    commands.bind(table);
    commands.dispatch(pipeline, 1);
  });
}

TEST_F(GpuTest, ARunInsideARunGoesFirst) {
  Buffer a(*device_, BufferUse::kStorage, 16, "a"), b(*device_, BufferUse::kStorage, 16, "b");
  device_->run([&](Commands& commands) {
    commands.copy(a, b, 16);
    device_->run([&](Commands& inner) { inner.fill(a, 42); });
  });
  EXPECT_EQ(read_now<std::uint32_t>(*device_, b, 4), Words(4, 42));
}

// Runs and readbacks come after what was started, and a buffer that it writes goes only when it is done.
TEST_F(GpuTest, WhatIsStartedIsFinishedByWhateverComesNext) {
  constexpr std::size_t kCount = 1u << 20u;
  Buffer target(*device_, BufferUse::kStorage, kCount * 4, "target");
  for (const std::uint32_t value : {1u, 2u, 3u}) {
    device_->start([&](Commands& commands) { commands.fill(target, value); });
    if (value == 2) device_->finish();
    EXPECT_EQ(read_now<std::uint32_t>(*device_, target, kCount), Words(kCount, value));
  }
  device_->finish();  // nothing is left to do
  for (const std::uint32_t value : {4u, 5u}) {
    device_->start([&](Commands& commands) { commands.fill(target, value); });
  }
  target = Buffer();
  device_->finish();
  EXPECT_THROW(device_->start([](Commands&) { throw OutOfMemory("in the midst of it"); }), OutOfMemory);
  device_->finish();
}

TEST_F(GpuTest, PassesAreTimed) {
  if (device_->limits().timestamp_period_ns <= 0) GTEST_SKIP() << "the device has no timestamps";
  constexpr std::uint32_t kCount = 4096;
  BindingTable table(*device_);
  const ComputePipeline pipeline(*device_, table, test_arithmetic_spv, "arithmetic");
  Buffer source(*device_, BufferUse::kStorage, kCount * 4, "source"),
      target(*device_, BufferUse::kStorage, kCount * 4, "target");
  Buffer factors(*device_, BufferUse::kUniform, sizeof(Factors), "factors");
  factors.mapped_as<Factors>()[0] = {3, 5, kCount, 2000};
  table.set_array(shared::kSetScene, 3, source);
  table.set_array(shared::kSetFrame, 10, target);
  table.set_uniform(shared::kSetScene, factors);
  PassTimer timer(*device_, 4);
  for (int frame = 0; frame < 2; ++frame) {
    device_->run([&](Commands& commands) {
      timer.reset(commands.handle());
      commands.set_timer(&timer);
      commands.bind(table);
      {
        Commands::Scope scope(commands, "work");
        commands.dispatch(pipeline, kCount / 64);
        commands.barrier();
      }
      Commands::Scope outer(commands, "outer");
      Commands::Scope inner(commands, "inner");
      commands.dispatch(pipeline, kCount / 64);
      commands.barrier();
    });
    const auto times = timer.read();
    ASSERT_EQ(times.size(), 3u);
    EXPECT_EQ(times[0].name, "work");
    EXPECT_EQ(times[1].name, "outer");
    EXPECT_EQ(times[2].name, "inner");
    for (const PassTime& time : times) {
      EXPECT_GT(time.milliseconds, 0.0) << time.name;
      EXPECT_LT(time.milliseconds, 60000.0) << time.name;
    }
    EXPECT_GE(times[1].milliseconds, times[2].milliseconds);
  }
}

TEST_F(GpuTest, BuffersBeyondTheDevicesLimitsAreRefusedBeforeAnythingIsAllocated) {
  const VkDeviceSize before = device_->allocated_bytes();
  const DeviceLimits& limits = device_->limits();
  ASSERT_GT(limits.max_allocation_bytes, 0u);
  EXPECT_THAT([&] { Buffer(*device_, BufferUse::kStorage, limits.max_storage_buffer_range + 16, "too large"); },
              testing::ThrowsMessage<OutOfMemory>(testing::HasSubstr("\"too large\" needs a buffer of")));
  EXPECT_THAT([&] { Buffer(*device_, BufferUse::kReadback, limits.max_allocation_bytes + 16, "larger"); },
              testing::ThrowsMessage<OutOfMemory>(testing::HasSubstr(device_->report().name + " allows")));
  EXPECT_EQ(device_->allocated_bytes(), before);
}

TEST_F(GpuTest, DispatchesBeyondTheDevicesLimitAreRefused) {
  BindingTable table(*device_);
  const ComputePipeline pipeline(*device_, table, test_arithmetic_spv, "arithmetic");
  const std::uint32_t most = device_->limits().max_workgroups[1];
  ASSERT_GT(most, 0u);
  if (most == ~0u) GTEST_SKIP() << "there is no limit";
  EXPECT_THAT(
      [&] {
        device_->run([&](Commands& commands) {
          commands.bind(table);
          commands.dispatch(pipeline, 1, most + 1);
        });
      },
      testing::ThrowsMessage<OutOfMemory>(testing::HasSubstr("\"arithmetic\"")));
}

// The counter that all the others hold to zero does count.
TEST(Validation, CountsMistakes) {
  DeviceOptions options;
  options.validation = true;
  options.synchronization_validation = true;
  auto made = Device::create(options);
  if (!made) GTEST_SKIP() << "no Vulkan device: " << made.error().message;
  Device& device = **made;
  Buffer a(device, BufferUse::kStorage, 64, "a"), b(device, BufferUse::kStorage, 64, "b");
  ASSERT_EQ(device.validation_messages(), 0u);
  device.run([&](Commands& commands) {
    commands.fill(a, 1);
    commands.copy(a, b, 64);  // no barrier: a race
  });
  if (device.validation_messages() == 0) GTEST_SKIP() << "no validation layer with synchronization checks here";
  EXPECT_GT(device.validation_messages(), 0u);
}

}  // namespace
}  // namespace fb::gpu
