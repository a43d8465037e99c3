#include <gmock/gmock.h>

#include "console/console.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;

class BufferBuiltinsTest : public testing::QcTest {
 protected:
  std::string says(const std::string& statements) { return QcTest::says(statements, kDeclared); }
  std::string warned(const std::string& statements) { return QcTest::warned(statements, kDeclared); }

 private:
  static constexpr const char* kDeclared = R"(
float() buf_create = #460;
void(float buffer) buf_del = #461;
float(float buffer) buf_getsize = #462;
void(float from, float to) buf_copy = #463;
void(float buffer, float letters, float backwards) buf_sort = #464;
string(float buffer, string glue) buf_implode = #465;
string(float buffer, float place) bufstr_get = #466;
void(float buffer, float place, string text) bufstr_set = #467;
float(float buffer, string text, float at_the_end) bufstr_add = #468;
void(float buffer, float place) bufstr_free = #469;
void(float buffer, string wanted, string unwanted) buf_cvarlist = #517;
)";
};

TEST_F(BufferBuiltinsTest, StringsHavePlaces) {
  EXPECT_EQ(says(R"(local float b; b = buf_create(); put(b); bufstr_set(b, 3, "three"); put(buf_getsize(b));
                    puts(bufstr_get(b, 3)); puts(bufstr_get(b, 0)); puts(bufstr_get(b, 99)); puts(bufstr_get(b, -1));
                    put(bufstr_add(b, "first", 0)); put(bufstr_add(b, "last", 1)); bufstr_free(b, 4);
                    put(buf_getsize(b)); puts(buf_implode(b, "+"));)"),
            "1 4 [three] [] [] [] 0 4 4 [first+three]");
}

TEST_F(BufferBuiltinsTest, SortedAndCopied) {
  EXPECT_EQ(says(R"(local float a, b; a = buf_create(); b = buf_create(); put(b);
                    bufstr_set(a, 0, "bc"); bufstr_set(a, 2, "ba"); bufstr_set(a, 3, "a"); buf_sort(a, 0, 0);
                    puts(buf_implode(a, " ")); buf_sort(a, 1, 1); puts(buf_implode(a, " ")); buf_copy(a, b);
                    bufstr_set(a, 0, "x"); puts(buf_implode(b, "")); put(buf_getsize(b));)"),
            "2 [a ba bc] [ba bc a] [babca] 3");
}

TEST_F(BufferBuiltinsTest, WhatIsNoBufferIsWarnedOf) {
  EXPECT_THAT(warned("bufstr_set(7, 0, \"x\"); put(buf_getsize(7));"), HasSubstr("there is no such string buffer"));
  EXPECT_EQ(output(), "0");
  EXPECT_THAT(warned("local float b; b = buf_create(); buf_del(b); put(buf_create()); bufstr_get(2, 0);"),
              HasSubstr("there is no such string buffer"));
  EXPECT_EQ(output(), "1") << "a place that is free again";
}

TEST_F(BufferBuiltinsTest, TheyHaveAnEnd) {
  EXPECT_THAT(warned("local float b; b = buf_create(); bufstr_set(b, 70000, \"x\"); bufstr_set(b, -1, \"x\");"
                     "put(buf_getsize(b));"),
              HasSubstr("holds no more"));
  EXPECT_EQ(output(), "0");
  EXPECT_THAT(warned("local float i, n; for (i = 0; i < 2000; i++) n = buf_create(); put(n);"), HasSubstr("too many"));
  EXPECT_EQ(output(), "-1");
}

TEST_F(BufferBuiltinsTest, NamesOfCvars) {
  con::Console console;
  for (const char* name : {"of_mod_a", "of_mod_b", "of_mod_c", "other"}) console.add_cvar(name, "0", "");
  services_.console = &console;
  EXPECT_EQ(says(R"(local float b; b = buf_create(); buf_cvarlist(b, "of_mod", "*_b"); puts(buf_implode(b, " "));
                    buf_cvarlist(b, "*mod_?", ""); put(buf_getsize(b));)"),
            "[of_mod_a of_mod_c] 3");
}

}  // namespace
}  // namespace fb::progs
