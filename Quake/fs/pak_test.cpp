#include "fs/pak.h"

#include <gmock/gmock.h>

#include "fs/test_files.h"

namespace fb::fs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

void set_u32(Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}
std::string failure(const Bytes& pak) {
  const auto parsed = parse_pak(pak, "test.pak");
  return parsed ? "no failure" : parsed.error().message;
}

TEST(Pak, EntriesAndBytes) {
  const TestDirectory directory;
  directory.put("x.pak", make_pak({{"maps/a.bsp", "alpha"}, {"empty", ""}, {"gfx\\b.lmp", "beta"}}));
  const auto pak = Pak::open(directory.path() / "x.pak", "id1/x.pak");
  ASSERT_TRUE(pak) << pak.error().message;
  EXPECT_EQ(pak->entries().size(), 3u);
  ASSERT_NE(pak->find("maps/a.bsp"), nullptr);
  EXPECT_EQ(as_text(*pak->read(*pak->find("maps/a.bsp"))), "alpha");
  EXPECT_EQ(as_text(*pak->read(*pak->find("empty"))), "");
  EXPECT_EQ(as_text(*pak->read(*pak->find("gfx/b.lmp"))), "beta");
  EXPECT_EQ(pak->find("MAPS/a.bsp"), nullptr);
  EXPECT_EQ(pak->find_ignoring_case("MAPS/A.bsp"), pak->find("maps/a.bsp"));
  EXPECT_EQ(pak->find("maps/c.bsp"), nullptr);
}

TEST(Pak, OfTwoWithOneNameTheFirstCounts) {
  const TestDirectory directory;
  directory.put("x.pak", make_pak({{"a", "first"}, {"a", "second"}}));
  const auto pak = Pak::open(directory.path() / "x.pak", "x.pak");
  ASSERT_TRUE(pak);
  EXPECT_EQ(as_text(*pak->read(*pak->find("a"))), "first");
}

TEST(Pak, NameThatFillsItsField) {
  const std::string name(kPakNameSize, 'n');
  const auto parsed = parse_pak(make_pak({{name, "x"}}), "test.pak");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->entries.front().name, name);
  EXPECT_EQ(parsed->warning, "");
}

TEST(Pak, EmptyDirectoryIsAPak) { EXPECT_TRUE(parse_pak(make_pak({}), "test.pak")); }

TEST(Pak, RefusesWithFileOffsetAndCause) {
  const Bytes good = make_pak({{"a", "alpha"}, {"b", "beta"}});
  EXPECT_THAT(failure({}), HasSubstr("too short"));
  EXPECT_THAT(failure(Bytes(good.begin(), good.begin() + 11)), HasSubstr("too short"));

  Bytes bad = good;
  bad[3] = 'X';
  EXPECT_THAT(failure(bad), HasSubstr("test.pak: offset 0: not a pak"));

  bad = good;
  set_u32(bad, 8, 100);
  EXPECT_THAT(failure(bad), HasSubstr("offset 8: the directory's length 100 is no multiple of 64"));

  bad = good;
  set_u32(bad, 8, 192);
  EXPECT_THAT(failure(bad), HasSubstr("offset 4: the directory (192 bytes at 21) reaches past the file's end at 149"));

  bad = good;
  set_u32(bad, 4, 0xffffffffu);
  EXPECT_THAT(failure(bad), HasSubstr("reaches past"));
}

// An interrupted download, or a tool's mistake: what is whole is used.
TEST(Pak, AnEntryOutsideIsLeftOutAlone) {
  Bytes bad = make_pak({{"a", "alpha"}, {"b", "beta"}, {"c", "gamma"}});
  set_u32(bad, 26 + 64 + 60, 0xfffffff0u);  // the second entry's size
  const auto parsed = parse_pak(bad, "test.pak");
  ASSERT_TRUE(parsed) << parsed.error().message;
  ASSERT_EQ(parsed->entries.size(), 2u);
  EXPECT_EQ(parsed->entries[1].name, "c");
  EXPECT_THAT(parsed->warning, StartsWith("test.pak: offset 90: entry 1 \"b\" (4294967280 bytes at 17)"));
  EXPECT_THAT(parsed->warning, HasSubstr("; it is left out"));
  set_u32(bad, 26 + 56, 1u << 31u);  // the first one's place
  EXPECT_THAT(parse_pak(bad, "test.pak")->warning, HasSubstr("it is left out (and 1 more)"));

  const TestDirectory directory;
  directory.put("x.pak", bad);
  ::testing::internal::CaptureStderr();
  const auto pak = Pak::open(directory.path() / "x.pak", "id1/x.pak");
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("id1/x.pak: offset "));
  ASSERT_TRUE(pak);
  EXPECT_EQ(pak->find("a"), nullptr);
  EXPECT_EQ(as_text(*pak->read(*pak->find("c"))), "gamma");
}

TEST(Pak, EveryTruncationIsRefused) {
  const Bytes good = make_pak({{"a", "alpha"}, {"b", "beta"}});
  ASSERT_TRUE(parse_pak(good, "test.pak"));
  const TestDirectory directory;
  for (std::size_t size = 0; size < good.size(); ++size) {
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(parse_pak(cut, "test.pak")) << size;
    directory.put("cut.pak", cut);
    const auto opened = Pak::open(directory.path() / "cut.pak", "id1/cut.pak");
    ASSERT_FALSE(opened) << size;
    EXPECT_THAT(opened.error().message, StartsWith("id1/cut.pak: offset ")) << size;
  }
}

TEST(Pak, AFileThatShrinksLaterIsAnError) {
  const TestDirectory directory;
  directory.put("x.pak", make_pak({{"a", "alpha"}}));
  const auto pak = Pak::open(directory.path() / "x.pak", "id1/x.pak");
  ASSERT_TRUE(pak);
  std::filesystem::resize_file(directory.path() / "x.pak", 14);
  const auto data = pak->read(*pak->find("a"));
  ASSERT_FALSE(data);
  EXPECT_THAT(data.error().message, StartsWith("id1/x.pak:a: "));
}

}  // namespace
}  // namespace fb::fs
