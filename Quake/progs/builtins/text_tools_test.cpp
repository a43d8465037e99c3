// Strings for programs and pages, FTE's integers, functions and fields by name, and what is asked of the console.
#include <gmock/gmock.h>

#include "console/console.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;

class TextToolsTest : public testing::QcTest {};

TEST_F(TextToolsTest, Trimming) {
  EXPECT_EQ(
      says("puts(strtrim(\"  a b\\n\")); puts(strtrim(\"\")); puts(strtrim(\" \"));", "string(string s) strtrim = #0;"),
      "[a b] [] []");
}

TEST_F(TextToolsTest, MarksOfColour) {
  EXPECT_EQ(says("put(strlennocol(\"^1red^7 ^xf80x\")); puts(strdecolorize(\"^1red^7 ^xf80x ^^\"));",
                 "float(string s) strlennocol = #476; string(string s) strdecolorize = #477;"),
            "5 [red x ^]");
}

TEST_F(TextToolsTest, Uris) {
  const std::string before = "string(string s) uri_escape = #510; string(string s) uri_unescape = #511;";
  EXPECT_EQ(says("puts(uri_escape(\"a b/c-d_e.f&\")); puts(uri_unescape(\"a%20b%2fc\"));"
                 "puts(uri_unescape(\"100%\")); puts(uri_unescape(\"%4\")); puts(uri_unescape(\"a%00b\"));",
                 before),
            "[a%20b%2Fc-d_e.f%26] [a b/c] [100%] [%4] [ab]");
}

// CRC-16 of "123456789" as its catalogues give it (CCITT, beginning with ffff).
TEST_F(TextToolsTest, Checksums) {
  const std::string before = "float(float fold, string s, ...) crc16 = #494;";
  EXPECT_EQ(says("put(crc16(0, \"123456789\")); put(crc16(0, \"1234\", \"56789\"));"
                 "if (crc16(1, \"ABC\") == crc16(0, \"abc\")) puts(\"folded\");",
                 before),
            "10673 10673 [folded]");
}

TEST_F(TextToolsTest, Dates) {
  EXPECT_EQ(says("puts(strftime(0, \"day%%\", \" of\")); put(strlen(strftime(0, \"%Y-%m-%d\")));"
                 "put(strlen(strftime(1, \"%H:%M\")));",
                 "string(float here, string format, ...) strftime = #478;"),
            "[day% of] 10 5");
}

TEST_F(TextToolsTest, Integers) {
  const std::string before =
      "float(float f) ftoi = #0; float(float i) itof = #0; float(string s) stoi = #259; string(float i) itos = #260;"
      "float(string s) stoh = #261; string(float i) htos = #262;";
  EXPECT_EQ(says("put(itof(ftoi(-3.7))); puts(itos(ftoi(42.9))); put(itof(stoi(\"0x10\"))); put(itof(stoi(\"-12x\")));"
                 "puts(htos(stoh(\"ff00ff\"))); puts(htos(ftoi(-1))); puts(htos(stoh(\"ffffffff\")));"
                 "puts(itos(stoi(\"99999999999\"))); puts(sprintf(\"%i %p\", ftoi(7), ftoi(255)));",
                 before),
            "-3 [42] 16 -12 [00ff00ff] [ffffffff] [ffffffff] [2147483647] [7 000000ff]");
}

TEST_F(TextToolsTest, QuotedStrings) {
  EXPECT_EQ(says(R"(puts(sprintf("say %S", "a b")); puts(sprintf("%S", "with \"quotes\""));)"), R"([say "a b"] [""])");
}

TEST_F(TextToolsTest, FunctionsByName) {
  const std::string before = R"(
    void(...) callfunction = #605; float(string name) isfunction = #607;
    void(float a, string b) told = { put(a); puts(b); };
    void() fails = { error("on purpose"); };)";
  EXPECT_EQ(says("callfunction(3, \"three\", \"told\"); put(isfunction(\"told\")); put(isfunction(\"never\"));"
                 "put(isfunction(\"strlen\"));",
                 before),
            "3 [three] 1 0 0");
  EXPECT_THAT(warned("callfunction(1, \"never\"); puts(\"on\");", before), HasSubstr("no function \"never\""));
  EXPECT_EQ(output(), "[on]");
  EXPECT_THAT(says("callfunction(\"fails\"); puts(\"on\");", before), HasSubstr("the mod gives up: on purpose"));
}

TEST_F(TextToolsTest, EntitiesAtOnce) {
  const std::string before = R"(
    entity(entity from, ...) copyentity = #400; float(entity e, string s, ...) parseentitydata = #613;
    float(string name) findentityfield = #0; float(entity e) etof = #0; entity(float n) ftoe = #0;)";
  EXPECT_EQ(says(R"(local entity a, b; a = spawn(); a.health = 5; a.classname = "thing"; b = copyentity(a); pute(b);
                    put(b.health); puts(b.classname); a.health = 6; copyentity(a, b); put(b.health);
                    put(etof(b)); pute(ftoe(2));)",
                 before),
            "e3 5 [thing] 6 3 e2");
  EXPECT_EQ(says(R"(local entity e; e = spawn(); put(parseentitydata(e, "{\"health\" \"7\"} {")); put(e.health);
                    put(parseentitydata(e, "x {\"health\" \"8\"}", 1)); put(e.health);
                    put(parseentitydata(e, "no entity"));)",
                 before),
            "14 7 16 8 0");
  EXPECT_EQ(says("puts(entityfieldname(findentityfield(\"health\"))); put(findentityfield(\"never\"));", before),
            "[health] 0");
  ASSERT_TRUE(start(std::string(testing::kBuiltinSource) + before + "void() main = { copyentity(spawn(), world); };"));
  vm_->protect_world = true;
  EXPECT_EQ(error_of(), "");
  EXPECT_THAT(vm_->warning(), HasSubstr("copyentity to what is no entity that QuakeC may write"));
}

TEST_F(TextToolsTest, FieldsByReference) {
  EXPECT_EQ(says("local field_t f; f = entityfieldref(findentityfield(\"health\")); self.health = 9; put(self.f);",
                 "typedef .float field_t; field_t(float n) entityfieldref = #0; float(string s) findentityfield = #0;"),
            "9");
}

TEST_F(TextToolsTest, WhatTheConsoleKnows) {
  con::Console console;
  console.add_cvar("of_mod", "1", "what it is for");
  console.execute_line("alias twice \"echo echo\"");
  services_.console = &console;
  std::string printed;
  services_.print = [&](std::string_view text) { printed += text; };
  const std::string before =
      "float(string name) checkcommand = #294; string(string name) cvar_description = #518; void(string s, ...) print "
      "= #339; float() gettime = #519;";
  EXPECT_EQ(says("put(checkcommand(\"echo\")); put(checkcommand(\"twice\")); put(checkcommand(\"of_mod\"));"
                 "put(checkcommand(\"nothing\")); puts(cvar_description(\"of_mod\")); puts(cvar_description(\"no\"));"
                 "print(\"one \", \"line\"); if (gettime() >= 0) puts(\"time\");",
                 before),
            "1 2 3 0 [what it is for] [] [time]");
  EXPECT_EQ(printed, "one line");
}

}  // namespace
}  // namespace fb::progs
