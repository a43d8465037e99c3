#include "fs/held_file.h"

#include <gmock/gmock.h>
#ifdef __unix__
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <atomic>
#include <csignal>
#include <thread>

#include "fs/temporary_file.h"
#include "fs/test_files.h"

namespace fb::fs {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
namespace stdfs = std::filesystem;

ByteView view(std::string_view text) {
  return ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

std::vector<std::string> names_in(const stdfs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : stdfs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

#ifdef __unix__
// What a program leaves that is killed while it writes.
void write_and_die(const stdfs::path& target) {
  const pid_t child = ::fork();
  if (child == 0) {
    auto file = TemporaryFile::create(target);
    (void)file->append(view("half"));
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
}
#endif

TEST(HeldFile, IsItsProgramsUntilItIsClosed) {
  const TestDirectory directory;
  const auto path = directory.path() / "x.part";
  {
    auto held = HeldFile::take(path);
    ASSERT_TRUE(held) << held.error().message;
    EXPECT_TRUE(held->append(view("one")));
    EXPECT_TRUE(held->append(view(" two")));
    EXPECT_TRUE(held->write_at(0, view("O")));
    const auto second = HeldFile::take(path);
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().message, EndsWith("x.part: another program is writing it"));
    remove_unless_held(path);
    EXPECT_EQ(as_text(*read_whole_file(path)), "One two");
  }
  const auto again = HeldFile::take(path);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->size(), 7u) << "taking changes nothing";
}

TEST(HeldFile, FoldersAreHeldLikeFiles) {
  const TestDirectory directory;
  const auto path = directory.path() / "a" / "film.part";
  {
    const auto held = HeldFile::take_folder(path);
    ASSERT_TRUE(held) << held.error().message;
    EXPECT_FALSE(HeldFile::take_folder(path));
  }
  EXPECT_TRUE(HeldFile::take_folder(path));
}

#ifdef __unix__
TEST(HeldFile, LinksAndPipesAreNotTaken) {
  const TestDirectory directory;
  directory.put("secret", "s");
  stdfs::create_symlink("secret", directory.path() / "link");
  ASSERT_EQ(::mkfifo(directory.file("pipe").c_str(), 0600), 0);
  for (const char* name : {"link", "pipe"}) {
    const auto held = HeldFile::take(directory.path() / name);
    ASSERT_FALSE(held) << name;
    EXPECT_THAT(held.error().message, HasSubstr("cannot be written")) << name;
  }
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "secret")), "s");
}
#endif

TEST(HeldFile, AFileWithASecondNameIsReplaced) {
  const TestDirectory directory;
  directory.put("secret", "s");
  stdfs::create_hard_link(directory.path() / "secret", directory.path() / "qconsole.log");
  const auto held = HeldFile::take(directory.path() / "qconsole.log");
  ASSERT_TRUE(held && held->append(view("line")));
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "secret")), "s");
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "qconsole.log")), "line");
}

TEST(TemporaryFile, HasANameOfItsOwn) {
  const TestDirectory directory;
  const auto target = directory.path() / "save.sav";
  auto a = TemporaryFile::create(target), b = TemporaryFile::create(target);
  ASSERT_TRUE(a && b);
  EXPECT_NE(a->path(), b->path());
  EXPECT_TRUE(is_temporary_name(a->path().filename().string()));
  ASSERT_TRUE(a->append(view("from a")) && b->append(view("b")));
  ASSERT_TRUE(a->commit(Flush::kNow));
  EXPECT_EQ(as_text(*read_whole_file(target)), "from a");
  ASSERT_TRUE(b->commit(Flush::kLater));
  EXPECT_EQ(as_text(*read_whole_file(target)), "b");
  EXPECT_THAT(names_in(directory.path()), ElementsAre("save.sav"));
}

TEST(TemporaryFile, OnlyItsOwnNamesAreTemporary) {
  EXPECT_TRUE(is_temporary_name(".fullbright-12-0123456789abcdef.new"));
  for (const char* name :
       {"", ".new", ".fullbright-.new", ".fullbright-new", "config.cfg.new", ".fullbright-12-0123456789abcdef.newer",
        ".fullbright-12-0123456789abcde.new", ".fullbright-x-0123456789abcdef.new", ".fullbright-0123456789abcdef.new",
        ".fullbright-12-0123456789ABCDEF.new", "fullbright-12-0123456789abcdef.new"})
    EXPECT_FALSE(is_temporary_name(name)) << name;
}

TEST(TemporaryFile, WhatWasNotCommittedIsGone) {
  const TestDirectory directory;
  directory.put("x", "old");
  {
    auto file = TemporaryFile::create(directory.path() / "x");
    ASSERT_TRUE(file && file->append(view("new")));
  }
  EXPECT_THAT(names_in(directory.path()), ElementsAre("x"));
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "x")), "old");
}

#ifdef __unix__
TEST(TemporaryFile, WhatAKilledProgramLeftIsRemovedAndALivingOnesStays) {
  const TestDirectory directory;
  write_and_die(directory.path() / "a" / "x");
  ASSERT_EQ(names_in(directory.path() / "a").size(), 1u) << "or this tests nothing";
  const std::string living = ".fullbright-7-0123456789abcdef.new", foreign = "x.new";
  directory.put("a/" + foreign, "a user's own");
  const auto held = HeldFile::take(directory.path() / "a" / living);
  ASSERT_TRUE(held);
  ASSERT_TRUE(write_file_atomically(directory.path() / "a" / "y", view("whole")));
  EXPECT_THAT(names_in(directory.path() / "a"), ElementsAre(living, foreign, "y"));
}
#endif

#ifdef __unix__
TEST(TemporaryFile, KeepsThePermissionsOfWhatItReplaces) {
  const TestDirectory directory;
  directory.put("config.cfg", "old");
  const auto path = directory.path() / "config.cfg";
  stdfs::permissions(path, stdfs::perms::owner_read | stdfs::perms::owner_write);
  ASSERT_TRUE(write_file_atomically(path, view("new")));
  EXPECT_EQ(stdfs::status(path).permissions(), stdfs::perms::owner_read | stdfs::perms::owner_write);
}
#endif

TEST(TemporaryFile, ALongNameIsNoObstacle) {
  const TestDirectory directory;
  const std::string name(255, 'x');  // as long as file systems have them
  ASSERT_TRUE(write_file_atomically(directory.path() / name, view("x")));
  EXPECT_THAT(names_in(directory.path()), ElementsAre(name));
}

TEST(TemporaryFile, ManyWritersAndSweepersNeverMeet) {
  const TestDirectory directory;
  const auto target = directory.path() / "x";
  const std::string texts[] = {std::string(1000, 'a'), std::string(50000, 'b'), "c", std::string(9000, 'd')};
  std::atomic<int> failures = 0, halves = 0;
  std::atomic<bool> over = false;
  std::vector<std::thread> sweepers;
  for (int i = 0; i < 4; ++i) {
    sweepers.emplace_back([&] {
      while (!over) {
        std::error_code code;
        for (stdfs::directory_iterator it(directory.path(), code), end; !code && it != end; it.increment(code))
          if (is_temporary_name(it->path().filename().string())) remove_unless_held(it->path());
      }
    });
  }
  std::thread reader([&] {
    while (!over) {
      const auto data = read_whole_file(target);
      if (data && std::ranges::find(texts, as_text(*data)) == std::end(texts)) ++halves;
    }
  });
  std::vector<std::thread> writers;
  for (const std::string& text : texts) {
    writers.emplace_back([&] {
      for (int i = 0; i < 300; ++i)
        if (!write_file_atomically(target, view(text), Flush::kLater)) ++failures;
    });
  }
  for (std::thread& writer : writers) writer.join();
  over = true;
  for (std::thread& sweeper : sweepers) sweeper.join();
  reader.join();
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(halves, 0);
  EXPECT_THAT(names_in(directory.path()), ElementsAre("x"));
}

#ifdef __unix__
TEST(Output, FollowsTheUsersLinksAndWritesToDevices) {
  const TestDirectory directory;
  directory.put("elsewhere/report.json", "old");
  stdfs::create_symlink("elsewhere/report.json", directory.path() / "report.json");
  ASSERT_TRUE(write_output(directory.path() / "report.json", "new"));
  EXPECT_TRUE(stdfs::is_symlink(directory.path() / "report.json"));
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "elsewhere/report.json")), "new");
  stdfs::create_symlink("circle", directory.path() / "circle");
  const auto circle = write_output(directory.path() / "circle", "x");
  ASSERT_FALSE(circle);
  EXPECT_THAT(circle.error().message, HasSubstr("circle"));
  ASSERT_TRUE(write_output("/dev/null", "x"));
  EXPECT_TRUE(stdfs::is_character_file("/dev/null")) << "root could replace it";
  if (stdfs::exists("/dev/full")) {
    EXPECT_FALSE(write_output("/dev/full", "x"));
  }
  // /dev/stdout in a pipeline is a link to one of these, which leads to no path.
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const std::string name = "/dev/fd/" + std::to_string(ends[1]);
  if (stdfs::exists(name)) {
    ASSERT_TRUE(write_output(name, "through"));
    char text[8] = {};
    ASSERT_EQ(read(ends[0], text, 7), 7);
    EXPECT_STREQ(text, "through");
  }
  close(ends[0]);
  close(ends[1]);
}
#endif

}  // namespace
}  // namespace fb::fs
