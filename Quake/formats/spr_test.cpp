// Sprites: round trip in every orientation, groups, damage.
#include "formats/spr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "formats/invariants.h"
#include "formats/test_bytes.h"
#include "formats/test_corruption.h"
#include "formats/test_models.h"

namespace fb::formats {
namespace {

using ::testing::HasSubstr;
using testing::small_sprite;
using testing::write_spr;

const testing::Attempt kAttempt = testing::attempt([](const Bytes& bytes) { return parse_spr(bytes, "progs/x.spr"); },
                                                   [](const Spr& spr) { return testing::broken(spr); });

TEST(Spr, RoundTrips) {
  for (int orientation = 0; orientation < 5; ++orientation) {
    const Bytes file = write_spr(small_sprite(static_cast<SpriteOrientation>(orientation)));
    const auto spr = parse_spr(file, "progs/x.spr");
    ASSERT_TRUE(spr.ok()) << spr.error().message;
    EXPECT_EQ(testing::broken(*spr), "");
    EXPECT_EQ(static_cast<int>(spr->orientation), orientation);
    EXPECT_EQ(spr->frames[1].images[0].image.indices[0], 255);
    EXPECT_EQ(spr->frames[1].images[0].origin_y, 2);
    EXPECT_EQ(write_spr(*spr), file);
  }
}
// Refused up to the end of the first frame; from there on the frames that are whole are used.
TEST(Spr, WhenCutWhatIsWholeIsUsed) {
  const Bytes whole = write_spr(small_sprite(SpriteOrientation::kParallel));
  constexpr std::size_t kFirstFrameEnds = 36 + 20 + 24;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    if (length < kFirstFrameEnds) {
      testing::expect_refused(kAttempt, cut, "progs/x.spr");
      continue;
    }
    const auto spr = parse_spr(cut, "progs/x.spr");
    ASSERT_TRUE(spr.ok()) << length << ": " << spr.error().message;
    ASSERT_EQ(testing::broken(*spr), "") << length;
    EXPECT_EQ(spr->frames.size(), 1u) << length;
    ASSERT_EQ(spr->warnings.size(), 1u);
    EXPECT_THAT(spr->warnings[0], HasSubstr("; of 2 frames the first 1 are used"));
    EXPECT_TRUE(testing::names_place(spr->warnings[0], "progs/x.spr", length));
  }
}
TEST(Spr, SoundWhenDamaged) {
  testing::expect_sound_when_damaged(kAttempt, write_spr(small_sprite(SpriteOrientation::kOriented)), "progs/x.spr");
}
TEST(Spr, CountsAndSizes) {
  const Bytes valid = write_spr(small_sprite(SpriteOrientation::kParallel));
  constexpr std::size_t kGroup = 36 + 20 + 24;
  ASSERT_EQ(valid[kGroup + 4], 2);  // the group's number of images
  // Frames; the first one's width and height; the group's number of images, the width of its first.
  for (const std::size_t at : {std::size_t{24}, std::size_t{48}, std::size_t{52}, kGroup + 4, kGroup + 24}) {
    for (const std::uint32_t count : {0u, 0xffffffffu, 0x7fffffffu, 0x4000u}) {
      testing::ByteWriter file{valid};
      file.patch_u32(at, count);
      const auto spr = parse_spr(file.out, "progs/x.spr");
      if (!spr) {
        EXPECT_LT(at, kGroup) << "the first frame is whole";
        EXPECT_TRUE(testing::names_place(spr.error().message, "progs/x.spr", file.out.size()));
        continue;
      }
      EXPECT_TRUE(at == 24 || at >= kGroup || count == 0) << at;
      EXPECT_EQ(testing::broken(*spr), "");
      EXPECT_FALSE(spr->warnings.empty());
    }
  }
}
// Seen as nothing, so that the other frames keep their numbers.
TEST(Spr, AFrameWithoutTexelsIsClear) {
  Spr sprite = small_sprite(SpriteOrientation::kParallel);
  sprite.frames[0].images[0].image = {0, 4, {}};
  const auto spr = parse_spr(write_spr(sprite), "progs/x.spr");
  ASSERT_TRUE(spr.ok()) << spr.error().message;
  ASSERT_EQ(spr->frames.size(), 2u);
  EXPECT_EQ(spr->frames[0].images[0].image.indices, std::vector<std::uint8_t>{255});
  EXPECT_EQ(spr->frames[1].images[1].image.indices[0], 8);
  ASSERT_EQ(spr->warnings.size(), 1u);
  EXPECT_THAT(spr->warnings[0], HasSubstr("frame without texels"));
}
TEST(Spr, TimesThatAreNone) {
  for (const float time : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    Spr spr = small_sprite(SpriteOrientation::kParallel);
    spr.frames[1].end_times[0] = time;
    const auto parsed = parse_spr(write_spr(spr), "progs/x.spr");
    ASSERT_TRUE(parsed.ok()) << parsed.error().message;
    EXPECT_EQ(parsed->frames[1].end_times, (std::vector<float>{0.1f, 0.2f}));
    ASSERT_EQ(parsed->warnings.size(), 1u);
    EXPECT_THAT(parsed->warnings[0], HasSubstr("not positive"));
  }
}
TEST(Spr, WrongMagicVersionOrientation) {
  Bytes file = write_spr(small_sprite(SpriteOrientation::kOriented));
  file[8] = 77;
  EXPECT_EQ(parse_spr(file, "x")->orientation, SpriteOrientation::kParallel);
  file[4] = 2;
  EXPECT_THAT(parse_spr(file, "x").error().message, HasSubstr("version 2"));
  file[0] = 'X';
  EXPECT_THAT(parse_spr(file, "x").error().message, HasSubstr("IDSP"));
}

}  // namespace
}  // namespace fb::formats
