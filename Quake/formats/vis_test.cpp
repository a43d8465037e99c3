// External .vis files: a record replaces a map's visibility and leafs; a record that does not fit the map is an error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/bsp.h"
#include "formats/invariants.h"
#include "formats/test_bsp.h"
#include "formats/test_bytes.h"
#include "formats/test_corruption.h"

namespace fb::formats {
namespace {

using testing::box_room;
using ::testing::HasSubstr;

class Vis : public ::testing::Test {
 protected:
  Vis() : map_(box_room(BspVersion::kBsp29)), changed_(map_), other_(map_) {
    changed_.visibility = {0, 3, 1};
    changed_.leafs[1].vis_offset = 2;
    changed_.leafs[1].ambient = {9, 8, 7, 6};
    other_.leafs.resize(1);
  }
  Bytes file() const { return testing::write_vis({{"other.bsp", other_}, {"Room.bsp", changed_}}); }
  testing::Attempt attempt() const {
    return testing::attempt([this](const Bytes& bytes) { return parse_vis(bytes, "x.vis", "room.bsp", map_); },
                            [this](const std::optional<VisRecord>& record) {
                              return record ? testing::broken_leafs(record->leafs, map_.mark_faces.size(),
                                                                    record->visibility.size())
                                            : std::string();
                            });
  }
  Bsp map_, changed_, other_;
};

TEST_F(Vis, ReplacesLeafs) {
  const auto record = parse_vis(file(), "x.vis", "room.bsp", map_);
  ASSERT_TRUE(record.ok()) << record.error().message;
  ASSERT_TRUE(record->has_value());
  EXPECT_EQ((*record)->visibility, changed_.visibility);
  ASSERT_EQ((*record)->leafs.size(), 2u);
  EXPECT_EQ((*record)->leafs[1].vis_offset, 2);
  EXPECT_EQ((*record)->leafs[1].ambient, changed_.leafs[1].ambient);
  EXPECT_EQ((*record)->leafs[1].mins, map_.leafs[1].mins);
}
TEST_F(Vis, NoRecord) {
  const auto record = parse_vis(file(), "x.vis", "start.bsp", map_);
  ASSERT_TRUE(record.ok());
  EXPECT_FALSE(record->has_value());
}
TEST_F(Vis, RecordOfNothing) {
  const auto record = parse_vis(Bytes(36 * 1000), "x.vis", "room.bsp", map_);
  ASSERT_FALSE(record.ok());
  EXPECT_EQ(record.error().message, "x.vis: offset 0: record of 0 bytes has no visibility and leafs");
}
TEST_F(Vis, LeafsOfAnotherMap) {
  const auto record = parse_vis(file(), "x.vis", "other.bsp", map_);
  ASSERT_FALSE(record.ok());
  EXPECT_THAT(record.error().message, HasSubstr("the map has 2 leafs"));
}
TEST_F(Vis, MapOfAnotherVersion) {
  const auto record = parse_vis(file(), "x.vis", "room.bsp", box_room(BspVersion::kBsp2));
  ASSERT_FALSE(record.ok());
  EXPECT_THAT(record.error().message, HasSubstr("BSP29"));
}
// The sizes inside a record are held against the record, not against the file.
TEST_F(Vis, RecordTooSmallForItsParts) {
  const Bytes valid = file();
  constexpr std::size_t kRecord = 36 + 8 + 1 + 28 + 32;  // offset of the second record's size
  for (const std::uint32_t missing : {1u, 56u, 58u, 62u}) {
    testing::ByteWriter cut{valid};
    cut.patch_u32(kRecord, 4 + 3 + 4 + 56 - missing);
    testing::expect_refused(attempt(), cut.out, "x.vis");
  }
}
TEST_F(Vis, RefusedWhenCut) {
  const Bytes valid = file();
  const std::size_t second = 32 + 4 + 8 + 1 + 28;  // between two records is a good end
  for (std::size_t length = 1; length < valid.size(); ++length) {
    if (length == second) continue;
    testing::expect_refused(attempt(), Bytes(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(length)),
                            "x.vis");
  }
}
TEST_F(Vis, SoundWhenDamaged) { testing::expect_sound_when_damaged(attempt(), file(), "x.vis"); }

}  // namespace
}  // namespace fb::formats
