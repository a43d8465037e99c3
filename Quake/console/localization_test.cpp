#include "console/localization.h"

#include <gtest/gtest.h>

#include <vector>

namespace fb::con {
namespace {

class LocalizationTest : public ::testing::Test {
 protected:
  std::size_t add(std::string_view file) {
    const auto added = texts.add({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, "loc.txt");
    return added ? *added : 0;
  }
  std::string message(std::vector<std::string_view> pieces) const { return texts.message(pieces); }
  std::string text(std::string_view key) const { return std::string(texts.text(key)); }

  Localization texts;
};

TEST_F(LocalizationTest, ReadsKeysAndTexts) {
  EXPECT_EQ(add("\xef\xbb\xbfm_hello = \"Welcome\"\r\n"
                "// comment = \"none\"\n"
                "\n"
                "no sign of a text\n"
                "  qc_plain =  a text without quotes  \r\n"
                "\"quoted\" = \"say \\\"hi\\\",\\n\\tor \\'lo\\\\\"  // behind it\n"
                "m_hello = \"a second one\"\n"
                "last = \"no line break\""),
            4u);
  EXPECT_EQ(text("$m_hello"), "Welcome");
  EXPECT_EQ(text("$qc_plain"), "a text without quotes");
  EXPECT_EQ(text("$quoted"), "say \"hi\",\n\tor 'lo\\");
  EXPECT_EQ(text("$last"), "no line break");
  EXPECT_EQ(text("$none"), "$none");
  EXPECT_EQ(text("m_hello"), "m_hello");
  EXPECT_EQ(text("$m_hello "), "$m_hello ") << "the key is the whole text";
  EXPECT_EQ(text("$"), "$");
  EXPECT_EQ(text(""), "");
}

TEST_F(LocalizationTest, WhatIsThereAlreadyStays) {
  EXPECT_EQ(add("a = \"Deutsch\"\n"), 1u);
  EXPECT_EQ(add("a = \"English\"\nb = \"only English\"\n"), 1u);
  EXPECT_EQ(text("$a"), "Deutsch");
  EXPECT_EQ(text("$b"), "only English");
  texts.clear();
  EXPECT_EQ(text("$a"), "$a");
}

TEST_F(LocalizationTest, Messages) {
  EXPECT_EQ(message({}), "");
  EXPECT_EQ(message({"{0} and ", "{1}"}), "{0} and {1}") << "placeholders mean nothing without a file";
  add("got = \"{0} got {1}\\n\"\nitem = \"a {0}\"\nswapped = \"{1}, {0}, {}, {9}, {0\"\nplain = \"plain\"\n");
  EXPECT_EQ(message({"$got", "Ranger", "$plain"}), "Ranger got plain\n");
  EXPECT_EQ(message({"$got", "{1}", "$item"}), "{1} got a {0}\n") << "what is put in is not looked through again";
  EXPECT_EQ(message({"$swapped", "a", "b"}), "b, a, a, , {0");
  EXPECT_EQ(message({"$plain", " and ", "$plain", "$none"}), "plain and plain$none");
  EXPECT_EQ(message({"centre {0}", "arg"}), "centre arg");
  EXPECT_EQ(message({"{99999999999999999999}", "x"}), "");
}

TEST_F(LocalizationTest, HostileFilesHaveLimits) {
  const std::string large(Localization::kMostFileBytes + 1, 'x');
  const auto refused = texts.add({reinterpret_cast<const std::uint8_t*>(large.data()), large.size()}, "loc.txt");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "loc.txt: 8388609 bytes of texts, of 8388608 that are read");

  std::string many;
  for (std::size_t i = 0; i <= Localization::kMostTexts; ++i) many += std::to_string(i) + "=x\n";
  const auto cut = texts.add({reinterpret_cast<const std::uint8_t*>(many.data()), many.size()}, "loc.txt");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().message, "loc.txt: more than 65536 texts; the others are left out");
  EXPECT_EQ(texts.size(), Localization::kMostTexts);
  EXPECT_EQ(text("$65535"), "x");

  texts.clear();
  add(std::string(300, 'k') + " = \"too long a key\"\nlong = \"" + std::string(9000, 'v') + "\"\nnul = \"a" +
      std::string(1, '\0') + "b\"\n");
  EXPECT_EQ(texts.size(), 2u);
  EXPECT_EQ(text("$long").size(), Localization::kMostTextBytes);
  EXPECT_EQ(text("$nul"), "ab");
}

TEST_F(LocalizationTest, AMessageDoesNotGrowWithoutEnd) {
  std::string format = "f = \"";
  for (int i = 0; i < 2000; ++i) format += "{0}";
  add(format + "\"\n");
  const std::string piece(60000, 'x');
  EXPECT_EQ(message({"$f", piece}).size(), Localization::kMostMessageBytes);
  EXPECT_EQ(message({piece, piece}).size(), Localization::kMostMessageBytes);
}

}  // namespace
}  // namespace fb::con
