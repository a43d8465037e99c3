#include "host/game/console_log.h"

#include <gtest/gtest.h>

#include "base/test_directory.h"
#include "fs/file.h"

namespace fb::host {
namespace {

std::string text_of(const std::filesystem::path& path) {
  const auto bytes = fs::read_whole_file(path);
  return bytes ? std::string(bytes->begin(), bytes->end()) : "no file";
}

TEST(ConsoleLog, HasEveryLineAtOnceAndEndsWithItsObject) {
  const TestDirectory directory;
  const auto path = directory.path() / "mine" / "id1" / "qconsole.log";
  auto log = ConsoleLog::open(path);
  ASSERT_TRUE(log.ok()) << log.error().message;
  log_info("two\nlines");
  log_warning("odd");
  log_error("bad");
  const std::string first = "Log file: " + path.string() + "\n";
  EXPECT_EQ(text_of(path), first + "two\nlines\nwarning: odd\nerror: bad\n") << "it is there after a crash, too";
  log->reset();
  log_info("after");
  EXPECT_EQ(text_of(path).find("after"), std::string::npos);
  log = ConsoleLog::open(path);
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(text_of(path), first) << "it begins anew";
}

TEST(ConsoleLog, WhereNothingCanBeWrittenIsASentence) {
  const TestDirectory directory;
  directory.put("file", "");
  const auto log = ConsoleLog::open(directory.path() / "file" / "qconsole.log");
  ASSERT_FALSE(log.ok());
  EXPECT_NE(log.error().message.find("-condebug: "), std::string::npos);
  EXPECT_NE(log.error().message.find("qconsole.log"), std::string::npos) << log.error().message;
}

TEST(ConsoleLog, TwoProgramsHaveTwoFiles) {
  const TestDirectory directory;
  const auto path = directory.path() / "qconsole.log";
  const auto first = ConsoleLog::open(path);
  const auto second = ConsoleLog::open(path);  // a lock is of one opening, so the same process will do
  ASSERT_TRUE(first.ok() && second.ok());
  log_info("line");
  EXPECT_NE(text_of(path).find("line"), std::string::npos);
  EXPECT_EQ(text_of(directory.path() / "qconsole2.log"),
            "Log file: " + (directory.path() / "qconsole2.log").string() + "\nline\n");
}

// A disk that fills up while the game runs.
TEST(ConsoleLog, AFullDiskIsToldOfOnce) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  testing::internal::CaptureStderr();
  const auto log = ConsoleLog::open("/dev/full");
  for (int i = 0; i < 3; ++i) log_info("line");
  const std::string said = testing::internal::GetCapturedStderr();
  const std::size_t at = said.find("-condebug: /dev/full cannot be written any more");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_EQ(said.find("-condebug", at + 1), std::string::npos) << said;
}

TEST(ConsoleLog, EndsBeforeItIsTooLarge) {
  const TestDirectory directory;
  const auto path = directory.path() / "qconsole.log";
  testing::internal::CaptureStderr();
  const auto log = ConsoleLog::open(path, 200 + path.string().size());
  for (int i = 0; i < 100; ++i) log_info("a line of twenty one");
  const std::string said = testing::internal::GetCapturedStderr(), text = text_of(path);
  EXPECT_LE(text.size(), 200 + path.string().size());
  EXPECT_GT(text.size(), 150 + path.string().size());
  EXPECT_TRUE(text.ends_with("twenty one\n")) << "whole lines";
  EXPECT_NE(said.find("-condebug"), std::string::npos);
  EXPECT_EQ(said.find("-condebug"), said.rfind("-condebug")) << said;
}

}  // namespace
}  // namespace fb::host
