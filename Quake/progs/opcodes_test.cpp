// Every opcode, one statement at a time, at its ordinary and at its hard values.
#include "progs/opcodes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "progs/test_program.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class OpcodeTest : public ::testing::Test {
 protected:
  void SetUp() override { set_log_level(LogLevel::kError); }
  void TearDown() override { set_log_level(LogLevel::kInfo); }

  void start() {
    auto program = load_program(builder_.build(), "made.dat");
    ASSERT_TRUE(program.ok()) << program.error().message;
    auto vm = Vm::create(std::make_shared<Program>(std::move(program).value()), BuiltinTable(), options_);
    ASSERT_TRUE(vm.ok()) << vm.error().message;
    vm_ = std::move(vm).value();
    vm_->edicts().start_level(3);
  }
  std::string run() {
    const Status status = vm_->execute(vm_->program().find_function("main"));
    return status.ok() ? "" : status.error().message;
  }
  Word word(std::uint32_t at) const { return vm_->globals_data()[at]; }
  float number(std::uint32_t at) const { return as_float(word(at)); }
  vec3 vec(std::uint32_t at) const { return {number(at), number(at + 1), number(at + 2)}; }

  // The word that an operation on two words gives.
  Word result(Op op, Word a, Word b) {
    builder_ = {};
    const auto at_a = builder_.word(a), at_b = builder_.word(b), at_c = builder_.word(0xdeadbeef);
    builder_.function("main", {{op, at_a, at_b, at_c}, {Op::kDone}});
    start();
    error_ = run();
    return word(at_c);
  }
  float of(Op op, float a, float b = 0.0f) { return as_float(result(op, as_word(a), as_word(b))); }
  float of_vectors(Op op, const vec3& a, const vec3& b) {
    builder_ = {};
    const auto at_a = builder_.vector(a.x, a.y, a.z), at_b = builder_.vector(b.x, b.y, b.z);
    const auto at_c = builder_.global(-1.0f);
    builder_.function("main", {{op, at_a, at_b, at_c}, {Op::kDone}});
    start();
    EXPECT_EQ(run(), "");
    return number(at_c);
  }
  // Leaves statement 1 (a condition on `condition`) by a jump to where 1 is stored, or goes on to where 2 is.
  float branch(Op op, Word condition) {
    builder_ = {};
    const auto at = builder_.word(condition), one = builder_.global(1.0f), two = builder_.global(2.0f);
    const auto to = builder_.global(0.0f);
    builder_.function("main",
                      {{op, at, 3, 0}, {Op::kStoreF, two, to}, {Op::kDone}, {Op::kStoreF, one, to}, {Op::kDone}});
    start();
    EXPECT_EQ(run(), "");
    return number(to);
  }

  testing::ProgramBuilder builder_;
  VmOptions options_{.max_edicts = 16, .max_statements = 1000};
  std::unique_ptr<Vm> vm_;
  std::string error_;
};

TEST_F(OpcodeTest, Arithmetic) {
  EXPECT_EQ(of(Op::kAddF, 1.5f, 2.25f), 3.75f);
  EXPECT_EQ(of(Op::kSubF, 1.5f, 2.25f), -0.75f);
  EXPECT_EQ(of(Op::kMulF, 3.0f, 0.1f), 3.0f * 0.1f);
  EXPECT_EQ(of(Op::kDivF, 1.0f, 3.0f), 1.0f / 3.0f);
  EXPECT_EQ(of(Op::kDivF, 1.0f, 0.0f), kInfinity);
  EXPECT_TRUE(std::isnan(of(Op::kDivF, 0.0f, 0.0f)));
  EXPECT_EQ(of(Op::kAddF, 16777216.0f, 1.0f), 16777216.0f);  // single precision throughout
}

TEST_F(OpcodeTest, BitsAreThoseOfInts) {
  EXPECT_EQ(of(Op::kBitAnd, 13.9f, 6.0f), 4.0f);
  EXPECT_EQ(of(Op::kBitOr, 8.0f, 3.0f), 11.0f);
  EXPECT_EQ(of(Op::kBitAnd, -1.0f, 255.0f), 255.0f);
  EXPECT_EQ(of(Op::kBitOr, 1e20f, 0.0f), -2147483648.0f);
  EXPECT_EQ(of(Op::kBitOr, kNan, 0.0f), -2147483648.0f);
  EXPECT_EQ(of(Op::kBitOr, 16777216.0f, 1.0f), 16777216.0f);
}

TEST_F(OpcodeTest, Comparisons) {
  struct Row {
    Op op;
    float less, equal, greater, with_nan;
  };
  for (const Row& row : {Row{Op::kLe, 1, 1, 0, 0}, Row{Op::kGe, 0, 1, 1, 0}, Row{Op::kLt, 1, 0, 0, 0},
                         Row{Op::kGt, 0, 0, 1, 0}, Row{Op::kEqF, 0, 1, 0, 0}, Row{Op::kNeF, 1, 0, 1, 1}}) {
    const char* name = op_info(row.op).name;
    EXPECT_EQ(of(row.op, 1, 2), row.less) << name;
    EXPECT_EQ(of(row.op, 2, 2), row.equal) << name;
    EXPECT_EQ(of(row.op, 3, 2), row.greater) << name;
    EXPECT_EQ(of(row.op, kNan, kNan), row.with_nan) << name;
    EXPECT_EQ(of(row.op, 0.0f, -0.0f), row.equal) << name;
  }
}

TEST_F(OpcodeTest, LogicAsksFloats) {
  for (const float a : {0.0f, -0.0f, 1.0f, 0.5f, kNan}) {
    for (const float b : {0.0f, -0.0f, 2.0f, kNan}) {
      const bool true_a = a != 0.0f, true_b = b != 0.0f;
      EXPECT_EQ(of(Op::kAnd, a, b), true_a && true_b ? 1.0f : 0.0f);
      EXPECT_EQ(of(Op::kOr, a, b), true_a || true_b ? 1.0f : 0.0f);
    }
  }
  // Entities and strings go through the same operation: small integers are tiny floats, and not zero.
  EXPECT_EQ(as_float(result(Op::kAnd, 1, 1)), 1.0f);
}

TEST_F(OpcodeTest, Not) {
  EXPECT_EQ(of(Op::kNotF, 0.0f), 1.0f);
  EXPECT_EQ(of(Op::kNotF, -0.0f), 1.0f);
  EXPECT_EQ(of(Op::kNotF, 0.25f), 0.0f);
  EXPECT_EQ(of(Op::kNotF, kNan), 0.0f);
  EXPECT_EQ(of_vectors(Op::kNotV, {0, -0.0f, 0}, {}), 1.0f);
  EXPECT_EQ(of_vectors(Op::kNotV, {0, 0, 1}, {}), 0.0f);
  EXPECT_EQ(as_float(result(Op::kNotEnt, 0, 0)), 1.0f);
  EXPECT_EQ(as_float(result(Op::kNotEnt, 2, 0)), 0.0f);
  EXPECT_EQ(as_float(result(Op::kNotFnc, 0, 0)), 1.0f);
  EXPECT_EQ(as_float(result(Op::kNotFnc, 1, 0)), 0.0f);
}

TEST_F(OpcodeTest, Vectors) {
  EXPECT_EQ(of_vectors(Op::kMulV, {1, 2, 3}, {4, 5, 6}), 32.0f);
  EXPECT_EQ(of_vectors(Op::kEqV, {1, 2, 3}, {1, 2, 3}), 1.0f);
  EXPECT_EQ(of_vectors(Op::kEqV, {1, 2, 3}, {1, 2, 4}), 0.0f);
  EXPECT_EQ(of_vectors(Op::kNeV, {1, 2, 3}, {1, 2, 3}), 0.0f);
  EXPECT_EQ(of_vectors(Op::kNeV, {1, 2, 3}, {0, 2, 3}), 1.0f);
  builder_ = {};
  const auto a = builder_.vector(1, 2, 3), b = builder_.vector(10, 20, 30), half = builder_.global(0.5f);
  const auto sum = builder_.vector(0, 0, 0), difference = builder_.vector(0, 0, 0), scaled = builder_.vector(0, 0, 0);
  const auto scaled_too = builder_.vector(0, 0, 0), copy = builder_.vector(0, 0, 0);
  builder_.function("main", {{Op::kAddV, a, b, sum},
                             {Op::kSubV, a, b, difference},
                             {Op::kMulFV, half, b, scaled},
                             {Op::kMulVF, b, half, scaled_too},
                             {Op::kStoreV, b, copy},
                             {Op::kDone}});
  start();
  EXPECT_EQ(run(), "");
  EXPECT_EQ(vec(sum), vec3(11, 22, 33));
  EXPECT_EQ(vec(difference), vec3(-9, -18, -27));
  EXPECT_EQ(vec(scaled), vec3(5, 10, 15));
  EXPECT_EQ(vec(scaled_too), vec3(5, 10, 15));
  EXPECT_EQ(vec(copy), vec3(10, 20, 30));
}

TEST_F(OpcodeTest, Strings) {
  const Word a = builder_.string("same"), b = builder_.string("same"), c = builder_.string("Same");
  const auto equal = [&](Op op, Word x, Word y) {
    testing::ProgramBuilder kept = builder_;
    const auto at_a = builder_.word(x), at_b = builder_.word(y), at_c = builder_.word(0);
    builder_.function("main", {{op, at_a, at_b, at_c}, {Op::kDone}});
    start();
    error_ = run();
    builder_ = kept;
    return number(at_c);
  };
  EXPECT_EQ(equal(Op::kEqS, a, b), 1.0f);
  EXPECT_EQ(equal(Op::kEqS, a, c), 0.0f);
  EXPECT_EQ(equal(Op::kEqS, a + 1, c + 1), 1.0f);  // the ends of strings are strings
  EXPECT_EQ(equal(Op::kNeS, a, b), 0.0f);
  EXPECT_EQ(equal(Op::kNeS, a, c), 1.0f);
  EXPECT_EQ(equal(Op::kNotS, a, 0), 0.0f);
  EXPECT_EQ(equal(Op::kNotS, a + 4, 0), 1.0f);
  EXPECT_EQ(equal(Op::kNotS, 0, 0), 1.0f);
  EXPECT_EQ(error_, "");
  // What is no string is taken as an empty one.
  for (const Word bad : {1000000u, 0x7fffffffu, 0x80000000u, 0xffff0000u}) {
    const auto warned = [&](Op op, Word x, Word y) {
      const float result = equal(op, x, y);
      EXPECT_EQ(error_, "");
      EXPECT_THAT(vm_->warning(), HasSubstr("is none: it is taken as empty")) << op_info(op).name << bad;
      return result;
    };
    EXPECT_EQ(warned(Op::kEqS, bad, a), 0.0f);
    EXPECT_EQ(warned(Op::kEqS, 0, bad), 1.0f);
    EXPECT_EQ(warned(Op::kNeS, a, bad), 1.0f);
    EXPECT_EQ(warned(Op::kNotS, bad, 0), 1.0f);
  }
}

TEST_F(OpcodeTest, EntitiesAndFunctionsAreComparedAsWords) {
  for (const Op op : {Op::kEqE, Op::kEqFnc}) {
    EXPECT_EQ(as_float(result(op, 7, 7)), 1.0f);
    EXPECT_EQ(as_float(result(op, 0x80000000u, 0)), 0.0f);  // unlike floats
  }
  for (const Op op : {Op::kNeE, Op::kNeFnc}) {
    EXPECT_EQ(as_float(result(op, 7, 7)), 0.0f);
    EXPECT_EQ(as_float(result(op, 0x80000000u, 0)), 1.0f);
  }
}

TEST_F(OpcodeTest, Stores) {
  for (const Op op : {Op::kStoreF, Op::kStoreS, Op::kStoreEnt, Op::kStoreFld, Op::kStoreFnc}) {
    builder_ = {};
    const auto from = builder_.word(0x7fa00001), to = builder_.word(0);  // a signalling NaN keeps its bits
    builder_.function("main", {{op, from, to}, {Op::kDone}});
    start();
    EXPECT_EQ(run(), "");
    EXPECT_EQ(word(to), 0x7fa00001u);
  }
}

TEST_F(OpcodeTest, LoadsAndStoresThroughEntities) {
  const Op loads[] = {Op::kLoadF, Op::kLoadS, Op::kLoadEnt, Op::kLoadFld, Op::kLoadFnc};
  const Op stores[] = {Op::kStorepF, Op::kStorepS, Op::kStorepEnt, Op::kStorepFld, Op::kStorepFnc};
  for (int i = 0; i < 5; ++i) {
    builder_ = {};
    const auto entity = builder_.word(2), field = builder_.word(fields::health.offset);
    const auto value = builder_.word(0x7fa00001), pointer = builder_.word(0), read = builder_.word(0);
    builder_.function("main", {{Op::kAddress, entity, field, pointer},
                               {stores[i], value, pointer},
                               {loads[i], entity, field, read},
                               {Op::kDone}});
    start();
    EXPECT_EQ(run(), "");
    EXPECT_EQ(word(read), 0x7fa00001u);
    EXPECT_EQ(vm_->edict(EdictId{2}).words()[fields::health.offset], 0x7fa00001u);
  }
  builder_ = {};
  const auto entity = builder_.word(1), field = builder_.word(fields::origin.offset);
  const auto value = builder_.vector(1, 2, 3), pointer = builder_.word(0), read = builder_.vector(0, 0, 0);
  builder_.function("main", {{Op::kAddress, entity, field, pointer},
                             {Op::kStorepV, value, pointer},
                             {Op::kLoadV, entity, field, read},
                             {Op::kDone}});
  start();
  EXPECT_EQ(run(), "");
  EXPECT_EQ(vec(read), vec3(1, 2, 3));
  EXPECT_EQ(vm_->edict(EdictId{1}).get(fields::origin), vec3(1, 2, 3));
}

TEST_F(OpcodeTest, NothingLeadsOutOfTheEntities) {
  const Word last = kSystemFields - 1;
  const auto warning_of = [&](Op op, Word a, Word b) {
    const Word value = result(op, a, b);
    EXPECT_EQ(error_, "");
    const bool loads = op == Op::kLoadF || op == Op::kLoadV;
    EXPECT_TRUE(!loads || vm_->warning().empty() || value == 0u) << "nothing is read";
    return vm_->warning();
  };
  for (const Op op : {Op::kLoadF, Op::kLoadV, Op::kAddress}) {
    for (const Word entity : {4u, 16u, 0xffffffffu, 0x80000000u})
      EXPECT_THAT(warning_of(op, entity, 0), HasSubstr("is no entity: there are 4"));
    for (const Word field : {kSystemFields, 0x7fffffffu, 0xffffffffu})
      EXPECT_THAT(warning_of(op, 3, field), HasSubstr(fmt::format("field {}, of {} words", field, kSystemFields)));
  }
  EXPECT_EQ(warning_of(Op::kLoadF, 3, last), "");
  EXPECT_THAT(warning_of(Op::kLoadV, 3, last - 1), HasSubstr("field"));
  EXPECT_EQ(warning_of(Op::kLoadV, 3, last - 2), "");
  const Word end = 4 * kSystemFields;
  for (const Word pointer : {end, 0x80000000u})
    EXPECT_THAT(warning_of(Op::kStorepF, 1, pointer), HasSubstr("leads outside of the entities"));
  for (const Word pointer : {end - 2, end - 1, end})
    EXPECT_THAT(warning_of(Op::kStorepV, 1, pointer), HasSubstr("leads outside of the entities"));
  EXPECT_EQ(warning_of(Op::kStorepF, 1, end - 1), "");
  EXPECT_EQ(warning_of(Op::kStorepV, 1, end - 3), "");
}

TEST_F(OpcodeTest, WhatIsWrittenToNoEntityIsLost) {
  const auto entity = builder_.word(99), field = builder_.word(fields::health.offset);
  const auto value = builder_.vector(1, 2, 3), pointer = builder_.word(0);
  builder_.function("main", {{Op::kAddress, entity, field, pointer},
                             {Op::kStorepF, value, pointer},
                             {Op::kStorepV, value, pointer},
                             {Op::kDone}});
  start();
  EXPECT_EQ(run(), "");
  EXPECT_THAT(vm_->warning(), HasSubstr("statement 1: 99 is no entity")) << "the address is told of, not what follows";
  const Word* const words = vm_->edicts().words();
  EXPECT_TRUE(std::all_of(words, words + 4 * kSystemFields, [](Word word) { return word == 0; }));
}

TEST_F(OpcodeTest, TheWorldIsWrittenOnlyWhileItSpawns) {
  result(Op::kAddress, 0, 5);
  EXPECT_EQ(error_, "");
  vm_->protect_world = true;
  EXPECT_THAT(run(), HasSubstr("assignment to a field of the world"));
}

TEST_F(OpcodeTest, ConditionsAskWords) {
  EXPECT_EQ(branch(Op::kIf, 1), 1.0f);
  EXPECT_EQ(branch(Op::kIf, 0), 2.0f);
  EXPECT_EQ(branch(Op::kIf, as_word(-0.0f)), 1.0f);
  EXPECT_EQ(branch(Op::kIfNot, 1), 2.0f);
  EXPECT_EQ(branch(Op::kIfNot, 0), 1.0f);
  EXPECT_EQ(branch(Op::kIfNot, as_word(-0.0f)), 2.0f);
}

TEST_F(OpcodeTest, Goto) {
  const auto one = builder_.global(1.0f), to = builder_.global(0.0f);
  builder_.function("main", {{Op::kGoto, 3}, {Op::kStoreF, one, to}, {Op::kDone}, {Op::kGoto, 0xfffe}});
  start();
  EXPECT_EQ(run(), "");
  EXPECT_EQ(number(to), 1.0f);
}

TEST_F(OpcodeTest, StateIsAFrameAndAThinkATenthLater) {
  const auto frame = builder_.global(7.0f), think = builder_.word(1);
  builder_.function("main", {{Op::kState, frame, think}, {Op::kDone}});
  start();
  vm_->set(globals::self, EdictId{3});
  vm_->set(globals::time, 10.3f);
  EXPECT_EQ(run(), "");
  Edict edict = vm_->edict(EdictId{3});
  EXPECT_EQ(edict.get(fields::frame), 7.0f);
  EXPECT_EQ(edict.get(fields::think), FunctionId{1});
  EXPECT_EQ(edict.get(fields::nextthink), static_cast<float>(10.3f + 0.1));
  vm_->set(globals::self, EdictId{99});
  EXPECT_EQ(run(), "");
  EXPECT_THAT(vm_->warning(), HasSubstr("99 is no entity"));
}

TEST_F(OpcodeTest, CallsPassParametersAndReturnThreeWords) {
  const auto a = builder_.global(3.0f), v = builder_.vector(4, 5, 6), callee = builder_.word(1);
  const auto local = builder_.global(-1.0f), local_v = builder_.vector(-1, -1, -1), sum = builder_.vector(0, 0, 0);
  builder_.function("add", {{Op::kMulFV, local, local_v, sum}, {Op::kReturn, sum}}, local, 4, {1, 3});
  const auto to = builder_.vector(0, 0, 0);
  builder_.function("main", {{Op::kStoreF, a, kOfsParm0},
                             {Op::kStoreV, v, kOfsParm0 + 3},
                             {Op::kCall2, callee},
                             {Op::kStoreV, kOfsReturn, to},
                             {Op::kDone}});
  start();
  EXPECT_EQ(run(), "");
  EXPECT_EQ(vec(to), vec3(12, 15, 18));
  EXPECT_EQ(vec(local_v), vec3(-1));  // locals come back
}

TEST_F(OpcodeTest, CallsOfWhatIsNoFunction) {
  result(Op::kCall0, 0, 0);
  EXPECT_THAT(error_, HasSubstr("call of a NULL function"));
  for (const Word bad : {2u, 0xffffffffu, 0x80000001u}) {
    result(Op::kCall3, bad, 0);
    EXPECT_THAT(error_, HasSubstr(fmt::format("call of function {}, which is none", bad)));
  }
}

TEST_F(OpcodeTest, EveryCallCountsItsParameters) {
  for (int i = 0; i <= 8; ++i) {
    builder_ = {};
    const auto callee = builder_.word(1);
    builder_.builtin("count", 9);
    builder_.function("main", {{static_cast<Op>(static_cast<int>(Op::kCall0) + i), callee}, {Op::kDone}});
    auto program = load_program(builder_.build(), "made.dat");
    ASSERT_TRUE(program.ok());
    int counted = -1;
    BuiltinTable table;
    table.set(9, "count", [&](Vm& vm) { counted = vm.parm_count(); });
    auto vm = Vm::create(std::make_shared<Program>(std::move(program).value()), std::move(table), options_);
    ASSERT_TRUE(vm.ok());
    vm_ = std::move(vm).value();
    EXPECT_EQ(run(), "");
    EXPECT_EQ(counted, i);
  }
}

TEST_F(OpcodeTest, RunningOutOfTheStatements) {
  const auto one = builder_.global(1.0f);
  builder_.function("main", {{Op::kStoreF, one, one}});
  start();
  EXPECT_THAT(run(), HasSubstr("statements end without a return"));
}

TEST_F(OpcodeTest, EndlessLoopsOfEveryKindEnd) {
  const auto one = builder_.word(1), zero = builder_.word(0), self = builder_.word(1);
  const Statement loops[] = {{Op::kGoto, 0}, {Op::kIf, one, 0}, {Op::kIfNot, zero, 0}};
  for (const Statement& loop : loops) {
    testing::ProgramBuilder kept = builder_;
    builder_.function("main", {loop, {Op::kDone}});
    start();
    builder_ = kept;
    EXPECT_THAT(run(), HasSubstr("more than 1000 statements: a loop without end"));
  }
  builder_.function("main", {{Op::kCall0, self}, {Op::kDone}});
  options_.max_statements = 1 << 20;
  start();
  EXPECT_THAT(run(), HasSubstr("1024 deep: stack overflow"));
}

TEST_F(OpcodeTest, StatementsAreCounted) {
  const auto x = builder_.global(10.0f), one = builder_.global(1.0f);
  builder_.function("main", {{Op::kSubF, x, one, x}, {Op::kIf, x, 0xffff}, {Op::kDone}});
  start();
  EXPECT_EQ(run(), "");
  EXPECT_EQ(vm_->statements_executed(), 21);
  const auto rows = vm_->take_profile(10);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].statements, 21);
  EXPECT_EQ(vm_->function_name(rows[0].function), "main");
  EXPECT_TRUE(vm_->take_profile(10).empty());
}

}  // namespace
}  // namespace fb::progs
