// Any file that a game needs may have two gigabytes: a bad one must be refused at once, without using memory.
#include <gmock/gmock.h>

#include "base/log.h"
#include "base/test_directory.h"
#include "base/test_memory.h"
#include "formats/test_bsp.h"
#include "fs/test_large_files.h"
#include "host/game/engine.h"
#include "server/simulation/test_map.h"
#include "ui/atlas.h"

namespace fb::host {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kLittle = 64u << 20u;  // bytes; reading one of the files would take 2048 MB

struct Case {
  const char* file;
  const char* beginning;  // behind it are zeros
  const char* command;
  const char* sentence;
};
constexpr Case kCases[] = {
    {"maps/big.bsp", "", "map big", "maps/big.bsp: offset 0: map version 0 is none of"},
    {"maps/old.bsp", "\x1d", "map old", "maps/old.bsp: "},
    {"big.dem", "", "playdemo big", "big.dem: offset 0: no demo"},
    {"big.cfg", "echo", "exec big.cfg", "exec big.cfg: a script of 2147483392 bytes; at most 8388608 are taken"},
    {"big.sav", "5\n", "load big", "big.sav: a saved game of 2147483392 bytes; at most 67108864 are taken"},
    {"maps/room.ent", "{", "map room", "maps/room.ent: 2147483392 bytes of entities; at most 16777216 are taken"},
    {"maps/room.vis", "", "map room", "maps/room.vis: offset 0: record of 0 bytes"},
    {"progs.dat", "\x06", "map room", "progs.dat: offset 0: progs of 2147483392 bytes; at most 67108864 are taken"},
};

class LargeFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    const formats::Bsp room = sv::testing::MapBuilder(vec3(-512, -512, 0), vec3(512, 512, 256)).build();
    game_.put("id1/maps/room.bsp", formats::testing::write_bsp(room));
    listener_ = add_log_listener([this](LogLevel, std::string_view line) { log_ += std::string(line) + "\n"; });
  }
  void TearDown() override { remove_log_listener(listener_); }

  std::filesystem::path path(const std::string& name) const { return game_.path() / "id1" / name; }
  std::unique_ptr<Engine> open() {
    auto engine = Engine::create({"-basedir", game_.path().string(), "-userdir", game_.file("none")});
    EXPECT_TRUE(engine.ok()) << engine.error().message;
    return engine.ok() ? std::move(*engine) : nullptr;
  }
  // What the engine says while this is done, which costs next to nothing.
  template <typename Work>
  std::string said(const Work& work) {
    log_.clear();
    const std::uint64_t before = resident_bytes();
    const std::uint64_t read_before = bytes_read();
    work();
    EXPECT_LT(bytes_read(), read_before + kLittle);
    EXPECT_LT(resident_bytes(), before + kLittle);
    return log_;
  }

  TestDirectory game_;
  std::string log_;
  int listener_ = 0;
};

TEST_F(LargeFilesTest, AreRefusedAtOnceWhereTheyAreLoose) {
  for (const Case& row : kCases) {
    SCOPED_TRACE(row.file);
    if (!fs::put_large(path(row.file), row.beginning))
      GTEST_SKIP() << "the file system has no room for sparse files of 2 GB";
    auto engine = open();
    ASSERT_NE(engine, nullptr);
    EXPECT_THAT(said([&] { engine->console().execute(row.command); }), HasSubstr(row.sentence));
    engine.reset();
    std::filesystem::remove(path(row.file));
  }
}

TEST_F(LargeFilesTest, AndInPaks) {
  for (const Case& row : kCases) {
    if (std::string_view(row.file) == "big.sav") continue;  // saves are loose files
    SCOPED_TRACE(row.file);
    if (!fs::put_large_pak(path("pak0.pak"), row.file, row.beginning))
      GTEST_SKIP() << "the file system has no room for sparse files of 2 GB";
    auto engine = open();
    ASSERT_NE(engine, nullptr);
    EXPECT_THAT(said([&] { engine->console().execute(row.command); }), HasSubstr(row.sentence));
  }
}

TEST_F(LargeFilesTest, ModelsAndPicturesToo) {
  const std::pair<const char*, std::string> files[] = {
      {"progs/big.mdl", "IDPO"},  {"progs/big.spr", "IDSP"},
      {"progs/big.bsp", "\x1d"},  {"progs/six.mdl", std::string("IDPO\x06\0\0\0", 8)},
      {"gfx.wad", "WAD3"},        {"gfx/big.lmp", ""},
      {"gfx/big.png", "\x89PNG"}, {"gfx/big.tga", ""},
      {"gfx/big.pcx", ""}};
  for (const auto& [name, beginning] : files) {
    if (!fs::put_large(path(name), beginning)) GTEST_SKIP() << "the file system has no room for sparse files of 2 GB";
  }
  auto engine = open();
  ASSERT_NE(engine, nullptr);
  for (const char* name : {"progs/big.mdl", "progs/big.spr", "progs/big.bsp", "progs/six.mdl"})
    EXPECT_THAT(said([&] { engine->library().model(name); }), HasSubstr(std::string(name) + ": offset ")) << name;
  std::optional<ui::Atlas> atlas;
  EXPECT_THAT(said([&] { atlas.emplace(engine->files().loader()); }), HasSubstr("gfx.wad: offset 0: no archive"));
  for (const char* name : {"gfx/big.lmp", "gfx/big.png", "gfx/big.tga", "gfx/big.pcx"})
    EXPECT_THAT(said([&] { atlas->picture(name); }), HasSubstr(name)) << name;
}

}  // namespace
}  // namespace fb::host
