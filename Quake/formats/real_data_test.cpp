// Game data as people have it: every map, model, sprite, picture, archive and demo of the test data parses, keeps the
// promises of the headers, and needs few mendings. Skipped where the data is absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "base/librequake.h"
#include "formats/bsp.h"
#include "formats/dem.h"
#include "formats/image.h"
#include "formats/invariants.h"
#include "formats/mdl.h"
#include "formats/spr.h"
#include "formats/wad.h"

namespace fb::formats {
namespace {

namespace stdfs = std::filesystem;

Bytes read_whole(const stdfs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

// All files of the test data by name: loose ones, and those in paks (whose directory is read without mercy: the data
// is ours).
const std::map<std::string, Bytes>& test_data() {
  static const std::map<std::string, Bytes> files = [] {
    std::map<std::string, Bytes> found;
    const stdfs::path root = librequake_folder() / "id1";
    if (!stdfs::exists(root)) return found;
    for (const auto& entry : stdfs::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = stdfs::relative(entry.path(), root).generic_string();
      if (entry.path().extension() == ".ogg") continue;
      Bytes bytes = read_whole(entry.path());
      if (entry.path().extension() != ".pak") {
        found[name] = std::move(bytes);
        continue;
      }
      ByteReader pak(bytes, name);
      pak.skip(4);
      const std::uint32_t directory = pak.u32(), size = pak.u32();
      pak.seek(directory);
      for (std::uint32_t i = 0; i < size / 64; ++i) {
        const std::string file_name = pak.fixed_string(56);
        const std::uint32_t offset = pak.u32(), length = pak.u32();
        const ByteView part = ByteView(bytes).subspan(offset, length);
        found[file_name] = Bytes(part.begin(), part.end());
      }
    }
    return found;
  }();
  return files;
}

std::vector<std::pair<std::string, const Bytes*>> files_ending_in(std::string_view extension) {
  std::vector<std::pair<std::string, const Bytes*>> chosen;
  for (const auto& [name, bytes] : test_data()) {
    if (name.ends_with(extension)) chosen.emplace_back(name, &bytes);
  }
  return chosen;
}

#define SKIP_WITHOUT_DATA() \
  if (test_data().empty()) GTEST_SKIP() << librequake_lacks()
#define SKIP_WITHOUT(file) \
  if (!test_data().contains(file)) GTEST_SKIP() << librequake_lacks(std::string("id1/") + (file))

TEST(RealData, MapsParse) {
  SKIP_WITHOUT_DATA();
  const auto maps = files_ending_in(".bsp");
  ASSERT_GE(maps.size(), 10u);
  for (const auto& [name, bytes] : maps) {
    const auto bsp = parse_bsp(*bytes, name);
    ASSERT_TRUE(bsp.ok()) << bsp.error().message;
    EXPECT_EQ(testing::broken(*bsp), "") << name;
    EXPECT_TRUE(bsp->warnings.empty()) << bsp->warnings.front();
    EXPECT_NE(bsp->entities.find("worldspawn"), std::string::npos) << name;
    EXPECT_FALSE(bsp->faces.empty()) << name;
  }
}

// The same map, compiled to each of the versions, is the same world.
TEST(RealData, VersionsAgree) {
  SKIP_WITHOUT("maps/lq_e0m1_bsp2.bsp");
  SKIP_WITHOUT("maps/lq_e0m1_2psb.bsp");
  const auto wide = parse_bsp(test_data().at("maps/lq_e0m1_bsp2.bsp"), "bsp2");
  const auto half = parse_bsp(test_data().at("maps/lq_e0m1_2psb.bsp"), "2psb");
  ASSERT_TRUE(wide.ok() && half.ok());
  EXPECT_EQ(wide->version, BspVersion::kBsp2);
  EXPECT_EQ(half->version, BspVersion::k2Psb);
  ASSERT_EQ(wide->faces.size(), half->faces.size());
  ASSERT_EQ(wide->nodes.size(), half->nodes.size());
  for (std::size_t i = 0; i < wide->nodes.size(); ++i) {
    EXPECT_EQ(wide->nodes[i].children, half->nodes[i].children);
    EXPECT_LE(glm::length(wide->nodes[i].mins - half->nodes[i].mins), 2.0f);
  }
  for (std::size_t i = 0; i < wide->faces.size(); ++i) {
    EXPECT_EQ(wide->faces[i].surfedge_count, half->faces[i].surfedge_count);
  }
}

TEST(RealData, BspxLumpsAreKept) {
  SKIP_WITHOUT("maps/lq_e0m1_bspx.bsp");
  const auto bsp = parse_bsp(test_data().at("maps/lq_e0m1_bspx.bsp"), "bspx");
  ASSERT_TRUE(bsp.ok()) << bsp.error().message;
  std::map<std::string, std::size_t> sizes;
  for (const auto& [name, bytes] : bsp->bspx) sizes[name] = bytes.size();
  EXPECT_GT(sizes["RGBLIGHTING"], 0u);
  EXPECT_EQ(sizes["RGBLIGHTING"] % 3, 0u);
  EXPECT_EQ(sizes["DECOUPLED_LM"], 40 * bsp->faces.size());
}

TEST(RealData, ModelsParse) {
  SKIP_WITHOUT_DATA();
  const auto models = files_ending_in(".mdl");
  ASSERT_GE(models.size(), 50u);
  for (const auto& [name, bytes] : models) {
    const auto mdl = parse_mdl(*bytes, name);
    ASSERT_TRUE(mdl.ok()) << mdl.error().message;
    EXPECT_EQ(testing::broken(*mdl), "") << name;
    EXPECT_TRUE(mdl->warnings.empty()) << mdl->warnings.front();
  }
}

TEST(RealData, SpritesParse) {
  SKIP_WITHOUT_DATA();
  const auto sprites = files_ending_in(".spr");
  ASSERT_FALSE(sprites.empty());
  for (const auto& [name, bytes] : sprites) {
    const auto spr = parse_spr(*bytes, name);
    ASSERT_TRUE(spr.ok()) << spr.error().message;
    EXPECT_EQ(testing::broken(*spr), "") << name;
  }
}

TEST(RealData, PicturesParse) {
  SKIP_WITHOUT_DATA();
  for (const auto& [name, bytes] : files_ending_in(".lmp")) {
    if (name == "gfx/palette.lmp") {
      ASSERT_TRUE(parse_palette(*bytes, name).ok());
    } else if (name != "gfx/colormap.lmp" && name != "gfx/pop.lmp") {
      const auto picture = parse_lmp(*bytes, name);
      ASSERT_TRUE(picture.ok()) << picture.error().message;
      EXPECT_EQ(testing::broken_image(*picture), "") << name;
    }
  }
}

TEST(RealData, WadParses) {
  SKIP_WITHOUT("gfx.wad");
  const auto wad = Wad::parse(test_data().at("gfx.wad"), "gfx.wad");
  ASSERT_TRUE(wad.ok()) << wad.error().message;
  EXPECT_TRUE(wad->conchars().ok());
  for (const auto& [name, lump] : wad->lumps()) {
    if (lump.type != 'B') continue;
    const auto picture = wad->picture(name);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
  }
  const auto bar = wad->picture("SBAR");
  ASSERT_TRUE(bar.ok()) << bar.error().message;
  EXPECT_EQ(bar->width, 320);
  EXPECT_EQ(bar->height, 24);
}

TEST(RealData, DemosReadToTheEnd) {
  SKIP_WITHOUT_DATA();
  const auto demos = files_ending_in(".dem");
  ASSERT_EQ(demos.size(), 3u);
  for (const auto& [name, bytes] : demos) {
    auto demo = DemReader::open(*bytes, name);
    ASSERT_TRUE(demo.ok()) << demo.error().message;
    std::size_t messages = 0;
    Bytes copy(bytes->begin(), bytes->begin() + static_cast<std::ptrdiff_t>(demo->offset()));
    while (!demo->at_end()) {
      const auto message = demo->next();
      ASSERT_TRUE(message.ok()) << message.error().message;
      append_dem_message(copy, message->view_angles, message->data);
      ++messages;
    }
    EXPECT_GT(messages, 100u) << name;
    EXPECT_EQ(copy, *bytes) << name;
  }
}

}  // namespace
}  // namespace fb::formats
