// Saves of QuakeSpasm's and ours, on LibreQuake's maps under the rules of testdemos/rules: each loads what the other
// has saved, and saves it again as it was; and a level that has just begun is the same in both, to the last letter of
// its save. Skipped where QuakeSpasm, the data or the compiler is absent.
#include <gtest/gtest.h>

#include "base/log.h"
#include "fs/filesystem.h"
#include "server/server.h"
#include "server/test_quakespasm.h"
#include "server/test_rules.h"

namespace fb::sv {
namespace {

namespace stdfs = std::filesystem;

std::string text_of(const stdfs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// What depends on who saved: the comment's name and kills, which QuakeSpasm's client knows.
std::string without_comment(const std::string& save) {
  const auto first = save.find('\n'), second = save.find('\n', first + 1);
  return second == std::string::npos ? save : save.substr(0, first) + save.substr(second);
}

class QuakeSpasmSaves : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    set_log_level(LogLevel::kError);
    if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
    static const Bytes rules = testing::compile_rules("void() barrel_explode = {};");
    ASSERT_FALSE(rules.empty()) << "testdemos/rules do not compile";
    std::string made = (stdfs::temp_directory_path() / "fullbright_saves_XXXXXX").string();
    ASSERT_NE(mkdtemp(made.data()), nullptr);
    folder_ = made;
    game_ = folder_.filename().string();  // QuakeSpasm saves below the user's home: under a name that nobody has
    stdfs::create_directories(folder_ / "id1");
    stdfs::create_directories(folder_ / game_);
    for (const auto& entry : stdfs::directory_iterator(stdfs::absolute(testing::game_data()) / "id1"))
      stdfs::create_symlink(entry.path(), folder_ / "id1" / entry.path().filename());
    std::ofstream(folder_ / game_ / "progs.dat", std::ios::binary)
        .write(reinterpret_cast<const char*>(rules.data()), static_cast<std::streamsize>(rules.size()));
    fs::FsOptions options;
    options.base_dir = folder_;
    options.user_dir = "";
    options.games = {game_};
    auto opened = fs::FileSystem::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files_.emplace(std::move(*opened));
  }
  void TearDown() override {
    set_log_level(LogLevel::kInfo);
    if (!folder_.empty()) stdfs::remove_all(folder_);
    if (!saves_.empty()) stdfs::remove_all(saves_);
  }

  void run_quakespasm(const std::string& commands) {
    const std::string command = fmt::format(
        "cd '{}' && timeout 60 '{}' -dedicated 1 -basedir . -game {} -port {} {} +quit >out.txt 2>&1 </dev/null",
        folder_.string(), testing::quakespasm_program(), game_, testing::quakespasm_port(), commands);
    (void)std::system(command.c_str());
    const std::string output = text_of(folder_ / "out.txt"), mark = "Saving game to ";
    const auto at = output.rfind(mark);
    ASSERT_NE(at, std::string::npos) << output;
    const auto start = at + mark.size();
    saves_ = stdfs::path(output.substr(start, output.find("...", start) - start)).parent_path();
    ASSERT_EQ(saves_.filename().string(), game_);
  }
  // Ours: after these steps, what is saved.
  template <typename Steps>
  std::string our_save(Steps&& steps) {
    con::Console console;
    ServerServices services;
    services.read_file = [this](std::string_view name) {
      return name == "theirs.sav" ? std::optional(Bytes(theirs_.begin(), theirs_.end())) : files_->read(name);
    };
    std::string saved;
    services.write_file = [&](std::string_view, ByteView data) {
      saved.assign(data.begin(), data.end());
      return ok_status();
    };
    Server server(console, services);
    Status status = steps(server);
    if (status) status = server.save("ours");
    EXPECT_TRUE(status.ok()) << status.error().message;
    return saved;
  }

  stdfs::path folder_, saves_;
  std::string game_, theirs_;
  std::optional<fs::FileSystem> files_;
};

TEST_P(QuakeSpasmSaves, LoadHereAndThere) {
  const std::string map = GetParam();
  ASSERT_NO_FATAL_FAILURE(run_quakespasm(fmt::format("+map {} +save new +load new +save again", map)));
  theirs_ = text_of(saves_ / "new.sav");
  ASSERT_FALSE(theirs_.empty());
  EXPECT_EQ(without_comment(our_save([&](Server& server) { return server.map(map); })), without_comment(theirs_));

  const std::string ours = our_save([](Server& server) { return server.load("theirs"); });
  EXPECT_EQ(without_comment(ours), without_comment(text_of(saves_ / "again.sav")));

  std::ofstream(saves_ / "ours.sav") << ours;
  ASSERT_NO_FATAL_FAILURE(run_quakespasm("+load ours +save back"));
  EXPECT_EQ(without_comment(text_of(saves_ / "back.sav")), without_comment(ours));
}

INSTANTIATE_TEST_SUITE_P(Maps, QuakeSpasmSaves, ::testing::Values("start", "lq_e0m1", "lq_e1m7"));

}  // namespace
}  // namespace fb::sv
