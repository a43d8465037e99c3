// Alias models: round trip, groups, damage, and the small faults that are mended.
#include "formats/mdl.h"

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
using testing::tetrahedron;
using testing::write_mdl;

const testing::Attempt kAttempt = testing::attempt([](const Bytes& bytes) { return parse_mdl(bytes, "progs/x.mdl"); },
                                                   [](const Mdl& mdl) { return testing::broken(mdl); });

void expect_refused(const Mdl& mdl, const std::string& cause) {
  const Bytes file = write_mdl(mdl);
  const auto parsed = parse_mdl(file, "progs/x.mdl");
  ASSERT_FALSE(parsed.ok()) << "taken, though: " << cause;
  EXPECT_THAT(parsed.error().message, HasSubstr(cause));
  EXPECT_TRUE(testing::names_place(parsed.error().message, "progs/x.mdl", file.size()));
}

TEST(Mdl, RoundTrips) {
  const Bytes file = write_mdl(tetrahedron());
  const auto mdl = parse_mdl(file, "progs/x.mdl");
  ASSERT_TRUE(mdl.ok()) << mdl.error().message;
  EXPECT_EQ(testing::broken(*mdl), "");
  EXPECT_TRUE(mdl->warnings.empty());
  EXPECT_EQ(write_mdl(*mdl), file);
  EXPECT_EQ(mdl->frames[1].name, "run1");
  EXPECT_EQ(mdl->frames[1].pose_count, 2u);
  EXPECT_EQ(mdl->vertices[4 * 1 + 2].x, 60);
  EXPECT_EQ(mdl->skins[1].images[1].indices[0], 3);
  EXPECT_EQ(mdl->skins[1].end_times[1], 0.75f);
  EXPECT_TRUE(mdl->tex_coords[3].on_seam);
  EXPECT_FALSE(mdl->triangles[1].faces_front);
  EXPECT_EQ(mdl->flags, kMdlRocket | kMdlHoley);
}

// Refused up to the end of the first frame; from there on the frames that are whole are used.
TEST(Mdl, WhenCutWhatIsWholeIsUsed) {
  const Bytes whole = write_mdl(tetrahedron());
  const std::size_t first_frame_ends = 356;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    if (length < first_frame_ends) {
      testing::expect_refused(kAttempt, cut, "progs/x.mdl");
      continue;
    }
    const auto mdl = parse_mdl(cut, "progs/x.mdl");
    ASSERT_TRUE(mdl.ok()) << length << ": " << mdl.error().message;
    ASSERT_EQ(testing::broken(*mdl), "") << length;
    EXPECT_EQ(mdl->frames.size(), 1u) << length;
    ASSERT_EQ(mdl->warnings.size(), 1u);
    EXPECT_THAT(mdl->warnings[0], HasSubstr("; of 2 frames the first 1 are used"));
    ASSERT_TRUE(testing::names_place(mdl->warnings[0], "progs/x.mdl", length));
  }
}
TEST(Mdl, MoreFramesSaidThanThereAre) {
  for (const std::uint32_t count : {3u, 0x7fffffffu}) {
    testing::ByteWriter file{write_mdl(tetrahedron())};
    file.patch_u32(68, count);
    const auto mdl = parse_mdl(file.out, "x");
    ASSERT_TRUE(mdl.ok());
    EXPECT_EQ(testing::broken(*mdl), "");
    EXPECT_EQ(mdl->frames.size(), 2u);
    EXPECT_EQ(mdl->warnings.size(), 1u);
  }
}
// A group of no frames, or of more than there are.
TEST(Mdl, ABrokenGroupCostsItselfAndWhatFollows) {
  for (const std::uint32_t count : {0xffffffffu, 0x7fffffffu, 0x10000u, 0u}) {
    testing::ByteWriter file{write_mdl(tetrahedron())};
    file.patch_u32(360, count);
    const auto mdl = parse_mdl(file.out, "x");
    ASSERT_TRUE(mdl.ok());
    EXPECT_EQ(testing::broken(*mdl), "");
    EXPECT_EQ(mdl->frames.size(), 1u);
    ASSERT_EQ(mdl->warnings.size(), 1u);
    EXPECT_THAT(mdl->warnings[0], HasSubstr("is empty or runs past the file's end"));
  }
}
TEST(Mdl, SoundWhenDamaged) { testing::expect_sound_when_damaged(kAttempt, write_mdl(tetrahedron()), "progs/x.mdl"); }

TEST(Mdl, CountsBeyondTheFileOrBelowOne) {
  // Skins, width, height, vertices, triangles, frames; then the count of a group of skins. Too many frames are mended.
  for (const std::size_t at : {48u, 52u, 56u, 60u, 64u, 68u, 84u + 36u + 4u}) {
    for (const std::uint32_t count : {0xffffffffu, 0x7fffffffu, 0x10000u, 0u}) {
      if (at == 68 && static_cast<std::int32_t>(count) > 0) continue;
      testing::ByteWriter file{write_mdl(tetrahedron())};
      file.patch_u32(at, count);
      testing::expect_refused(kAttempt, file.out, "progs/x.mdl");
    }
  }
}
// The place that the test above calls the group's count is that.
TEST(Mdl, GroupCountIsWhereTheTestsLook) {
  const Bytes file = write_mdl(tetrahedron());
  EXPECT_EQ(file[84 + 36], 1);
  EXPECT_EQ(file[84 + 36 + 4], 2);
  EXPECT_EQ(file[356], 1);
  EXPECT_EQ(file[360], 2);
}

TEST(Mdl, WrongMagicOrVersion) {
  Bytes file = write_mdl(tetrahedron());
  file[4] = 7;
  EXPECT_THAT(parse_mdl(file, "x").error().message, HasSubstr("version 7"));
  file[0] = 'X';
  EXPECT_THAT(parse_mdl(file, "x").error().message, HasSubstr("IDPO"));
}

TEST(Mdl, TriangleVertex) {
  for (const std::uint32_t vertex : {4u, 0xffffffffu}) {
    Mdl mdl = tetrahedron();
    const std::size_t count = mdl.triangles.size();
    mdl.triangles[2].vertices[1] = vertex;
    const auto mended = parse_mdl(write_mdl(mdl), "x");
    ASSERT_TRUE(mended.ok()) << mended.error().message;
    EXPECT_EQ(testing::broken(*mended), "");
    EXPECT_EQ(mended->triangles.size(), count - 1);
    ASSERT_EQ(mended->warnings.size(), 1u);
    EXPECT_THAT(mended->warnings[0], HasSubstr("triangle names a vertex beyond those there are; left out"));
    for (MdlTriangle& triangle : mdl.triangles) triangle.vertices[0] = vertex;
    expect_refused(mdl, "every triangle names a vertex");
  }
}

TEST(Mdl, NotFinite) {
  Mdl mdl = tetrahedron();
  mdl.scale.y = std::numeric_limits<float>::quiet_NaN();
  expect_refused(mdl, "scale is not finite");
  mdl = tetrahedron();
  mdl.bounding_radius = std::numeric_limits<float>::infinity();
  const auto mended = parse_mdl(write_mdl(mdl), "x");
  ASSERT_TRUE(mended.ok());
  EXPECT_EQ(mended->bounding_radius, 0.0f);
  EXPECT_EQ(mended->warnings.size(), 1u);
}

TEST(Mdl, NormalsBeyondTheTable) {
  Mdl mdl = tetrahedron();
  mdl.vertices[2].normal = 162;
  mdl.vertices[3].normal = 255;
  const auto mended = parse_mdl(write_mdl(mdl), "x");
  ASSERT_TRUE(mended.ok());
  EXPECT_EQ(mended->vertices[2].normal, 0);
  EXPECT_EQ(mended->vertices[3].normal, 0);
  ASSERT_EQ(mended->warnings.size(), 1u);
  EXPECT_THAT(mended->warnings[0], HasSubstr("162"));
}

TEST(Mdl, GroupTimes) {
  Mdl mdl = tetrahedron();
  mdl.frames[1].end_times = {0.3f, 0.2f};
  const auto held = parse_mdl(write_mdl(mdl), "x");
  ASSERT_TRUE(held.ok());
  EXPECT_EQ(held->frames[1].end_times, (std::vector<float>{0.3f, 0.3f}));
  mdl.frames[1].end_times = {0.0f, std::numeric_limits<float>::quiet_NaN()};
  const auto mended = parse_mdl(write_mdl(mdl), "x");
  ASSERT_TRUE(mended.ok());
  EXPECT_EQ(mended->frames[1].end_times, (std::vector<float>{0.1f, 0.2f}));
  EXPECT_EQ(mended->warnings.size(), 1u);
}

// Shapes that exist: very wide skins, hundreds of frames.
TEST(Mdl, LargeButReal) {
  Mdl mdl = tetrahedron();
  mdl.skin_width = 4096;
  mdl.skin_height = 256;
  mdl.skins = {{{{4096, 256, std::vector<std::uint8_t>(4096 * 256, 7)}}, {}}};
  mdl.frames.clear();
  mdl.vertices.clear();
  mdl.pose_count = 250;
  for (std::uint32_t i = 0; i < 250; ++i) {
    mdl.frames.push_back({"frame" + std::to_string(i), i, 1, {}});
    for (std::uint8_t k = 0; k < 4; ++k) mdl.vertices.push_back({k, k, k, k});
  }
  const Bytes file = write_mdl(mdl);
  const auto parsed = parse_mdl(file, "x");
  ASSERT_TRUE(parsed.ok()) << parsed.error().message;
  EXPECT_EQ(testing::broken(*parsed), "");
  EXPECT_EQ(write_mdl(*parsed), file);
}

}  // namespace
}  // namespace fb::formats
