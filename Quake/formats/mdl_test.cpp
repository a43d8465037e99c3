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

TEST(Mdl, RefusedWhenCut) { testing::expect_refused_when_cut(kAttempt, write_mdl(tetrahedron()), "progs/x.mdl"); }
TEST(Mdl, SoundWhenDamaged) { testing::expect_sound_when_damaged(kAttempt, write_mdl(tetrahedron()), "progs/x.mdl"); }

TEST(Mdl, CountsBeyondTheFileOrBelowOne) {
  // Skins, width, height, vertices, triangles, frames; then the group's counts.
  for (const std::size_t at : {48u, 52u, 56u, 60u, 64u, 68u, 84u + 36u + 4u, 360u}) {
    for (const std::uint32_t count : {0xffffffffu, 0x7fffffffu, 0x10000u, 0u}) {
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
  Mdl mdl = tetrahedron();
  mdl.triangles[2].vertices[1] = 4;
  expect_refused(mdl, "triangle names vertex 4 of 4");
  mdl.triangles[2].vertices[1] = 0xffffffffu;
  expect_refused(mdl, "triangle names vertex");
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
