// Brush models that are .bsp files of their own, as exploding boxes and item boxes are.
#include <gmock/gmock.h>

#include <optional>
#include <string>
#include <vector>

#include "base/log.h"
#include "formats/test_bsp.h"
#include "server/simulation/test_level.h"

namespace fb::sv {
namespace {

using ::testing::HasSubstr;
using testing::MapBuilder;

// A box as a .bsp of its own, as item boxes are.
formats::Bsp box_model(const vec3& mins, const vec3& maxs) {
  MapBuilder map(vec3(-64), vec3(64));
  map.model(mins, maxs);
  formats::Bsp bsp = map.build();
  bsp.models.erase(bsp.models.begin());
  return bsp;
}

constexpr const char* kExplodingBox = R"(
entity box, item;
void() place_box = {
  box = spawn();
  box.classname = "misc_explobox";
  box.solid = SOLID_BSP;
  box.movetype = MOVETYPE_PUSH;
  setmodel(box, "maps/b_box.bsp");
  setorigin(box, '100 0 0');
};
void() drop_item = {
  item = self = spawn();
  item.solid = SOLID_TRIGGER;
  item.movetype = MOVETYPE_TOSS;
  setsize(item, '-8 -8 -8', '8 8 8');
  setorigin(item, '116 16 100');
  puts(ftos(droptofloor()));
};
void() main = {};
)";

class BoxModelTest : public testing::LevelTest {
 protected:
  // Loads maps/b_box.bsp from these bytes, and puts it at 100 0 0.
  void place(const std::optional<Bytes>& file) {
    start_level(kExplodingBox, MapBuilder(vec3(-512, -512, 0), vec3(512, 512, 512)));
    set_log_level(LogLevel::kWarning);
    level().models.push_back(load_model([&](std::string_view) { return file; }, "maps/b_box.bsp"));
    EXPECT_TRUE(call("place_box"));
  }
  MoveTrace move_to_box(const vec3& mins, const vec3& maxs) {
    return sv_move(level(), {vec3(0, 16, 32), mins, maxs, vec3(200, 16, 32)}, MoveKind::kNormal, std::nullopt);
  }
  void SetUp() override {
    LevelTest::SetUp();
    listener_ = add_log_listener([this](LogLevel, std::string_view text) { warnings_.emplace_back(text); });
  }
  void TearDown() override {
    if (listener_) remove_log_listener(*listener_);
    LevelTest::TearDown();
  }
  std::optional<int> listener_;
  std::vector<std::string> warnings_;
};

constexpr vec3 kPlayerMins(-16, -16, -24), kPlayerMaxs(16, 16, 32);

TEST_F(BoxModelTest, BlocksWithHullsOfItsOwn) {
  place(formats::testing::write_bsp(box_model(vec3(0, 0, 0), vec3(32, 32, 64))));
  const MoveTrace hit = move_to_box(vec3(0.0f), vec3(0.0f));
  EXPECT_FLOAT_EQ(hit.end_pos.x, 100.0f - 1.0f / 32.0f);
  EXPECT_EQ(hit.edict, named("box").id());
  EXPECT_FLOAT_EQ(move_to_box(kPlayerMins, kPlayerMaxs).end_pos.x, 84.0f - 1.0f / 32.0f);
  EXPECT_TRUE(call("drop_item"));
  EXPECT_EQ(output(), "[1]");
  EXPECT_EQ(named("item").get(fields::groundentity), named("box").id());
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(BoxModelTest, WithoutHullsItsBoxBlocksAndOneSentenceSaysSo) {
  formats::Bsp bsp = box_model(vec3(0, 0, 0), vec3(32, 32, 64));
  bsp.clip_nodes.clear();
  for (std::size_t hull = 1; hull < 4; ++hull) bsp.models[0].head_nodes[hull] = formats::kContentsEmpty;
  place(formats::testing::write_bsp(bsp));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("maps/b_box.bsp: a model without clip nodes"));
  for (int i = 0; i < 3; ++i) {
    // setmodel's box is a unit wider than the model.
    EXPECT_FLOAT_EQ(move_to_box(kPlayerMins, kPlayerMaxs).end_pos.x, 83.0f - 1.0f / 32.0f);
  }
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_THAT(warnings_[1], HasSubstr("misc_explobox is SOLID_BSP, but its model \"maps/b_box.bsp\" has no hulls"));
}

TEST_F(BoxModelTest, WhatCannotBeReadIsRefusedWhenItIsLoadedAndTheGameGoesOn) {
  Bytes broken = formats::testing::write_bsp(box_model(vec3(0, 0, 0), vec3(32, 32, 64)));
  broken.resize(broken.size() / 2);
  for (const std::optional<Bytes>& file : {std::optional(broken), std::optional<Bytes>()}) {
    warnings_.clear();
    place(file);
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_THAT(warnings_[0], HasSubstr("maps/b_box.bsp: "));
    move_to_box(kPlayerMins, kPlayerMaxs);
    EXPECT_TRUE(call("drop_item"));
    tick(0.1, 5);
    EXPECT_FALSE(level().failed());
  }
}

}  // namespace
}  // namespace fb::sv
