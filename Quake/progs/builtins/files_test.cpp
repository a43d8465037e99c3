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
    services_.write_file = [this](std::string_view name, ByteView data) {
      files_[std::string(name)] = std::string(data.begin(), data.end());
      return ok_status();
    };
  }
  std::map<std::string, std::string> files_;
  std::vector<std::string> asked_;
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

TEST_F(FileBuiltinsTest, Limits) {
  EXPECT_EQ(says("local float i, f; for (i = 0; i < 100; i++) f = fopen(strcat(\"f\", ftos(i)), 2); put(f);"), "-1");
  EXPECT_THAT(says(R"(local float f; local string s; s = "0123456789abcdef"; f = fopen("big", 2);
                      while (strlen(s) < 60000) s = strcat(s, s); while (1) fputs(f, s, s, s, s);)"),
              HasSubstr("data/big would have more than 16777216 bytes"));
  files_["data/long"] = std::string((16u << 20u) + 1, 'x');
  EXPECT_EQ(says("put(fopen(\"long\", 0));"), "-1");
}

TEST_F(FileBuiltinsTest, WithoutFilesThereAreNone) {
  services_.read_file = nullptr;
  services_.write_file = nullptr;
  EXPECT_EQ(says("put(fopen(\"a\", 0)); local float f; f = fopen(\"b\", 2); fputs(f, \"x\"); fclose(f);"), "-1");
}

}  // namespace
}  // namespace fb::progs
