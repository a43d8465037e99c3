#include "host/game/file_commands.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <optional>

#include "base/log.h"
#include "base/test_directory.h"
#include "fs/file.h"

namespace fb::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string map_of(const std::string& entities) {
  std::string text = {29, 0, 0, 0, 16, 0, 0, 0, static_cast<char>(entities.size()), 0, 0, 0};
  return text + "pad." + entities;
}

class FileCommands : public testing::Test {
 protected:
  FileCommands() {
    const std::string played = map_of("{\"classname\" \"info_player_start\"}");
    for (const char* name : {"e1m1", "e1m2", "start"})
      directory.put(std::string("base/id1/maps/") + name + ".bsp", played);
    for (const char* name : {"b_bh10", "e1box"})
      directory.put(std::string("base/id1/maps/") + name + ".bsp", map_of("{\"classname\" \"worldspawn\"}"));
    directory.put("base/id1/progs.dat", "code");
    directory.put("base/id1/demo1.dem", "");
    directory.put("base/id1/default.cfg", "");
    directory.put("base/ad/pak0.pak", std::string("PACK\x0c\0\0\0\0\0\0\0", 12));
    directory.put("user/id1/my save.sav", "5\n");
    fs::FsOptions options;
    options.base_dir = directory.file("base");
    options.base_dir_named = true;
    options.user_dir = directory.file("user");
    auto opened = fs::FileSystem::open(options);
    EXPECT_TRUE(opened.ok()) << opened.error().message;
    files.emplace(*std::move(opened));
    for (const char* name : {"map", "changelevel", "playdemo", "load", "game"})
      console.add_command(name, "", [](const con::Args&) {});
    register_file_commands(console, *files);
    complete_file_names(console, *files);
  }
  std::string completed(const std::string& line) { return console.complete(line).line; }
  std::vector<std::string> candidates(const std::string& line) {
    std::vector<std::string> names;
    for (const auto& candidate : console.complete(line).candidates) names.push_back(candidate.text);
    return names;
  }
  std::string written(const std::string& name) const {
    const auto data = fs::read_whole_file(directory.path() / "user" / "id1" / name);
    return data ? std::string(data->text()) : "no file";
  }

  TestDirectory directory;
  std::optional<fs::FileSystem> files;
  con::Console console;
};

TEST_F(FileCommands, TabCompletesWhatThereIs) {
  EXPECT_THAT(candidates("map "), ElementsAre("e1m1", "e1m2", "start")) << "boxes of ammunition are no levels";
  EXPECT_THAT(candidates("changelevel E1"), ElementsAre("e1m1", "e1m2"));
  EXPECT_EQ(completed("map s"), "map start ");
  EXPECT_EQ(completed("playdemo d"), "playdemo demo1 ");
  EXPECT_EQ(completed("exec de"), "exec default ");
  EXPECT_EQ(completed("load my"), "load \"my save\" ");
  EXPECT_EQ(completed("game a"), "game ad ");
}

TEST_F(FileCommands, MapsAndModsAreListed) {
  console.execute("maps; mods");
  std::vector<std::string> lines;
  for (const auto& line : console.scrollback().latest(7)) lines.push_back(line.text);
  EXPECT_THAT(lines, ElementsAre("   e1m1", "   e1m2", "   start", "3 maps", "   id1", "   ad", "2 game folders"));
  console.execute("maps e1");
  EXPECT_EQ(console.scrollback().latest(1)[0].text, "2 maps beginning with \"e1\"");
}

TEST_F(FileCommands, TheConsoleIsWrittenAsText) {
  console.execute("clear");
  log_info("first");
  log_warning("\xe7\xef\xec\xe4 and\x1d plain  ");
  console.execute("condump");
  EXPECT_EQ(written("condump.txt"), "first\ngold and  plain\n");
  EXPECT_THAT(console.scrollback().latest(1)[0].text, StartsWith("Dumped console text to "));
  console.execute("condump notes; condump deep/down.TXT; condump config.cfg");
  EXPECT_THAT(written("notes.txt"), HasSubstr("gold"));
  EXPECT_THAT(written("deep/down.TXT"), HasSubstr("gold"));
  EXPECT_EQ(written("config.cfg"), "no file") << "nothing but text files";
  EXPECT_THAT(written("config.cfg.txt"), HasSubstr("gold"));
  EXPECT_FALSE(console.failed());
}

TEST_F(FileCommands, TheConsoleIsWrittenNowhereElse) {
  for (const char* name : {"../out", "/tmp/out", "a/../../out", "c:out"}) {
    console.execute(std::string("condump \"") + name + "\"");
    EXPECT_EQ(console.scrollback().latest(1)[0].level, LogLevel::kError) << name;
  }
  EXPECT_TRUE(console.failed());
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "user" / "out.txt"));
}

}  // namespace
}  // namespace fb::host
