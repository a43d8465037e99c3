#include <gmock/gmock.h>

#include <map>

#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Files in memory, by the names that the engine is asked for.
class FileBuiltinsTest : public testing::QcTest {
 protected:
  void SetUp() override {
    QcTest::SetUp();
    services_.read_file = [this](std::string_view name) -> std::optional<Bytes> {
      asked_.emplace_back(name);
      const auto found = files_.find(std::string(name));
      if (found == files_.end()) return std::nullopt;
      return Bytes(found->second.begin(), found->second.end());
    };
    services_.flush_files = [this] { ++flushes_; };
    services_.write_file = [this](std::string_view name, ByteView data) {
      files_[std::string(name)] = std::string(data.begin(), data.end());
      return ok_status();
    };
  }
  std::map<std::string, std::string> files_;
  std::vector<std::string> asked_;
  int flushes_ = 0;
};

TEST_F(FileBuiltinsTest, ReadsLines) {
  files_["data/a.txt"] = "one\r\n\nthree";
  EXPECT_EQ(says("local float f; f = fopen(\"a.txt\", 0); put(f >= 0); puts(fgets(f)); puts(fgets(f)); puts(fgets(f));"
                 "putnull(fgets(f)); fclose(f);"),
            "1 [one] [] [three] null");
}

TEST_F(FileBuiltinsTest, ReadingFallsBackOnTheGamesFiles) {
  files_["maps/list.txt"] = "start";
  EXPECT_EQ(says("puts(fgets(fopen(\"maps/list.txt\", 0))); put(fopen(\"nothing\", 0));"), "[start] -1");
  EXPECT_THAT(asked_, ElementsAre("data/maps/list.txt", "maps/list.txt", "data/nothing", "nothing"));
}

TEST_F(FileBuiltinsTest, Writes) {
  files_["data/log.txt"] = "old\n";
  EXPECT_EQ(says("local float f; f = fopen(\"log.txt\", 1); fputs(f, \"more \", ftos(5), \"\\n\"); fclose(f);"
                 "f = fopen(\"new.txt\", 2); fputs(f, \"x\"); fclose(f); f = fopen(\"log.txt\", 0); fgets(f); "
                 "puts(fgets(f));"),
            "[more 5]");
  EXPECT_EQ(files_["data/log.txt"], "old\nmore 5\n");
  EXPECT_EQ(files_["data/new.txt"], "x");
}

TEST_F(FileBuiltinsTest, WhatStaysOpenIsSavedWithTheLevelsEnd) {
  EXPECT_EQ(says("fputs(fopen(\"open.txt\", 2), \"kept\");"), "");
  EXPECT_FALSE(files_.contains("data/open.txt"));
  vm_.reset();
  EXPECT_EQ(files_["data/open.txt"], "kept");
}

TEST_F(FileBuiltinsTest, NoNameLeadsOutOfTheGame) {
  EXPECT_EQ(
      says(R"(put(fopen("../secret", 0)); put(fopen("/etc/passwd", 0)); put(fopen("a/../../b", 2)); put(fopen("", 2));
                    put(fopen("c:\\x", 2)); put(fopen("..\\x", 2)); put(fopen("x", 9));)"),
      "-1 -1 -1 -1 -1 -1 -1");
  EXPECT_THAT(asked_, IsEmpty());
  EXPECT_THAT(files_, IsEmpty());
}

TEST_F(FileBuiltinsTest, HandlesThatAreNone) {
  files_["data/a.txt"] = "one";
  EXPECT_EQ(says("puts(fgets(0)); puts(fgets(-1)); fputs(99, \"x\"); fclose(7); local float f; f = fopen(\"a.txt\", 0);"
                 "fputs(f, \"x\"); fclose(f); fclose(f); puts(fgets(f)); f = fopen(\"b\", 2); puts(fgets(f));"),
            "[] [] [] []");
  EXPECT_EQ(files_["data/a.txt"], "one");
}

TEST_F(FileBuiltinsTest, WhatIsWrongIsToldWithItsPlace) {
  files_["data/long"] = std::string((16u << 20u) + 1, 'x');
  for (const auto& [call, told] : std::map<std::string, std::string>{
           {"fclose(7);", "fclose: 7 is no file that is open for this"},
           {"fopen(\"../x\", 0);", "fopen: no name for a file of the mod"},
           {"fopen(\"x\", 9);", "fopen: 9 is no mode"},
           {"fopen(\"long\", 0);", "fopen: data/long has 16777217 bytes; at most 16777216 can be read"},
           {"puts(sprintf(\"%y\"));", "sprintf cannot make sense of \"%y\""}}) {
    EXPECT_THAT(warned(call), HasSubstr("statement")) << call;
    EXPECT_THAT(warned(call), HasSubstr(told));
  }
}

TEST_F(FileBuiltinsTest, Limits) {
  EXPECT_EQ(says("local float i, f; for (i = 0; i < 100; i++) f = fopen(strcat(\"f\", ftos(i)), 2); put(f);"), "-1");
  files_["data/long"] = std::string((16u << 20u) + 1, 'x');
  EXPECT_EQ(says("put(fopen(\"long\", 0));"), "-1");
}

// 16 MB a file, 64 MB in all that are open: what is more is left out, and the game goes on.
TEST_F(FileBuiltinsTest, TooMuchTextIsLeftOut) {
  const std::string grow =
      "local float f, i; local string s; s = \"0123456789abcdef\"; "
      "while (strlen(s) < 60000) s = strcat(s, s); ";  // to the most that a string has
  EXPECT_EQ(says(grow + "f = fopen(\"big\", 2); for (i = 0; i < 70; i++) fputs(f, s, s, s, s); fclose(f); put(f);"),
            "1");
  constexpr std::size_t kLine = std::size_t{4} * 65535;  // what one fputs adds
  EXPECT_EQ(files_["data/big"].size(), (16u << 20u) / kLine * kLine);
  EXPECT_EQ(says(grow + "local float n; for (n = 0; n < 5; n++) { f = fopen(ftos(n), 2); for (i = 0; i < 60; i++) "
                        "fputs(f, s, s, s, s); } put(f);"),
            "5");
  vm_.reset();
  std::size_t sum = 0;
  for (const char* name : {"0", "1", "2", "3", "4"}) sum += files_[std::string("data/") + name].size();
  EXPECT_EQ(sum, (64u << 20u) / kLine * kLine);
}

TEST_F(FileBuiltinsTest, ManyFilesAreFlushedOnce) {
  EXPECT_EQ(says("local float i, f; for (i = 0; i < 2000; i++) { f = fopen(ftos(i), 2); fputs(f, \"x\"); fclose(f); }"),
            "");
  EXPECT_EQ(flushes_, 0);
  vm_.reset();
  EXPECT_EQ(flushes_, 1);
  EXPECT_EQ(files_.size(), 2000u);
}

TEST_F(FileBuiltinsTest, ReadingNeedsNoFlush) {
  EXPECT_EQ(says("put(fopen(\"none\", 0));"), "-1");
  vm_.reset();
  EXPECT_EQ(flushes_, 0);
}

// A loop of nothing but files does as much work as one of statements: it ends as a loop without end.
TEST_F(FileBuiltinsTest, FilesCountAsStatements) {
  EXPECT_THAT(says("local float f; while (1) { f = fopen(\"x\", 2); fclose(f); }"), HasSubstr("a loop without end"));
  EXPECT_LT(asked_.size(), 10000u);
  files_["data/long"] = std::string(8u << 20u, 'x');
  asked_.clear();
  EXPECT_THAT(says("while (1) fclose(fopen(\"long\", 0));"), HasSubstr("a loop without end"));
  EXPECT_LT(asked_.size(), 40u);
}

TEST_F(FileBuiltinsTest, WithoutFilesThereAreNone) {
  services_.read_file = nullptr;
  services_.write_file = nullptr;
  EXPECT_EQ(says("put(fopen(\"a\", 0)); local float f; f = fopen(\"b\", 2); fputs(f, \"x\"); fclose(f);"), "-1");
}

}  // namespace
}  // namespace fb::progs
