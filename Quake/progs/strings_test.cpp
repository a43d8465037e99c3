#include "progs/strings.h"

#include <gtest/gtest.h>

#include <set>

namespace fb::progs {
namespace {

class StringsTest : public ::testing::Test {
 protected:
  std::vector<char> block_{0, 'a', 'b', 'c', 0, 'd', 0};
  StringTable table_{block_};
};

TEST_F(StringsTest, OfTheProgsAnyOffset) {
  EXPECT_EQ(table_.find(StringId{0}), "");
  EXPECT_EQ(table_.find(StringId{1}), "abc");
  EXPECT_EQ(table_.find(StringId{2}), "bc");
  EXPECT_EQ(table_.find(StringId{6}), "");
  EXPECT_EQ(table_.find(StringId{7}), std::nullopt);
  EXPECT_EQ(table_.find(StringId{INT32_MAX}), std::nullopt);
}

TEST_F(StringsTest, WhatIsNoneIsNone) {
  EXPECT_EQ(table_.find(StringId{INT32_MIN}), std::nullopt);
  EXPECT_EQ(table_.find(StringId{-1 - static_cast<int>(StringTable::kTemporaries)}), std::nullopt);
  EXPECT_EQ(table_.find(StringId{-1}), "");  // a temporary that was not given out yet
  EXPECT_EQ(table_.text(StringId{INT32_MIN}), "");
}

TEST_F(StringsTest, TemporariesLastUntilTheRingComesRound) {
  const StringId first = table_.temporary("first");
  for (std::size_t i = 1; i < StringTable::kTemporaries; ++i) table_.temporary(std::to_string(i));
  EXPECT_EQ(table_.text(first), "first");
  EXPECT_EQ(table_.temporary("again"), first);
  EXPECT_EQ(table_.text(first), "again");
}

TEST_F(StringsTest, BigTemporariesMakeTheOldestEmpty) {
  const std::string big(StringTable::kMaxLength, 'x');
  const std::size_t fit = StringTable::kMaxTemporaryBytes / big.size();
  const StringId first = table_.temporary(big);
  for (std::size_t i = 1; i < fit; ++i) table_.temporary(big);
  EXPECT_EQ(table_.text(first), big);
  const StringId newest = table_.temporary(big);
  EXPECT_EQ(table_.text(first), "");
  EXPECT_EQ(table_.text(newest), big);
  EXPECT_LE(table_.temporary_bytes(), StringTable::kMaxTemporaryBytes);
  for (std::size_t i = 0; i < 2 * StringTable::kTemporaries; ++i) table_.temporary(big);
  EXPECT_LE(table_.temporary_bytes(), StringTable::kMaxTemporaryBytes);
}

TEST_F(StringsTest, ATemporaryMayBeMadeFromTheOldest) {
  const StringId first = table_.temporary("first and long enough to lie on the heap");
  for (std::size_t i = 1; i < StringTable::kTemporaries; ++i) table_.temporary("");
  const StringId made = table_.temporary(table_.text(first));
  EXPECT_EQ(made, first);
  EXPECT_EQ(table_.text(made), "first and long enough to lie on the heap");
}

TEST_F(StringsTest, TooLongOnesAreCut) {
  const std::string long_text(StringTable::kMaxLength + 5, 'x');
  EXPECT_EQ(table_.text(table_.temporary(long_text)).size(), StringTable::kMaxLength);
  EXPECT_EQ(table_.text(table_.zone(long_text)).size(), StringTable::kMaxLength);
  EXPECT_EQ(table_.text(table_.temporary(std::string_view("a\0b", 3))), "a");
}

TEST_F(StringsTest, InternedOnesAreOneEach) {
  const StringId a = table_.intern("progs/player.mdl");
  EXPECT_EQ(table_.intern("progs/player.mdl"), a);
  EXPECT_NE(table_.intern("progs/Player.mdl"), a);
  EXPECT_NE(table_.allocate("progs/player.mdl"), a);
  EXPECT_EQ(table_.text(a), "progs/player.mdl");
}

TEST_F(StringsTest, KeptOnesStayWhereTheyAre) {
  const StringId id = table_.allocate("short");
  const char* const at = table_.c_str(id);
  for (int i = 0; i < 10000; ++i) table_.allocate("other");
  EXPECT_EQ(table_.c_str(id), at);
}

TEST_F(StringsTest, ZoneStringsComeAndGo) {
  const std::size_t before = table_.kept_bytes();
  const StringId id = table_.zone("kept");
  EXPECT_EQ(table_.text(id), "kept");
  EXPECT_TRUE(table_.unzone(id));
  EXPECT_EQ(table_.find(id), std::nullopt);
  EXPECT_FALSE(table_.unzone(id));
  EXPECT_EQ(table_.kept_bytes(), before);
  for (int i = 0; i < 100000; ++i) {
    const StringId next = table_.zone("round and round");
    EXPECT_TRUE(table_.unzone(next));
  }
  EXPECT_EQ(table_.kept_bytes(), before);
}

TEST_F(StringsTest, OnlyZoneStringsAreGivenBack) {
  for (const StringId id : {StringId{0}, StringId{1}, table_.temporary("t"), table_.intern("i"), table_.allocate("a"),
                            StringId{INT32_MIN}, StringId{INT32_MAX}}) {
    EXPECT_FALSE(table_.unzone(id));
  }
}

TEST_F(StringsTest, TooMuchIsRefused) {
  const std::string big(StringTable::kMaxLength, 'x');
  StringId id = StringId{-1};
  int kept = 0;
  while (id != StringId::kNull && kept < 100000) {
    id = table_.zone(big);
    ++kept;
  }
  EXPECT_EQ(id, StringId::kNull);
  EXPECT_LE(table_.kept_bytes(), StringTable::kMaxBytes);
}

}  // namespace
}  // namespace fb::progs
