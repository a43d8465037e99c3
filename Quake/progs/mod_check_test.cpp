#include "progs/mod_check.h"

#include <gmock/gmock.h>

#include "progs/test_program.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using testing::compile;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::ProgramBuilder;
using ::testing::UnorderedElementsAre;

class ModCheckTest : public testing::QcTest {
 protected:
  Program program(const std::string& source, const std::string& options = "-O0") {
    const auto compiled = compile(testing::kBuiltinSource + source, options);
    EXPECT_FALSE(compiled.progs.empty()) << compiled.output;
    auto loaded = load_program(compiled.progs, "progs.dat");
    EXPECT_TRUE(loaded.ok());
    return std::move(*loaded);
  }
  std::vector<std::string> missing(const Program& program) {
    BuiltinTable table = standard_builtins({});
    table.set_idle(337, "pointparticles");
    return missing_here(
        program, {table, [](std::string_view name) { return name == "skill" || name == "temp1"; }, {}, {"EndFrame"}});
  }
};

constexpr const char* kAsks = R"(
void(float effect, vector place, vector direction, float count) pointparticles = #337;
void(string text) shake = #700;
void() never_called = #701;
void() think_of_others = #702;
float(string name) getcolor = #0;
float ask, level;
void() EndFrame = {};
void() main = {
  if (checkextension("FRIK_FILE")) ask = 1;
  if (checkextension("DP_NONE_SUCH") && checkextension("EXT_BITSHIFT")) ask = 2;
  level = cvar("skill");
  if (cvar("r_other") > cvar(strcat("r_", "unseen"))) cvar_set("r_more", "1");
  registercvar("mods_own", "1");
  if (cvar("mods_own")) cvar_set("temp1", ftos(cvar("skill")));
  pointparticles(1, '0 0 0', '0 0 0', 1);
  shake("it");
  getcolor("x");
  self.think = think_of_others;
};
)";

TEST_F(ModCheckTest, SaysWhatIsMissing) {
  for (const char* options : {"-O0", "-O1", "-O2", "-O3"}) {
    const bool named = std::string_view(options) == "-O0";  // the others leave out names of builtins
    const std::string unknown = ", which is not known here: a call does nothing and returns 0";
    EXPECT_THAT(
        missing(program(kAsks, options)),
        UnorderedElementsAre(
            "progs.dat calls the builtin getcolor" + unknown,
            "progs.dat calls builtin #337 (pointparticles), which does nothing here",
            (named ? "progs.dat calls builtin #700 (shake)" : "progs.dat calls builtin #700") + unknown,
            (named ? "progs.dat calls builtin #702 (think_of_others)" : "progs.dat calls builtin #702") + unknown,
            "progs.dat asks for the extension DP_NONE_SUCH, and is told that it is not there",
            "progs.dat reads the cvar r_other, which is not here: it reads 0",
            "progs.dat sets the cvar r_more, which is not here",
            "progs.dat has the function EndFrame, which is never called here"))
        << options;
  }
}

TEST_F(ModCheckTest, NeedsAreReadOffTheStatements) {
  const ModNeeds needs = needs_of(program(kAsks));
  EXPECT_THAT(needs.extensions, UnorderedElementsAre("FRIK_FILE", "DP_NONE_SUCH", "EXT_BITSHIFT"));
  EXPECT_THAT(needs.cvars_read, UnorderedElementsAre("skill", "r_other"));
  EXPECT_THAT(needs.cvars_set, UnorderedElementsAre("r_more", "temp1"));
  std::set<std::uint32_t> numbers;
  for (const auto& call : needs.builtins) numbers.insert(call.number);
  EXPECT_THAT(numbers, UnorderedElementsAre(0, 26, 45, 72, 93, 99, 115, 337, 700, 702));
}

TEST_F(ModCheckTest, NothingIsMissingWhereNothingIs) {
  EXPECT_THAT(missing(program("void() main = { cvar_set(\"skill\", ftos(vlen('1 2 3'))); };")), IsEmpty());
}

// Numbers mean what the names beside them say.
TEST_F(ModCheckTest, TheReReleasesNames) {
  const Program asks = program(
      "void(entity e, string s, ...) centerprint = #90; void(string s, ...) ex_bprint = "
      "#0;"
      "float() ex_finaleFinished = #0; void(vector v, float c, float l, float d) draw_point = #81;"
      "void(entity e) ex_none = #0; void() ex_unused = #0;"
      "void() main = { centerprint(self, \"x\"); ex_bprint(\"x\"); ex_finaleFinished(); draw_point('0 0 0', 1, 1, 1);"
      "ex_none(self); stof(\"1\"); };");
  const std::string unknown = ", which is not known here: a call does nothing and returns 0";
  EXPECT_THAT(missing(asks),
              UnorderedElementsAre("progs.dat calls builtin #81 (draw_point), which does nothing here",
                                   "progs.dat calls the builtin ex_finaleFinished, which does nothing here",
                                   "progs.dat calls the builtin ex_none" + unknown,
                                   // a bar has no players to print to
                                   "progs.dat calls builtin #90 (centerprint)" + unknown));
}

TEST_F(ModCheckTest, FunctionsThatTheEngineCalls) {
  const Program lacking = program("void() main = {}; void() PutClientInServer = {};");
  const auto sentences = missing_here(lacking, {standard_builtins({}), [](std::string_view) { return true; },
                                                server_functions(), server_functions_of_other_engines()});
  EXPECT_EQ(sentences.size(), server_functions().size() - 1);
  EXPECT_THAT(sentences, ::testing::Contains("progs.dat lacks the function StartFrame, which is called here"));
  EXPECT_THAT(server_functions(), ::testing::Contains("SetChangeParms"));
}

// Id's compiler puts constants among a function's locals.
TEST(ModCheck, ConstantsAmongLocals) {
  ProgramBuilder builder;
  const auto name = builder.string("r_local");
  const auto called = builder.word(builder.builtin("cvar", 45));
  const auto parm = builder.word(0), constant = builder.word(name);
  builder.function("f", {{Op::kStoreS, constant, kOfsParm0}, {Op::kCall1, called}, {Op::kDone}}, parm, 2, {1});
  builder.function("g", {{Op::kStoreS, parm, kOfsParm0}, {Op::kCall1, called}, {Op::kDone}}, parm, 2, {1});
  const auto loaded = load_program(builder.build(), "made.dat");
  ASSERT_TRUE(loaded.ok());
  EXPECT_THAT(needs_of(*loaded).cvars_read, ElementsAre("r_local"));
}

}  // namespace
}  // namespace fb::progs
