// MD5 and MD3: places of vertices in each pose against what their joints say, and files that are wrong.
#include "formats/posed_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "formats/invariants.h"
#include "formats/test_corruption.h"
#include "formats/test_posed_models.h"

namespace fb::formats {
namespace {

using ::testing::HasSubstr;
using testing::small_md3;
using testing::small_md5anim;
using testing::small_md5mesh;

Result<PosedModel> parse_pair(const std::string& mesh, const std::string& anim) {
  return parse_md5({mesh, "progs/x.md5mesh"}, Md5Text{anim, "progs/x.md5anim"});
}

void expect_at(const PosedModel& model, std::uint32_t pose, std::uint32_t vertex, const vec3& wanted) {
  const vec3& p = model.positions[pose * model.vertex_count + vertex];
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p[axis], wanted[axis], 1e-5) << pose << " " << vertex << " " << axis;
}

TEST(Md5, WithoutAnimationItIsAsItWasBound) {
  const auto model = parse_md5({small_md5mesh(), "progs/x.md5mesh"}, std::nullopt);
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ(testing::broken(*model), "");
  EXPECT_EQ(model->surfaces.front().shader, "progs/thing");
  EXPECT_EQ(model->pose_count, 1u);
  EXPECT_EQ(model->uv[1], vec2(0.5f, 0.25f));
  expect_at(*model, 0, 0, vec3(8, 0, 0));
  expect_at(*model, 0, 3, vec3(0, 0, 20));
}

TEST(Md5, ACornerGoesWithItsJoints) {
  const auto model = parse_pair(small_md5mesh(), small_md5anim());
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ(testing::broken(*model), "");
  ASSERT_EQ(model->pose_count, 3u);
  expect_at(*model, 0, 3, vec3(0, 0, 20));
  // The fourth number of an orientation is not above zero: (s, 0, 0) is a quarter turn about -x.
  expect_at(*model, 1, 3, 0.5f * (vec3(0, 0, 20) + vec3(0, 10, 10)));
  expect_at(*model, 1, 1, vec3(-4, 7, 0));
  expect_at(*model, 2, 3, vec3(1, 2, 23));
  expect_at(*model, 2, 0, vec3(9, 2, 3));
}

TEST(Md5, JointsAreKnownByTheirNames) {
  const auto model = parse_pair(small_md5mesh(), small_md5anim(/*swapped=*/true));
  ASSERT_TRUE(model.ok()) << model.error().message;
  expect_at(*model, 1, 3, 0.5f * (vec3(0, 0, 20) + vec3(0, 10, 10)));
  expect_at(*model, 2, 0, vec3(9, 2, 3));
}

TEST(Md5, ABadTextIsRefusedWithItsLine) {
  struct Case {
    bool in_mesh;
    std::string from, to, says;
  };
  const Case cases[] = {
      {true, "MD5Version 10", "MD5Version 11", "(line 1): the version is \"11\""},
      {true, "numJoints 2", "numJoints 3", "(line 12): a joint's parent"},
      {true, "\"tip\"\t0", "\"tip\"\t1", "a joint's parent"},
      {true, "vert 3 ( 0.5 1 ) 3 2", "vert 3 ( 0.5 1 ) 3 3", "weights that are not there"},
      {true, "vert 3 ( 0.5 1 ) 3 2", "vert 3 ( 0.5 1 ) 3 65", "number of weights"},
      {true, "tri 3 2 3 0", "tri 3 2 4 0", "a triangle's vertex"},
      {true, "weight 4 1 0.5", "weight 4 2 0.5", "a weight's joint"},
      {true, "weight 4 1 0.5", "weight 4 1 nan", "a number is wanted"},
      {false, "numJoints 2", "numJoints 1", "it has 1 joints, its mesh 2"},
      {false, "numFrames 3", "numFrames 4", "\"(\" is wanted"},
      {false, "numFrames 3", "numFrames 3000000", "are too much"},
      {false, "0 8 0", "0 8 4", "numbers that are not there"},
      {false, "frame 1", "frame 2", "a frame's number"},
  };
  for (const Case& c : cases) {
    std::string mesh = small_md5mesh(), anim = small_md5anim();
    std::string& text = c.in_mesh ? mesh : anim;
    const std::size_t at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    text.replace(at, c.from.size(), c.to);
    const auto model = parse_pair(mesh, anim);
    ASSERT_FALSE(model.ok()) << c.to;
    EXPECT_THAT(model.error().message, HasSubstr(c.says)) << c.to;
    EXPECT_THAT(model.error().message, HasSubstr(c.in_mesh ? "progs/x.md5mesh: offset" : "progs/x.md5anim: offset"));
  }
}

TEST(Md5, AVertexThatIsNowhereIsRefused) {
  std::string mesh = small_md5mesh();
  mesh.replace(mesh.find("weight 4 1 0.5 ( 0 0 10 )"), 25, "weight 4 1 1e38 ( 0 0 10 )");
  const auto model = parse_pair(mesh, small_md5anim());
  ASSERT_FALSE(model.ok());
  EXPECT_THAT(model.error().message, HasSubstr("a vertex is nowhere"));
}

TEST(Md5, AnyTextIsRefusedOrSound) {
  const std::string mesh = small_md5mesh(), anim = small_md5anim();
  for (std::size_t length = 0; length < mesh.size(); length += 3) {
    const auto cut = parse_pair(mesh.substr(0, length), anim);
    EXPECT_FALSE(cut.ok()) << length;
  }
  for (const std::string word : {"-1", "4294967296", "{", "1e39", "\""}) {
    for (std::size_t at = 0; at < mesh.size(); at += 2) {
      std::string damaged = mesh;
      const auto model = parse_pair(damaged.replace(at, 1, word), anim);
      EXPECT_EQ(model ? testing::broken(*model) : "", "") << at << " " << word;
    }
    for (std::size_t at = 0; at < anim.size(); at += 2) {
      std::string damaged = anim;
      const auto model = parse_pair(mesh, damaged.replace(at, 1, word));
      EXPECT_EQ(model ? testing::broken(*model) : "", "") << at << " " << word;
    }
  }
}

TEST(Md3, HasItsSurfacesBesideEachOther) {
  const auto model = parse_md3(small_md3({"body", "head"}), "progs/x.md3");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ(testing::broken(*model), "");
  ASSERT_EQ(model->surfaces.size(), 2u);
  EXPECT_EQ(model->surfaces[1].name, "head");
  EXPECT_EQ(model->surfaces[1].shader, "progs/head.tga");
  EXPECT_EQ(model->surfaces[1].triangles[1][1], 7u);
  EXPECT_EQ(model->pose_names[1], "frame1");
  expect_at(*model, 0, 3, vec3(0, 0, 20));
  expect_at(*model, 1, 7, vec3(30, 0, 22));
  expect_at(*model, 1, 5, vec3(26, 7, 2));
}

TEST(Md3, AnyFileIsRefusedOrSound) {
  const testing::Attempt attempt = testing::attempt([](const Bytes& bytes) { return parse_md3(bytes, "progs/x.md3"); },
                                                    [](const PosedModel& model) { return testing::broken(model); });
  testing::expect_refused_when_cut(attempt, small_md3({"body", "head"}), "progs/x.md3");
  testing::expect_sound_when_damaged(attempt, small_md3({"body", "head"}), "progs/x.md3");
}

}  // namespace
}  // namespace fb::formats
