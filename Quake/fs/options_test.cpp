#include "fs/options.h"

#include <gmock/gmock.h>
#include <pwd.h>
#include <stdlib.h>
#include <unistd.h>

namespace fb::fs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

FsOptions parse(const std::vector<std::string>& arguments) {
  auto options = options_from_arguments(arguments);
  EXPECT_TRUE(options) << options.error().message;
  return *std::move(options);
}

std::string failure(const std::vector<std::string>& arguments) {
  const auto options = options_from_arguments(arguments);
  return options ? "no failure" : options.error().message;
}

TEST(FsOptions, TheUserDirectoryMayBeNamed) {
  const std::vector<std::string> arguments{"-basedir", "base", "-userdir", "mine"};
  const auto options = options_from_arguments(arguments);
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options->base_dir, "base");
  ASSERT_TRUE(options->user_dir.has_value());
  EXPECT_EQ(*options->user_dir, "mine");
  const std::vector<std::string> cut{"-userdir"};
  EXPECT_NE(options_from_arguments(cut).error().message.find("-userdir"), std::string::npos);
}

TEST(FsOptions, WithoutAHomeFilesAreBesideTheGame) {
  const FsOptions options = parse({"-nohome", "-basedir", "base"});
  ASSERT_TRUE(options.user_dir.has_value());
  EXPECT_TRUE(options.user_dir->empty());
  EXPECT_FALSE(parse({"-basedir", "base"}).user_dir.has_value());
}

TEST(FsOptions, TheBaseGameIsNamedByItself) {
  const FsOptions options = parse({"-basegame", "box"});
  EXPECT_EQ(options.base_game, "box");
  EXPECT_FALSE(options.base_dir_named);
  EXPECT_TRUE(parse({"-basedir", "."}).base_dir_named);
  EXPECT_THAT(failure({"-basegame"}), HasSubstr("-basegame needs"));
}

TEST(FsOptions, NothingGiven) {
  const FsOptions options = parse({"fullbright", "+map", "start"});
  EXPECT_EQ(options.base_dir, ".");
  EXPECT_THAT(options.games, IsEmpty());
}

TEST(FsOptions, MissionPacksComeBeforeGames) {
  const FsOptions options = parse({"fullbright", "-game", "ad", "-basedir", "/quake", "-hipnotic"});
  EXPECT_EQ(options.base_dir, "/quake");
  EXPECT_THAT(options.games, ElementsAre("hipnotic", "ad"));
}

TEST(FsOptions, SeveralGamesInOrderEachOnce) {
  EXPECT_THAT(parse({"-game", "one", "-game", "two", "-game", "ONE", "-game", "ID1"}).games, ElementsAre("one", "two"));
  EXPECT_THAT(parse({"-rogue", "-game", "rogue"}).games, ElementsAre("rogue"));
}

TEST(FsOptions, Refusals) {
  EXPECT_THAT(failure({"-game"}), HasSubstr("-game needs"));
  EXPECT_THAT(failure({"-basedir"}), HasSubstr("-basedir needs"));
  EXPECT_THAT(failure({"-basedir", ""}), HasSubstr("-basedir needs"));
  EXPECT_THAT(failure({"-game", "../secret"}), HasSubstr("not a path"));
}

TEST(FsOptions, UserDirectoryFollowsTheEnvironment) {
  const char* home = ::getenv("HOME");
  const char* data = ::getenv("XDG_DATA_HOME");
  const std::string old_home = home != nullptr ? home : "", old_data = data != nullptr ? data : "";

  ::setenv("HOME", "/home/ranger", 1);
  ::unsetenv("XDG_DATA_HOME");
  EXPECT_EQ(default_user_dir(), "/home/ranger/.fullbright");
  ::setenv("XDG_DATA_HOME", "/data", 1);
  EXPECT_EQ(default_user_dir(), "/data/fullbright");
  ::setenv("XDG_DATA_HOME", "relative", 1);  // the specification has such a value ignored
  EXPECT_EQ(default_user_dir(), "/home/ranger/.fullbright");
  ::unsetenv("XDG_DATA_HOME");
  // What the system's list of users has, where that folder exists: never the game's own data.
  const passwd* user = ::getpwuid(::geteuid());
  const bool listed = user != nullptr && std::filesystem::is_directory(user->pw_dir);
  const auto at_home = listed ? std::filesystem::path(user->pw_dir) / ".fullbright" : std::filesystem::path();
  for (const char* no_home : {"", "relative"}) {
    ::setenv("HOME", no_home, 1);
    EXPECT_EQ(default_user_dir(), at_home) << no_home;
  }
  ::unsetenv("HOME");
  EXPECT_EQ(default_user_dir(), at_home);

  if (home != nullptr) ::setenv("HOME", old_home.c_str(), 1);
  if (data != nullptr) ::setenv("XDG_DATA_HOME", old_data.c_str(), 1);
}

}  // namespace
}  // namespace fb::fs
