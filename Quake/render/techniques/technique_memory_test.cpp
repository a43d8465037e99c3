// What a technique keeps: sizes, halves that change places, and that nothing survives what it must not.
#include "render/techniques/technique_memory.h"

#include <algorithm>
#include <vector>

#include "base/out_of_memory.h"
#include "render/test_device.h"
#include "shared/bindings.h"

namespace fb::render {
namespace {

constexpr ArrayRow kTestRows[]{{0, "test table", ArrayRow::Per::kTable, 4, false},
                               {1, "test pixels", ArrayRow::Per::kPixel, 16, true},
                               {2, "test probes", ArrayRow::Per::kProbe, 8, false}};

class TechniqueMemoryTest : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (!device_) return;
    table_ = std::make_unique<gpu::BindingTable>(*device_);
    memory_ = std::make_unique<TechniqueMemory>(*device_, *table_, kTestRows, "test reset");
  }
  void TearDown() override {
    memory_.reset();
    table_.reset();
    DeviceTest::TearDown();
  }

  // A frame: whether all was zeroed; then every array holds the number 7.
  bool frame(uvec2 pixels) {
    const bool fresh = memory_->begin_frame(pixels);
    PassList list;
    memory_->add_reset(list);
    device_->run([&](gpu::Commands& commands) {
      commands.bind(*table_);
      list.record(commands);
    });
    for (const ArrayRow& row : kTestRows) {
      const auto words =
          gpu::read_now<std::uint32_t>(*device_, memory_->buffer(row.binding), memory_->buffer(row.binding).size() / 4);
      EXPECT_TRUE(std::ranges::all_of(words, [&](std::uint32_t word) { return word == (fresh ? 0u : 7u); }))
          << row.name;
      device_->run([&](gpu::Commands& commands) {
        commands.fill(memory_->buffer(row.binding), 7);
        commands.barrier();
      });
    }
    return fresh;
  }

  std::unique_ptr<gpu::BindingTable> table_;
  std::unique_ptr<TechniqueMemory> memory_;
};

TEST_F(TechniqueMemoryTest, KeepsUntilItIsToForgetOrHasAnotherSize) {
  memory_->set_count(0, 100, 12);
  memory_->set_count(2, 6);
  EXPECT_TRUE(frame({8, 8}));
  EXPECT_EQ(memory_->buffer(0).size(), 416u);  // 100 * 4 + 12, in sixteens
  EXPECT_EQ(memory_->buffer(1).size(), 2u * 64 * 16);
  EXPECT_EQ(memory_->bytes(), 416u + 2048u + 48u);
  EXPECT_FALSE(frame({8, 8}));
  memory_->forget();
  EXPECT_TRUE(frame({8, 8}));
  EXPECT_FALSE(frame({8, 8}));
  EXPECT_TRUE(frame({13, 5})) << "pixels";
  EXPECT_FALSE(frame({13, 5}));
  memory_->set_count(0, 101, 12);
  EXPECT_FALSE(frame({13, 5})) << "as large in memory";
  memory_->set_count(2, 12);
  EXPECT_TRUE(frame({13, 5})) << "probes";
  EXPECT_FALSE(frame({13, 5}));
  EXPECT_TRUE(frame({5, 13})) << "as many pixels, each of which is elsewhere";
  EXPECT_FALSE(frame({5, 13}));
}

TEST_F(TechniqueMemoryTest, HalvesChangePlacesEachFrame) {
  memory_->begin_frame({8, 8});
  const std::uint32_t now = memory_->now(1), former = memory_->former(1);
  EXPECT_EQ(now + former, 64u) << "one begins at 0, one at 64";
  memory_->begin_frame({8, 8});
  EXPECT_EQ(memory_->now(1), former);
  EXPECT_EQ(memory_->former(1), now);
  EXPECT_EQ(memory_->now(0), 0u) << "a table has one half";
  EXPECT_EQ(memory_->former(0), 0u);
}

// A frame that could not be made must not leave arrays of former contents that are taken for zero.
TEST_F(TechniqueMemoryTest, WhatIsToBeZeroedStaysSoUntilThePass) {
  EXPECT_TRUE(memory_->begin_frame({8, 8}));
  EXPECT_TRUE(memory_->begin_frame({8, 8})) << "no pass has zeroed it";
  EXPECT_TRUE(frame({8, 8}));
  EXPECT_FALSE(memory_->begin_frame({8, 8}));
}

TEST_F(TechniqueMemoryTest, TablesFitTheDevice) {
  gpu::DeviceOptions options;
  options.most_buffer_bytes = 1 << 20;
  auto small = gpu::Device::create(options);
  ASSERT_TRUE(small.ok()) << small.error().message;
  gpu::BindingTable table(**small);
  TechniqueMemory memory(**small, table, kTestRows, "test reset");
  EXPECT_EQ(memory.most_elements(0), (1u << 20) / 4);
  EXPECT_EQ(memory.most_elements(0, 400), ((1u << 20) - 400) / 4);
  EXPECT_EQ(memory.most_elements(1), (1u << 20) / 32) << "two halves";
  memory.set_count(0, memory.most_elements(0));
  EXPECT_TRUE(memory.begin_frame({1, 1}));
  memory.set_count(0, memory.most_elements(0) + 4);
  EXPECT_THROW(memory.begin_frame({1, 1}), OutOfMemory);
  memory.set_count(0, 16);
  EXPECT_TRUE(memory.begin_frame({1, 1})) << "it can be made again";
}

}  // namespace
}  // namespace fb::render
