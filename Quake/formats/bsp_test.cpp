// Maps: each version round trips; damaged ones are refused by name and place; what QuakeSpasm plays is mended and said.
#include "formats/bsp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/invariants.h"
#include "formats/test_bsp.h"
#include "formats/test_bytes.h"
#include "formats/test_corruption.h"

namespace fb::formats {
namespace {

using testing::box_room;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::write_bsp;

constexpr std::array kVersions = {BspVersion::kBsp29, BspVersion::kBsp2, BspVersion::k2Psb, BspVersion::kQuake64};
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

const testing::Attempt kAttempt = testing::attempt([](const Bytes& bytes) { return parse_bsp(bytes, "maps/x.bsp"); },
                                                   [](const Bsp& bsp) { return testing::broken(bsp); });

class EachVersion : public ::testing::TestWithParam<BspVersion> {
 protected:
  bool quake64() const { return GetParam() == BspVersion::kQuake64; }
  // Samples of light in the room.
  std::size_t light_samples() const { return quake64() ? room_.bspx.at(0).second.size() / 3 : room_.lighting.size(); }

  Bsp room_ = box_room(GetParam());

  // Refused, and for the reason that contains `cause`.
  void expect_refused(const std::string& cause) {
    const Bytes file = write_bsp(room_);
    const auto bsp = parse_bsp(file, "maps/x.bsp");
    ASSERT_FALSE(bsp.ok()) << "taken, though: " << cause;
    EXPECT_THAT(bsp.error().message, HasSubstr(cause));
    EXPECT_TRUE(testing::names_place(bsp.error().message, "maps/x.bsp", file.size()));
  }
  // Taken, with exactly one warning, which contains `cause`.
  Bsp expect_mended(const std::string& cause) {
    const Bytes file = write_bsp(room_);
    auto bsp = parse_bsp(file, "maps/x.bsp");
    if (!bsp.ok()) {
      ADD_FAILURE() << bsp.error().message;
      return {};
    }
    EXPECT_EQ(testing::broken(*bsp), "");
    EXPECT_EQ(bsp->warnings.size(), 1u);
    EXPECT_THAT(bsp->warnings, Contains(HasSubstr(cause)));
    for (const std::string& warning : bsp->warnings) {
      EXPECT_TRUE(testing::names_place(warning, "maps/x.bsp", file.size()));
    }
    return std::move(*bsp);
  }
};
INSTANTIATE_TEST_SUITE_P(Bsp, EachVersion, ::testing::ValuesIn(kVersions));

TEST_P(EachVersion, RoundTrips) {
  if (!quake64()) room_.bspx = {{"RGBLIGHTING", Bytes(5202, 9)}, {"LMSHIFT", Bytes(6, 4)}};
  const Bytes file = write_bsp(room_);
  const auto bsp = parse_bsp(file, "maps/x.bsp");
  ASSERT_TRUE(bsp.ok()) << bsp.error().message;
  EXPECT_EQ(testing::broken(*bsp), "");
  EXPECT_TRUE(bsp->warnings.empty());
  EXPECT_EQ(bsp->version, GetParam());
  EXPECT_EQ(write_bsp(*bsp), file);

  EXPECT_EQ(bsp->textures[0].indices, room_.textures[0].indices);
  EXPECT_EQ(bsp->textures[0].shift, room_.textures[0].shift);
  EXPECT_TRUE(bsp->textures[1].missing());
  EXPECT_EQ(bsp->textures[1].name, room_.textures[1].name);
  EXPECT_EQ(bsp->textures[1].width, quake64() ? 16 : 32);
  EXPECT_TRUE(bsp->textures[2].missing());
  EXPECT_EQ(bsp->face_vertex(bsp->faces[1], 0), room_.face_vertex(room_.faces[1], 0));
  EXPECT_EQ(bsp->bspx, room_.bspx);
}

// The room itself is what it says: all walls face inwards, clockwise as Quake has it.
TEST_P(EachVersion, RoomFacesInwards) {
  for (const BspFace& face : room_.faces) {
    const vec3 a = room_.face_vertex(face, 0), b = room_.face_vertex(face, 1), c = room_.face_vertex(face, 2);
    const vec3 normal = room_.planes[face.plane].normal * (face.back_side ? -1.0f : 1.0f);
    EXPECT_GT(glm::dot(glm::cross(c - a, b - a), normal), 0.0f);
    EXPECT_LT(glm::dot(normal, a), 0.0f);
  }
}

TEST_P(EachVersion, RefusedWhenCut) { testing::expect_refused_when_cut(kAttempt, write_bsp(room_), "maps/x.bsp"); }

TEST_P(EachVersion, SoundWhenDamaged) {
  room_.bspx = {{"RGBLIGHTING", Bytes(64, 9)}};
  room_.lighting.resize(64);
  for (BspFace& face : room_.faces) face.light_offset = 0;
  testing::expect_sound_when_damaged(kAttempt, write_bsp(room_), "maps/x.bsp");
}

TEST_P(EachVersion, OversizedLumpsAreRefused) {
  const Bytes valid = write_bsp(room_);
  const auto can_be_spared = [](std::size_t lump) { return lump == 2 || lump == 4 || lump == 8; };
  for (std::size_t word = 4; word < 124; word += 4) {
    if (can_be_spared((word - 4) / 8)) continue;
    for (const std::uint32_t value : {0xffffffffu, 0x7ffffffcu, static_cast<std::uint32_t>(valid.size() + 4)}) {
      testing::ByteWriter file{valid};
      file.patch_u32(word, value);
      testing::expect_refused(kAttempt, file.out, "maps/x.bsp");
    }
  }
}

// A wall without its texture, a level in which all is seen, light that is not used: no reason to lose the map.
TEST_P(EachVersion, LumpsThatCanBeSparedAreLeftOut) {
  for (const std::size_t lump : {2u, 4u, 8u}) {
    testing::ByteWriter file{write_bsp(room_)};
    file.patch_u32(4 + 8 * lump, static_cast<std::uint32_t>(file.out.size() - 4));
    file.patch_u32(8 + 8 * lump, 5);
    const auto bsp = parse_bsp(file.out, "maps/x.bsp");
    ASSERT_TRUE(bsp.ok()) << lump << ": " << bsp.error().message;
    EXPECT_EQ(testing::broken(*bsp), "");
    ASSERT_FALSE(bsp->warnings.empty());
    EXPECT_THAT(bsp->warnings[0], HasSubstr("lies outside the file; left out"));
    EXPECT_TRUE(testing::names_place(bsp->warnings[0], "maps/x.bsp", file.out.size()));
    EXPECT_EQ(bsp->textures.empty(), lump == 2);
    EXPECT_EQ(bsp->visibility.empty(), lump == 4);
    EXPECT_EQ(bsp->lighting.empty() && bsp->bspx.empty(), lump == 8);
  }
}

TEST_P(EachVersion, LumpsOfHalfRecordsAreRefused) {
  const Bytes valid = write_bsp(room_);
  for (const std::size_t lump : {1u, 3u, 5u, 6u, 7u, 9u, 10u, 12u, 13u, 14u}) {
    testing::ByteWriter file{valid};
    std::uint32_t size = 0;
    std::memcpy(&size, valid.data() + 8 + 8 * lump, 4);
    file.patch_u32(8 + 8 * lump, size - 1);
    const auto bsp = parse_bsp(file.out, "maps/x.bsp");
    ASSERT_FALSE(bsp.ok()) << lump;
    EXPECT_THAT(bsp.error().message, HasSubstr("no multiple of"));
  }
}

TEST_P(EachVersion, UnknownVersionIsRefused) {
  Bytes file = write_bsp(room_);
  file[0] = 30;
  file[1] = file[2] = file[3] = 0;
  const auto bsp = parse_bsp(file, "maps/x.bsp");
  ASSERT_FALSE(bsp.ok());
  EXPECT_THAT(bsp.error().message, HasSubstr("version 30"));
}

// --- each index out of range ---

TEST_P(EachVersion, EdgeVertex) {
  room_.edges[3][1] = 8;
  expect_refused("edge names vertex 8 of 8");
}
TEST_P(EachVersion, SurfedgeEdge) {
  room_.surfedges[3] = static_cast<std::int32_t>(room_.edges.size());
  expect_refused("surfedge names edge 13 of 13");
}
TEST_P(EachVersion, SurfedgeLeastNumber) {
  room_.surfedges[3] = std::numeric_limits<std::int32_t>::min();
  expect_refused("surfedge names edge");
}
TEST_P(EachVersion, FacePlane) {
  room_.faces[2].plane = 6;
  expect_refused("face names plane 6 of 6");
}
TEST_P(EachVersion, FaceSurfedges) {
  room_.faces[5].surfedge_count = 5;
  expect_refused("face names surfedges beyond the 24");
}
TEST_P(EachVersion, FaceSurfedgesThatWrapRound) {
  room_.faces[5].first_surfedge = 0xffffffffu;
  expect_refused("face names surfedges beyond the 24");
}
TEST_P(EachVersion, FaceTexinfo) {
  room_.faces[0].texinfo = 6;
  expect_refused("face names texinfo 6 of 6");
}
TEST_P(EachVersion, MarkFace) {
  room_.mark_faces[0] = 6;
  expect_refused("marksurface names face 6 of 6");
}
TEST_P(EachVersion, LeafMarkFaces) {
  room_.leafs[1].first_mark_face = 1;
  expect_refused("leaf names marksurfaces beyond the 6");
}
TEST_P(EachVersion, NodePlane) {
  room_.nodes[0].plane = 6;
  expect_refused("node names plane 6 of 6");
}
TEST_P(EachVersion, NodeFaces) {
  room_.nodes[5].face_count = 2;
  expect_refused("node names faces beyond the 6");
}
TEST_P(EachVersion, ClipNodePlane) {
  room_.clip_nodes[0].plane = 0xffffffffu;
  expect_refused("clip node names plane");
}
TEST_P(EachVersion, ModelHead) {
  room_.models[0].head_nodes[0] = 6;
  expect_refused("model names head node 6 of 6");
}
TEST_P(EachVersion, ModelHeadLeaf) {
  room_.models[1].head_nodes[0] = ~2;
  expect_refused("model names head node -3");
}
TEST_P(EachVersion, ModelFaces) {
  room_.models[0].first_face = 1;
  expect_refused("model names faces beyond the 6");
}
TEST_P(EachVersion, NoModels) {
  room_.models.clear();
  expect_refused("no world model");
}
TEST_P(EachVersion, NoLeafs) {
  room_.leafs.clear();
  expect_refused("no leafs");
}

// --- trees ---

TEST_P(EachVersion, NodeThatLeadsBack) {
  room_.nodes[5].children[0] = 3;
  room_.nodes[2].children = {~1, ~0};
  expect_refused("node leads back to itself in the nodes lump");
}
TEST_P(EachVersion, NodeThatIsItsOwnChild) {
  room_.nodes[5].children[0] = 5;
  room_.nodes[4].children = {~1, ~0};
  expect_refused("node leads back to itself");
}
TEST_P(EachVersion, NodeWithTwoParents) {
  room_.nodes[0].children[1] = 3;
  expect_refused("another parent");
}
TEST_P(EachVersion, ClipNodeThatLeadsBack) {
  room_.clip_nodes[5].children[0] = 0;
  expect_refused("node leads back to itself in the clipnodes lump");
}
TEST_P(EachVersion, ClipNodesMayBeShared) {
  room_.clip_nodes[0].children[1] = 3;
  const auto bsp = parse_bsp(write_bsp(room_), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok()) << bsp.error().message;
  EXPECT_EQ(bsp->clip_nodes[0].children[1], 3);
}
TEST_P(EachVersion, DepthIsBounded) {
  room_ = testing::deep_room(GetParam(), kMaxBspDepth);
  const auto bsp = parse_bsp(write_bsp(room_), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok()) << bsp.error().message;
  EXPECT_EQ(testing::broken(*bsp), "");
  room_ = testing::deep_room(GetParam(), kMaxBspDepth + 1);
  expect_refused("deeper than");
}

// --- numbers that are none ---

TEST_P(EachVersion, PlaneNotFinite) {
  room_.planes[2].distance = kNaN;
  expect_refused("plane has a number that is not finite");
}
TEST_P(EachVersion, VertexNotFinite) {
  room_.vertices[2].y = kInfinity;
  expect_refused("vertex is not finite");
}
TEST_P(EachVersion, VertexTooFar) {
  room_.vertices[2].y = -1.5e6f;
  expect_refused("too far");
}
TEST_P(EachVersion, TexinfoNotFinite) {
  room_.texinfos[1].axes[1].z = kNaN;
  const Bsp bsp = expect_mended("axis is taken as 0");
  EXPECT_EQ(bsp.texinfos[1].axes[1], vec4(0.0f));
  EXPECT_EQ(bsp.texinfos[1].axes[0], room_.texinfos[1].axes[0]);
}
TEST_P(EachVersion, ModelBoxNotFinite) {
  room_.models[0].maxs.x = kNaN;
  EXPECT_EQ(expect_mended("bounds or origin").models[0].maxs, vec3(0.0f));
}

// --- what QuakeSpasm plays ---

TEST_P(EachVersion, NodeChildThatDoesNotExist) {
  for (const std::int32_t child : {~2, ~7, 6, 30000}) {
    room_.nodes[5].children[0] = child;
    EXPECT_EQ(expect_mended("solid leaf 0").nodes[5].children[0], ~0);
  }
}
TEST_P(EachVersion, LightOutsideItsLump) {
  room_.faces[0].light_offset = static_cast<std::int32_t>(light_samples());
  room_.faces[1].light_offset = -7;
  const Bsp bsp = expect_mended("light outside the lighting lump; taken as none (and 1 more)");
  EXPECT_EQ(bsp.faces[0].light_offset, -1);
  EXPECT_EQ(bsp.faces[1].light_offset, -1);
  EXPECT_EQ(bsp.faces[2].light_offset, room_.faces[2].light_offset);
}
TEST_P(EachVersion, ColouredLightAlone) {
  if (quake64()) return;  // which has no other
  room_.bspx = {{"RGBLIGHTING", Bytes(3 * room_.lighting.size())}};
  room_.lighting.clear();
  const auto bsp = parse_bsp(write_bsp(room_), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok());
  EXPECT_EQ(bsp->faces[5].light_offset, room_.faces[5].light_offset);
}
TEST_P(EachVersion, NoLightNoVisibility) {
  room_.lighting.clear();
  room_.bspx.clear();
  room_.visibility.clear();
  const auto bsp = parse_bsp(write_bsp(room_), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok());
  EXPECT_TRUE(bsp->warnings.empty());
  EXPECT_EQ(bsp->leafs[1].vis_offset, -1);
  EXPECT_EQ(bsp->faces[1].light_offset, -1);
}
TEST_P(EachVersion, VisibilityOutsideItsLump) {
  room_.leafs[1].vis_offset = 1;
  EXPECT_EQ(expect_mended("seeing all").leafs[1].vis_offset, -1);
}
TEST_P(EachVersion, TexinfoTexture) {
  room_.texinfos[0].texture = 3;
  EXPECT_EQ(expect_mended("taken as none").texinfos[0].texture, kNoTexture);
}
TEST_P(EachVersion, FaceOfTwoEdges) {
  room_.faces[0].surfedge_count = 2;
  EXPECT_EQ(expect_mended("fewer than three").faces[0].surfedge_count, 2u);
}
TEST_P(EachVersion, UnknownContents) {
  room_.leafs[1].contents = 12;
  EXPECT_EQ(expect_mended("unknown contents").leafs[1].contents, kContentsEmpty);
}
TEST_P(EachVersion, UnknownPlaneType) {
  room_.planes[0].type = 9;
  EXPECT_EQ(expect_mended("unknown type").planes[0].type, 3);
}
TEST_P(EachVersion, TooManyVisibleLeafs) {
  room_.models[0].visible_leafs = 2;
  EXPECT_EQ(expect_mended("visible leafs").models[0].visible_leafs, 1u);
}
TEST_P(EachVersion, HullThatDoesNotExist) {
  room_.models[0].head_nodes[2] = 6;
  EXPECT_EQ(expect_mended("hull is taken as empty").models[0].head_nodes[2], kContentsEmpty);
}

TEST(BspMemory, BspxLumpsCannotBeMultiplied) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.bspx.assign(100, {"AGAIN", Bytes(16)});
  testing::ByteWriter file{write_bsp(room)};
  const std::size_t directory = file.out.size() - 100 * (32 + 16);
  for (std::size_t i = 0; i < 100; ++i) {
    file.patch_u32(directory + 32 * i + 24, 0);
    file.patch_u32(directory + 32 * i + 28, static_cast<std::uint32_t>(file.out.size()));
  }
  const auto bsp = parse_bsp(file.out, "maps/x.bsp");
  ASSERT_TRUE(bsp.ok());
  EXPECT_EQ(bsp->bspx.size(), 1u);
  EXPECT_THAT(bsp->warnings, Contains(HasSubstr("BSPX lump")));
}

// --- sixteen bits ---

// BSP29 clip nodes past 32767 would be negative as signed numbers; the rest of the 16 bits are contents.
TEST(Bsp29, ClipNodesPastTheSignBit) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.clip_nodes.assign(40000, BspClipNode{0, {kContentsEmpty, kContentsSolid}});
  room.clip_nodes[0].children = {39999, -20000};
  const auto bsp = parse_bsp(write_bsp(room), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok()) << bsp.error().message;
  EXPECT_EQ(bsp->clip_nodes[0].children[0], 39999);
  EXPECT_EQ(bsp->clip_nodes[0].children[1], kContentsEmpty);
  EXPECT_EQ(bsp->clip_nodes[1].children[1], kContentsSolid);
  EXPECT_THAT(bsp->warnings, Contains(HasSubstr("unknown contents")));
}
TEST(Bsp29, NodesPastTheSignBit) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.nodes.assign(40000, BspNode{0, {~1, ~0}, vec3(0.0f), vec3(0.0f), 0, 0});
  room.nodes[0].children[0] = 39999;
  const auto bsp = parse_bsp(write_bsp(room), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok()) << bsp.error().message;
  EXPECT_EQ(bsp->nodes[0].children[0], 39999);
  EXPECT_EQ(bsp->nodes[1].children[0], ~1);
}
TEST(Bsp2, ClipNodeChild) {
  for (const std::int32_t child : {6, 65530, std::numeric_limits<std::int32_t>::max()}) {
    Bsp room = box_room(BspVersion::kBsp2);
    room.clip_nodes[5].children[0] = child;
    const auto bsp = parse_bsp(write_bsp(room), "maps/x.bsp");
    ASSERT_TRUE(bsp.ok()) << bsp.error().message;
    EXPECT_EQ(bsp->clip_nodes[5].children[0], kContentsSolid);
    EXPECT_THAT(bsp->warnings, Contains(HasSubstr("clip node names a child that does not exist; taken as solid")));
  }
}
TEST(Bsp2, BoxNotFinite) {
  Bsp room = box_room(BspVersion::kBsp2);
  room.leafs[1].mins.x = kNaN;
  const auto bsp = parse_bsp(write_bsp(room), "maps/x.bsp");
  ASSERT_TRUE(bsp.ok());
  EXPECT_EQ(bsp->leafs[1].mins, vec3(0.0f));
  EXPECT_EQ(bsp->warnings.size(), 1u);
}

// --- Quake 64's ---

TEST(Quake64, TexturesHaveAShift) {
  Bsp room = box_room(BspVersion::kQuake64);
  EXPECT_EQ(parse_bsp(write_bsp(room), "x")->textures[0].shift, 2);
  for (const int wrong : {-1, kMaxTextureShift + 1, std::numeric_limits<int>::max()}) {
    room.textures[0].shift = wrong;
    const auto bsp = parse_bsp(write_bsp(room), "x");
    ASSERT_TRUE(bsp.ok());
    EXPECT_EQ(bsp->textures[0].shift, 0);
    EXPECT_EQ(bsp->textures[0].indices, room.textures[0].indices);
    EXPECT_THAT(bsp->warnings, Contains(HasSubstr("impossible shift")));
  }
}
// The texels follow the header, whatever the offsets say.
TEST(Quake64, OffsetsOfTexelsSayNothing) {
  const Bytes valid = write_bsp(box_room(BspVersion::kQuake64));
  std::uint32_t lump = 0;
  std::memcpy(&lump, valid.data() + 4 + 8 * 2, 4);
  for (const std::uint32_t offset : {0u, 40u, 60u}) {
    testing::ByteWriter file{valid};
    file.patch_u32(lump + 16 + 28, offset);
    EXPECT_EQ(parse_bsp(file.out, "x")->textures[0].indices, box_room(BspVersion::kQuake64).textures[0].indices);
  }
}
// Sixteen bits a sample, the greater byte first; a face counts bytes.
TEST(Quake64, LightIsColoured) {
  Bsp room = box_room(BspVersion::kQuake64);
  room.bspx[0].second.assign(3 * 300, 0);
  room.faces[1].light_offset = 299;
  Bytes file = write_bsp(room);
  std::uint32_t lump = 0;
  std::memcpy(&lump, file.data() + 4 + 8 * 8, 4);
  file[lump] = 0xf8;  // 11111 000, 00 000001
  file[lump + 1] = 0x01;
  file[lump + 2] = 0x07;  // 00000 111, 11 111111
  file[lump + 3] = 0xff;
  const auto bsp = parse_bsp(file, "x");
  ASSERT_TRUE(bsp.ok());
  ASSERT_EQ(bsp->bspx.size(), 1u);
  const Bytes& light = bsp->bspx[0].second;
  EXPECT_EQ(Bytes(light.begin(), light.begin() + 6), (Bytes{248, 0, 4, 0, 248, 252}));
  EXPECT_EQ(bsp->faces[1].light_offset, 299);
}

// The published check value of CRC-16/CCITT with start 0xffff.
TEST(Bsp, EntitiesCrc) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.entities = "123456789";
  EXPECT_EQ(parse_bsp(write_bsp(room), "x")->entities_crc, 0x29b1);
}

TEST(Bsp, EntitiesMayBeginWithAByteOrderMark) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.entities = "\xef\xbb\xbf{}";
  EXPECT_EQ(parse_bsp(write_bsp(room), "x")->entities, "{}");
}

TEST(Bsp, EntitiesHaveALimit) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.entities = std::string(kMostEntityText, ' ');  // and the zero behind it
  const auto refused = parse_bsp(write_bsp(room), "x");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "x: entities lump: 16777217 bytes of entities; at most 16777216 are taken");
}

}  // namespace
}  // namespace fb::formats
