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
TEST(Spr, RefusedWhenCut) {
  testing::expect_refused_when_cut(kAttempt, write_spr(small_sprite(SpriteOrientation::kParallel)), "progs/x.spr");
}
TEST(Spr, SoundWhenDamaged) {
  testing::expect_sound_when_damaged(kAttempt, write_spr(small_sprite(SpriteOrientation::kOriented)), "progs/x.spr");
}
TEST(Spr, CountsAndSizes) {
  const Bytes valid = write_spr(small_sprite(SpriteOrientation::kParallel));
  constexpr std::size_t kGroup = 36 + 20 + 24;
  ASSERT_EQ(valid[kGroup + 4], 2);  // the group's number of images
  for (const std::size_t at : {std::size_t{24}, std::size_t{48}, std::size_t{52}, kGroup + 4, kGroup + 24}) {
    for (const std::uint32_t count : {0u, 0xffffffffu, 0x7fffffffu, 0x4000u}) {
      testing::ByteWriter file{valid};
      file.patch_u32(at, count);
      testing::expect_refused(kAttempt, file.out, "progs/x.spr");
    }
  }
}
TEST(Spr, TimesThatAreNone) {
  for (const float time : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    Spr spr = small_sprite(SpriteOrientation::kParallel);
    spr.frames[1].end_times[0] = time;
    const auto parsed = parse_spr(write_spr(spr), "progs/x.spr");
    ASSERT_FALSE(parsed.ok());
    EXPECT_THAT(parsed.error().message, HasSubstr("not positive"));
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
