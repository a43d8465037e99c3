#include "progs/vm.h"

#include <gmock/gmock.h>

#include <vector>

#include "fs/test_log.h"
#include "progs/test_program.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class VmTest : public testing::QcTest {};

TEST_F(VmTest, RunsAFunction) {
  EXPECT_EQ(says("put(1 + 2); puts(\"a\"); putv('1 2 3'); pute(self);"), "3 [a] (1 2 3) e0");
}

TEST_F(VmTest, CallsAndRestoresLocals) {
  EXPECT_EQ(output_of(R"(
    float(float n) fib = { if (n < 2) return n; return fib(n - 1) + fib(n - 2); };
    float(float a, vector v, float b) mixed = { local float kept; kept = a + v_x + v_y + v_z + b;
      if (a > 0) { mixed(a - 1, v, b); } return kept; };
    void() main = { put(fib(15)); put(mixed(3, '10 20 30', 100)); };
  )"),
            "610 163");
}

TEST_F(VmTest, OptimisedCodeRunsTheSame) {
  const std::string source = R"(
    .float count;
    float(float n) sum = { local float i, s; for (i = 0; i < n; i++) { if (i == 3) continue; s = s + i; } return s; };
    void() main = { self.count = sum(10); self.count = self.count * 2; put(self.count); if (!self.enemy) puts("none"); };
  )";
  for (const char* options : {"-O0", "-O1", "-O2"}) {
    ASSERT_TRUE(start(source, options));
    EXPECT_EQ(error_of(), "");
    EXPECT_EQ(output(), "84 [none]") << options;
  }
}

TEST_F(VmTest, StopsWhatNeverEnds) {
  options_.max_statements = 100000;
  EXPECT_THAT(says("while (1) { }"), HasSubstr("main (test.qc), statement "));
  EXPECT_THAT(says("while (1) { }"), HasSubstr("more than 100000 statements: a loop without end"));
}

TEST_F(VmTest, StopsRecursionWithoutEnd) {
  ASSERT_TRUE(start("void() deeper = { deeper(); }; void() main = { deeper(); };"));
  EXPECT_THAT(error_of(), HasSubstr("stack overflow"));
  EXPECT_THAT(vm_->backtrace(), StartsWith("     test.qc : deeper, statement "));
  EXPECT_THAT(vm_->backtrace(), HasSubstr("\n         ...\n"));
  EXPECT_THAT(vm_->backtrace(), ::testing::ContainsRegex("\n     test.qc : main, statement [0-9]+ \\(CALL0\\)$"));
  EXPECT_FALSE(vm_->running());
}

TEST_F(VmTest, StopsLocalsWithoutEnd) {
  options_.max_local_words = 1000;
  ASSERT_TRUE(
      start("void(float n) deeper = { local vector a, b, c, d; a = b = c = d; deeper(n); };"
            "void() main = { deeper(1); };"));
  EXPECT_THAT(error_of(), HasSubstr("take more than 1000 words"));
}

TEST_F(VmTest, TheBacktraceNamesEveryCaller) {
  ASSERT_TRUE(
      start("void() nothing; void() inner = { local void() f; f(); }; void() outer = { inner(); };"
            "void() main = { outer(); };"));
  const std::string error = error_of();
  EXPECT_THAT(error,
              ::testing::MatchesRegex("progs.dat: inner \\(test.qc\\), statement [0-9]+: call of a NULL function"));
  EXPECT_THAT(vm_->backtrace(), ::testing::MatchesRegex("     test.qc : inner, statement [0-9]+ \\(CALL0\\)\n"
                                                        "     test.qc : outer, statement [0-9]+ \\(CALL0\\)\n"
                                                        "     test.qc : main, statement [0-9]+ \\(CALL0\\)"));
}

TEST_F(VmTest, GoesOnAfterAnError) {
  ASSERT_TRUE(
      start("float n; void(float x) bad = { local void() f; x = 5; f(); }; void() main = { n = n + 1; put(n);"
            "if (n == 1) bad(1); };"));
  EXPECT_NE(error_of(), "");
  EXPECT_EQ(error_of(), "");
  EXPECT_EQ(output(), "2");
}

TEST_F(VmTest, AnErrorGivesLocalsBack) {
  options_.max_local_words = 500;
  ASSERT_TRUE(
      start("float calls; void(float n) deeper = { local float x; calls = calls + 1; put(x); x = n;"
            "if (n > 0) deeper(n - 1); else { local void() f; f(); } }; void() main = { deeper(20); };"));
  for (int i = 0; i < 100; ++i) {
    ASSERT_THAT(error_of(), HasSubstr("call of a NULL function"));
    ASSERT_TRUE(output().starts_with("0 20 19 ")) << output();  // what x held before, not what the error left in it
  }
}

// What functions of these declarations return, and what the log says of them, at the second call nothing more.
constexpr const char* kUnknown = R"(
float(float x) later = #4000; vector(vector v) far = #999999; string(string s) named_none = #0;
entity() also_later = #4001;
void() two = { put(later(7) + later(8)); };
void() unknowns = {
  two();
  putv(far('1 2 3'));
  puts(named_none("given"));
  pute(also_later());
  put(later(9));
};
)";

TEST_F(VmTest, UnknownBuiltinsReturnNothingAndAreToldOfOnce) {
  ASSERT_TRUE(start(kUnknown));
  set_log_level(LogLevel::kWarning);
  fs::LogLines log;
  EXPECT_EQ(error_of("unknowns"), "");
  EXPECT_EQ(output(), "0 (0 0 0) [] e0 0");
  EXPECT_EQ(error_of("unknowns"), "");
  const std::string rest = " is not known here: calls of it do nothing and return 0";
  EXPECT_THAT(
      log.lines,
      ::testing::ElementsAre(
          ::testing::MatchesRegex("progs.dat: two \\(test.qc\\), statement [0-9]+: builtin #4000 \\(later\\)" + rest),
          ::testing::MatchesRegex("progs.dat: unknowns .*: builtin #999999 \\(far\\)" + rest),
          ::testing::MatchesRegex("progs.dat: unknowns .*: the builtin named_none" + rest),
          ::testing::MatchesRegex("progs.dat: unknowns .*: builtin #4001 \\(also_later\\)" + rest)));
}

TEST_F(VmTest, TheEngineMayCallUnknownBuiltins) {
  ASSERT_TRUE(start(kUnknown));
  set_log_level(LogLevel::kWarning);
  fs::LogLines log;
  vm_->set_parm(0, 7.0f);
  EXPECT_EQ(error_of("later"), "");
  EXPECT_EQ(vm_->returned_float(), 0.0f);
  EXPECT_EQ(error_of("named_none"), "");
  EXPECT_THAT(log.lines, ::testing::ElementsAre(HasSubstr("progs.dat: builtin #4000"), HasSubstr("named_none")));
}

TEST_F(VmTest, TheLogNamesOnlySoManyUnknownBuiltins) {
  std::string declared, called;
  for (int i = 0; i < 100; ++i) {
    declared += fmt::format("void() other{} = #{};\n", i, 2000 + i);
    called += fmt::format("other{}();\n", i);
  }
  ASSERT_TRUE(start(declared + "void() main = {" + called + "put(1);};"));
  set_log_level(LogLevel::kWarning);
  fs::LogLines log;
  EXPECT_EQ(error_of(), "");
  EXPECT_EQ(output(), "1");
  EXPECT_EQ(log.lines.size(), 65u);
  EXPECT_THAT(log.lines.back(), HasSubstr("no more of them are named"));
}

// Made by hand, without the statement that compilers begin with.
TEST(Vm, AFunctionMayBeginAtTheFirstStatement) {
  testing::ProgramBuilder builder(false);
  const auto word = builder.global(5.0f);
  builder.function("strlen", {{Op::kReturn, word}});
  auto program = load_program(builder.build(), "made.dat");
  ASSERT_TRUE(program.ok());
  auto vm = Vm::create(std::make_shared<const Program>(std::move(*program)), standard_builtins({}));
  ASSERT_TRUE(vm.ok());
  EXPECT_TRUE((*vm)->execute((*vm)->program().find_function("strlen")).ok());
  EXPECT_EQ((*vm)->returned_float(), 5.0f);
}

TEST_F(VmTest, BuiltinsWithoutNumberAreFoundByName) {
  ASSERT_TRUE(start("float(string s) strlen = #0; void() main = { put(strlen(\"four\")); };"));
  EXPECT_EQ(error_of(), "");
  EXPECT_EQ(output(), "4");
}

TEST_F(VmTest, ProgramsMayAskWhatTheyCanCall) {
  const std::string before = "void() later = #4000; void() mine = {};";
  EXPECT_EQ(says("put(checkbuiltin(later)); put(checkbuiltin(mine)); put(checkbuiltin(coredump));"
                 "put(builtin_find(\"vlen\")); put(builtin_find(\"argc\")); put(builtin_find(\"none\"));"
                 "tokenize(\"a b c\"); put(argc());",
                 before),
            "0 1 1 12 0 0 3");
}

TEST_F(VmTest, FunctionsThatAreNone) {
  ASSERT_TRUE(start("void() main = {};"));
  EXPECT_EQ(vm_->execute(FunctionId::kNull).error().message,
            "progs.dat: the engine was to call function 0, which is none");
  EXPECT_FALSE(vm_->execute(FunctionId{0xffffffff}).ok());
  EXPECT_TRUE(run().ok());
}

// Lines of the log, warnings and worse.
class Warnings {
 public:
  Warnings() {
    set_log_level(LogLevel::kWarning);
    handle_ = add_log_listener([this](LogLevel, std::string_view line) { lines.emplace_back(line); });
  }
  ~Warnings() {
    remove_log_listener(handle_);
    set_log_level(LogLevel::kError);
  }
  std::vector<std::string> lines;

 private:
  int handle_ = 0;
};

TEST_F(VmTest, WhatIsWrongIsToldOnceForEachStatementAndTheProgramGoesOn) {
  ASSERT_TRUE(
      start(std::string(testing::kBuiltinSource) +
            "float(float a, string b) length = #114; void(entity e) take = #15;"
            "entity nobody; void() main = { local float i;"
            "  for (i = 0; i < 3; i++) put(length(2, \"x\")); put(strlen(\"ab\")); take(nobody); puts(\"end\"); };"));
  vm_->set(vm_->program().global<EdictId>("nobody"), EdictId{0x40000000});
  const Warnings log;
  EXPECT_EQ(error_of(), "");
  EXPECT_EQ(output(), "0 0 0 2 [end]");
  ASSERT_EQ(log.lines.size(), 2u);
  EXPECT_THAT(log.lines[0], ::testing::MatchesRegex("progs.dat: main \\(test.qc\\), statement [0-9]+: parameter 1 of "
                                                    "length is string 1073741824, which there is not: it is taken as "
                                                    "empty"));
  EXPECT_THAT(log.lines[1], HasSubstr("parameter 1 of take is entity 1073741824, of 2: the call does nothing"));
}

TEST_F(VmTest, AProgramThatIsWrongEverywhereIsNotToldOfForEver) {
  std::string calls;
  for (int i = 0; i < 100; ++i) calls += "length(2);";
  ASSERT_TRUE(start("float(float s) length = #114; void() main = {" + calls + "};"));
  const Warnings log;
  EXPECT_EQ(error_of(), "");
  ASSERT_EQ(log.lines.size(), 65u);
  EXPECT_EQ(log.lines.back(), "progs.dat: more is wrong, of which no more is told on this level");
}

// What is skipped within a function that a builtin calls is not the builtin's affair.
TEST_F(VmTest, ASkippedCallEndsNoOther) {
  const std::string before =
      "void(...) callfunction = #605; entity nobody; void(entity e) take = #15; float inner;"
      "void() helper = { take(nobody); inner = 1; };";
  ASSERT_TRUE(start(std::string(testing::kBuiltinSource) + before +
                    "void() main = { callfunction(\"helper\"); put(inner); };"));
  vm_->set(vm_->program().global<EdictId>("nobody"), EdictId{99});
  EXPECT_EQ(error_of(), "");
  EXPECT_EQ(output(), "1");
  EXPECT_FALSE(vm_->failed());
}

TEST_F(VmTest, ABuiltinMayBeCalledByTheEngine) {
  ASSERT_TRUE(start("void(entity e) remove = #15; void(string s) puts_too = #1001; void() main = {};"));
  vm_->set_parm(0, vm_->strings().temporary("direct"));
  EXPECT_EQ(error_of("puts_too"), "");
  EXPECT_EQ(output(), "[direct]");
}

TEST_F(VmTest, TheEngineSetsParametersAndReadsResults) {
  ASSERT_TRUE(
      start("float(float a, vector v, string s, entity e) sum = { puts(s); pute(e); return a + v * v; };"
            "string() name = { return \"named\"; };"));
  vm_->set_parm(0, 1.0f);
  vm_->set_parm(1, vec3(1, 2, 3));
  vm_->set_parm(2, vm_->strings().temporary("text"));
  vm_->set_parm(3, EdictId{1});
  EXPECT_EQ(error_of("sum"), "");
  EXPECT_EQ(output(), "[text] e1");
  EXPECT_EQ(vm_->returned_float(), 15.0f);
  EXPECT_EQ(error_of("name"), "");
  EXPECT_EQ(vm_->returned_string(), "named");
}

// Builtins that call QuakeC again.
class NestedTest : public testing::QcTest {
 protected:
  void add_builtins(BuiltinTable& table) override {
    table.set(2000, "again", [this](Vm& vm) {
      const FunctionId function = vm.parm_function(0);
      statuses_.push_back(vm.execute(function).ok());
      if (go_on_) statuses_.push_back(vm.execute(function).ok());
      parm_count_ = vm.parm_count();
    });
  }
  static constexpr const char* kAgain = "void(void() f) again = #2000;";
  std::vector<bool> statuses_;
  bool go_on_ = false;
  int parm_count_ = -1;
};

TEST_F(NestedTest, QuakeCCallsQuakeCThroughABuiltin) {
  EXPECT_EQ(
      says("local float x; x = 3; again(inner); put(x);", std::string(kAgain) + "void() inner = { puts(\"in\"); };"),
      "[in] 3");
  EXPECT_EQ(parm_count_, 1);  // of its own call, whatever happened in between
}

TEST_F(NestedTest, ErrorsOfTheInnerEndTheOuter) {
  go_on_ = true;
  const std::string said = says(
      "again(inner); puts(\"never\");",
      std::string(kAgain) + "void() inner = { self = spawn(); remove(world); self = edict_num(99); breakpoint(); };");
  EXPECT_THAT(said, HasSubstr("inner (test.qc)"));
  EXPECT_THAT(said, HasSubstr("break statement"));
  EXPECT_EQ(output(), "");
  EXPECT_EQ(statuses_, std::vector<bool>({false, false}));
  EXPECT_THAT(vm_->backtrace(), ::testing::MatchesRegex("     test.qc : inner, statement [0-9]+ \\(CALL0\\)\n"
                                                        "     test.qc : main, statement [0-9]+ \\(CALL1\\)"));
}

TEST_F(NestedTest, NestingHasAnEnd) {
  EXPECT_THAT(says("again(main);", kAgain), HasSubstr("call each other 128 deep"));
}

class TraceTest : public testing::QcTest {};

TEST_F(TraceTest, PrintsStatementsFromTraceonToTraceoff) {
  std::string log;
  set_log_level(LogLevel::kInfo);
  const int listener = add_log_listener([&](LogLevel, std::string_view line) { log.append(line).append("\n"); });
  EXPECT_EQ(says("x = 1; traceon(); x = x + 41; traceoff(); x = x * 2; put(x);", "float x;"), "84");
  remove_log_listener(listener);
  EXPECT_THAT(log, HasSubstr("ADD_F"));
  EXPECT_THAT(log, HasSubstr("(x)"));
  EXPECT_THAT(log, ::testing::Not(HasSubstr("MUL_F")));
}

}  // namespace
}  // namespace fb::progs
