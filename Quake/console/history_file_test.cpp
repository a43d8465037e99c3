#include "console/history_file.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "base/test_directory.h"
#include "console/input_line.h"
#include "fs/file.h"

namespace fb::con {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class HistoryFile : public testing::Test {
 protected:
  std::vector<std::string> read() const {
    const auto lines = read_history(path);
    EXPECT_TRUE(lines.ok()) << lines.error().message;
    return lines ? *lines : std::vector<std::string>{};
  }
  void add(std::vector<std::string> entered) const {
    const Status status = add_to_history(path, entered);
    EXPECT_TRUE(status.ok()) << status.error().message;
  }
  TestDirectory directory;
  std::filesystem::path path = directory.path() / "mine" / "history.txt";
};

TEST_F(HistoryFile, TwoProgramsKeepEachOthersLines) {
  EXPECT_THAT(read(), IsEmpty());
  add({"map start", "god"});
  add({"noclip", "noclip"});  // of a program that had read nothing
  EXPECT_THAT(read(), ElementsAre("map start", "god", "noclip"));
  add({});
  EXPECT_THAT(read(), ElementsAre("map start", "god", "noclip"));
}

TEST_F(HistoryFile, PasswordsAreNotKept) {
  add({"rcon_password hush", "map start; set Password hush", "god"});
  EXPECT_THAT(read(), ElementsAre("god"));
}

TEST_F(HistoryFile, TheNewestAreKept) {
  for (int i = 0; i < 10; ++i) {
    std::vector<std::string> entered;
    for (int k = 0; k < 10; ++k) entered.push_back("echo " + std::to_string(10 * i + k));
    add(entered);
  }
  ASSERT_EQ(read().size(), InputLine::kMaxHistory);
  EXPECT_EQ(read().back(), "echo 99");
  EXPECT_EQ(read().front(), "echo " + std::to_string(100 - InputLine::kMaxHistory));
}

TEST_F(HistoryFile, FilesOfOthersAndBrokenOnes) {
  directory.put("mine/history.txt", "one\r\ntwo\r\n\r\nthree");
  EXPECT_THAT(read(), ElementsAre("one", "two", "three"));
  directory.put("mine/history.txt", std::string(5000, 'x'));
  EXPECT_THAT(read(), ElementsAre(std::string(InputLine::kMaxLength, 'x')));
  directory.put("mine/history.txt", std::string(3'000'000, 'x') + "\nlast\n");
  EXPECT_THAT(read(), ElementsAre("last"));
}

TEST_F(HistoryFile, OneThatCannotBeReadStays) {
  std::filesystem::create_directories(path);
  EXPECT_FALSE(read_history(path).ok());
  EXPECT_FALSE(add_to_history(path, std::vector<std::string>{"god"}).ok());
  EXPECT_TRUE(std::filesystem::is_directory(path));
}

}  // namespace
}  // namespace fb::con
