#include "progs/program.h"

#include <gmock/gmock.h>

#include "base/log.h"
#include "formats/test_corruption.h"
#include "progs/test_program.h"
#include "progs/test_soundness.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ProgramBuilder;

constexpr const char* kName = "made.dat";

// A bit of everything: functions that call, loops, entities, strings, builtins.
ProgramBuilder sample() {
  ProgramBuilder builder;
  const auto one = builder.global(1.0f), sum = builder.global(0.0f), text = builder.word(builder.string("text"));
  const auto entity = builder.word(1), field = builder.word(fields::origin.offset), pointer = builder.word(0);
  const auto vector = builder.vector(1, 2, 3), local = builder.vector(0, 0, 0), callee = builder.word(1);
  const auto note = builder.word(2);
  builder.define_global("sum", Type::kFloat, sum, true);
  builder.field("alpha", Type::kFloat);
  builder.function("turn", {{Op::kMulVF, local, one, local}, {Op::kReturn, local}}, local, 3, {3});
  builder.builtin("note", 1);
  builder.function("main", {{Op::kAddF, sum, one, sum},
                            {Op::kAddress, entity, field, pointer},
                            {Op::kStorepV, vector, pointer},
                            {Op::kStoreV, vector, kOfsParm0},
                            {Op::kCall1, callee},
                            {Op::kEqS, text, text, sum},
                            {Op::kNotS, text, 0, sum},
                            {Op::kCall0, note},
                            {Op::kIfNot, sum, 2},
                            {Op::kGoto, 0xfffe},
                            {Op::kDone}});
  return builder;
}

Result<Program> load(const ProgramBuilder& builder) { return load_program(builder.build(), kName); }
std::string error_of(const ProgramBuilder& builder) {
  const auto program = load(builder);
  return program.ok() ? "" : program.error().message;
}

TEST(Program, HoldsWhatTheFileSays) {
  const auto program = load(sample());
  ASSERT_TRUE(program.ok()) << program.error().message;
  EXPECT_EQ(program->crc, 5927);
  EXPECT_THAT(program->warnings, IsEmpty());
  EXPECT_EQ(program->field_words, kSystemFields + 1);
  EXPECT_EQ(program->field<float>("alpha").offset, kSystemFields);
  EXPECT_FALSE(program->field<vec3>("alpha"));  // of another type
  EXPECT_FALSE(program->field<float>("scale"));
  EXPECT_EQ(program->field<vec3>("origin").offset, fields::origin.offset);
  EXPECT_EQ(program->global<EdictId>("self").offset, globals::self.offset);
  ASSERT_NE(program->find_global("sum"), nullptr);
  EXPECT_TRUE(program->find_global("sum")->saved);
  EXPECT_FALSE(program->find_global("self")->saved);
  EXPECT_EQ(program->find_function("main"), FunctionId{3});
  EXPECT_EQ(program->find_function("nothing"), FunctionId::kNull);
  EXPECT_EQ(program->functions[1].parm_count, 1u);
  EXPECT_TRUE(program->functions[2].is_builtin());
  EXPECT_EQ(program->field_at(fields::health.offset)->name, "health");
}

TEST(Program, TheFirstOfEqualNamesCounts) {
  ProgramBuilder builder;
  builder.field("twice", Type::kFloat);
  builder.field("twice", Type::kVector);
  const auto program = load(builder);
  ASSERT_TRUE(program.ok());
  EXPECT_TRUE(program->field<float>("twice"));
}

TEST(Program, CutShort) {
  const auto attempt = formats::testing::attempt([](const Bytes& bytes) { return load_program(bytes, kName); },
                                                 [](const Program&) { return std::string(); });
  formats::testing::expect_refused_when_cut(attempt, sample().build(), kName);
}

TEST(Program, DamagedAnywhereItIsRefusedOrRunsInItsMemory) {
  set_log_level(LogLevel::kError);
  const auto attempt = formats::testing::attempt([](const Bytes& bytes) { return load_program(bytes, kName); },
                                                 [](const Program& program) { return testing::broken(program); });
  formats::testing::expect_sound_when_damaged(attempt, sample().build(), kName);
  set_log_level(LogLevel::kInfo);
}

TEST(Program, TooLarge) {
  Bytes bytes = sample().build();
  ASSERT_TRUE(load_program(bytes, kName).ok());
  bytes.resize(kMostProgramBytes + 1);
  const auto program = load_program(bytes, kName);
  ASSERT_FALSE(program.ok());
  EXPECT_THAT(program.error().message, HasSubstr("made.dat: offset 0: progs of 67108865 bytes; at most 67108864"));
}

TEST(Program, OtherVersions) {
  Bytes bytes = sample().build();
  bytes[0] = 7;
  const auto program = load_program(bytes, kName);
  ASSERT_FALSE(program.ok());
  EXPECT_EQ(program.error().message, "made.dat: offset 0: progs of version 7; only version 6 is Quake's");
}

TEST(Program, AnotherCrcIsTakenWhereEverythingIsInItsPlace) {
  ProgramBuilder builder = sample();
  builder.crc = 1234;
  const auto program = load(builder);
  ASSERT_TRUE(program.ok()) << program.error().message;
  ASSERT_EQ(program->warnings.size(), 1u);
  EXPECT_THAT(program->warnings[0], HasSubstr("CRC 1234 instead of Quake's 5927; taken"));
}

TEST(Program, AnotherCrcIsRefusedWhereSomethingIsElsewhere) {
  // QuakeWorld's globals lack some of Quake's. The builder's definitions stand behind the header and the statements.
  Bytes bytes = sample().build();
  const auto word_at = [&](std::size_t at) {
    return bytes[at] | std::size_t{bytes[at + 1]} << 8u | std::size_t{bytes[at + 2]} << 16u;
  };
  bytes[4] = 54730 & 255;
  bytes[5] = 54730 >> 8;
  const std::size_t self = word_at(16) + 8;
  bytes[self + 2] = 30;
  auto program = load_program(bytes, kName);
  ASSERT_FALSE(program.ok());
  EXPECT_EQ(
      program.error().message,
      "made.dat: offset 4: progs for another engine: CRC 54730 (QuakeWorld's) instead of Quake's 5927, and self is "
      "a entity at 30, where Quake has a entity at 28");
  bytes[self + 2] = 28;
  bytes[self + 4] = 0;  // its name
  bytes[self + 5] = 0;
  program = load_program(bytes, kName);
  ASSERT_FALSE(program.ok());
  EXPECT_THAT(program.error().message, HasSubstr("self is missing"));
}

TEST(Program, UnusedOperandsMayBeAnything) {
  ProgramBuilder builder;
  const auto x = builder.global(1.0f);
  builder.function("main", {{Op::kStoreF, x, x, 0xffff}, {Op::kReturn, x, 0xffff, 0xffff}, {Op::kDone, x, 0xffff}});
  EXPECT_EQ(error_of(builder), "");
}

TEST(Program, OperandsAndJumpsThatLeadOutside) {
  const auto of = [](const Statement& statement) {
    ProgramBuilder builder;
    builder.function("main", {statement, {Op::kDone}});
    return error_of(builder);
  };
  EXPECT_THAT(of({Op::kAddF, 0, 0, kSystemGlobals}),
              HasSubstr("statement 1 (ADD_F): operand 92 is none of 92 globals"));
  EXPECT_THAT(of({Op::kStoreF, 0xffff, 0, 0}), HasSubstr("operand 65535"));
  EXPECT_THAT(of({Op::kGoto, 3}), HasSubstr("statement 1 (GOTO): jump to statement 4, of 3"));
  EXPECT_THAT(of({Op::kIf, 0, 0xfffe}), HasSubstr("jump to statement -1"));
  EXPECT_EQ(of({Op::kIfNot, 0, 0xffff}), "");
  EXPECT_THAT(of({static_cast<Op>(66)}), HasSubstr("opcode 66, which version 6 does not have"));
}

TEST(Program, VectorsAtTheEndOfTheGlobalsStayInside) {
  ProgramBuilder builder;
  const auto last = builder.global(5.0f);
  builder.function("main", {{Op::kStoreV, last, last}, {Op::kAddV, last, last, last}, {Op::kReturn, last}});
  const auto program = load(builder);
  ASSERT_TRUE(program.ok());
  EXPECT_EQ(testing::broken(*program), "");
}

TEST(Program, FunctionsThatMakeNoSense) {
  ProgramBuilder builder;
  builder.function("main", {{Op::kDone}}, 90, 3);
  EXPECT_THAT(error_of(builder), HasSubstr("function 1 (main) has 3 local words at 90, of 92 globals"));
  builder = {};
  builder.function("main", {{Op::kDone}}, 91, 0, {1, 1});
  EXPECT_THAT(error_of(builder), HasSubstr("has 2 words of parameters at 91"));
  builder = {};
  builder.function("main", {{Op::kDone}}, 40, 4, {4});
  EXPECT_THAT(error_of(builder), HasSubstr("has a parameter of 4 words"));
  builder = {};
  builder.function("main", {{Op::kDone}}, 0xffffffffu, 1);
  EXPECT_THAT(error_of(builder), HasSubstr("local words at 4294967295"));
}

TEST(Program, DefinitionsOutsideAreLeftOut) {
  ProgramBuilder builder;
  builder.define_field("late", Type::kVector, kSystemFields - 2);
  builder.define_global("far", Type::kFloat, 5000);
  const auto program = load(builder);
  ASSERT_TRUE(program.ok()) << program.error().message;
  EXPECT_EQ(program->find_field("late"), nullptr);
  EXPECT_EQ(program->find_global("far"), nullptr);
  EXPECT_EQ(program->warnings.size(), 2u);
}

}  // namespace
}  // namespace fb::progs
