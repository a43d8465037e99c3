#include <gmock/gmock.h>

#include "console/console.h"

namespace fb::con {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> names(const Completion& completion) {
  std::vector<std::string> list;
  for (const auto& candidate : completion.candidates) list.push_back(candidate.text);
  return list;
}

class CompletionTest : public testing::Test {
 protected:
  CompletionTest() {
    console.add_command("zz_play", "", [](const Args&) {});
    console.add_cvar("zz_plain", "0", "");
    console.execute("alias zz_pony echo");
    console.set_argument_completer("zz_play", [](std::string_view) {
      return std::vector<std::string>{"demo2", "demo1", "other"};
    });
  }
  Console console;
};

TEST_F(CompletionTest, CommandsCvarsAndAliasesTogether) {
  const Completion completion = console.complete("ZZ_");
  EXPECT_THAT(names(completion), ElementsAre("zz_plain", "zz_play", "zz_pony"));
  EXPECT_EQ(completion.candidates[0].kind, NameKind::kCvar);
  EXPECT_EQ(completion.candidates[1].kind, NameKind::kCommand);
  EXPECT_EQ(completion.candidates[2].kind, NameKind::kAlias);
  EXPECT_EQ(completion.line, "zz_p");
  EXPECT_EQ(console.complete("zz_pl").line, "zz_pla");
}

TEST_F(CompletionTest, ASingleOneIsFinished) { EXPECT_EQ(console.complete("zz_po").line, "zz_pony "); }

TEST_F(CompletionTest, NothingFitsOrNothingTyped) {
  EXPECT_THAT(console.complete("zzz").candidates, IsEmpty());
  EXPECT_EQ(console.complete("zzz").line, "zzz");
  EXPECT_THAT(console.complete("").candidates, IsEmpty());
}

TEST_F(CompletionTest, Arguments) {
  const Completion completion = console.complete("zz_play D");
  EXPECT_THAT(names(completion), ElementsAre("demo1", "demo2"));
  EXPECT_EQ(completion.line, "zz_play demo");
  EXPECT_THAT(names(console.complete("zz_play ")), ElementsAre("demo1", "demo2", "other"));
  EXPECT_THAT(console.complete("zz_pony d").candidates, IsEmpty());
  EXPECT_EQ(console.complete("toggle zz_pla").line, "toggle zz_plain ");
}

TEST_F(CompletionTest, TheLastCommandOfTheLine) {
  EXPECT_EQ(console.complete("echo a; zz_po").line, "echo a; zz_pony ");
  EXPECT_EQ(console.complete("echo a;zz_play o").line, "echo a;zz_play other ");
}

}  // namespace
}  // namespace fb::con
