#include "progs/entity_text.h"

#include <gmock/gmock.h>

#include "progs/test_qc.h"
#include "progs/text_tokens.h"

namespace fb::progs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(Tokens, AreQuakes) {
  std::string_view text = "{ \"a b\" c'd //x\n /* y */ :e f:g }";
  std::vector<std::string> words;
  while (const auto token = take_token(text)) words.push_back(token->text);
  EXPECT_THAT(words, ElementsAre("{", "a b", "c", "'", "d", ":", "e", "f:g", "}"));
  text = "\"never closed";
  EXPECT_EQ(take_token(text)->text, "never closed");
  EXPECT_EQ(take_token(text), std::nullopt);
  text = "\"}\"";
  EXPECT_FALSE(take_token(text)->is('}'));
}

TEST(Numbers, AreCs) {
  EXPECT_EQ(parse_float("1.5x"), 1.5f);
  EXPECT_EQ(parse_float("  -2"), -2.0f);
  EXPECT_EQ(parse_float(""), 0.0f);
  EXPECT_EQ(parse_int("99999999999"), INT32_MAX);
  EXPECT_EQ(parse_spaced_vector("1 2 3"), vec3(1, 2, 3));
  EXPECT_EQ(parse_spaced_vector("1  2 3"), vec3(1, 0, 2));
  EXPECT_EQ(parse_spaced_vector("1 2"), vec3(1, 2, 0));
}

class EntityTextTest : public testing::QcTest {
 protected:
  void SetUp() override {
    QcTest::SetUp();
    if (IsSkipped()) return;
    start(R"(
      .float light_lev; .entity friend; .float speed_x; .vector where; .string hint; .void() act; .float score; .string tip;
      .float wheel; void() walk = {}; .float alpha;
      float coins; string motto; entity boss; vector spot; void() plan; nosave float hidden;
      void() main = {};
    )");
    id_ = *vm_->edicts().alloc(0.0);
  }
  EdictText parse(std::string_view text) {
    auto read = parse_edict(*vm_, id_, text);
    EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().message);
    rest_ = text;
    return read.ok() ? *read : EdictText();
  }
  std::string parse_error(std::string_view text) {
    const auto read = parse_edict(*vm_, id_, text);
    return read.ok() ? "" : read.error().message;
  }
  template <typename T>
  T value(std::string_view name) {
    return vm_->edict(id_).get(vm_->program().field<T>(name));
  }
  std::string text(std::string_view name) { return std::string(vm_->text(value<StringId>(name))); }

  EdictId id_{};
  std::string rest_;
};

TEST_F(EntityTextTest, SetsFieldsOfEveryType) {
  const EdictText read = parse(R"("classname" "monster" "health" "80.5" "origin" "1 -2.5 3" "friend" "7" "think" "walk"
                                  "hint" "line\none" } { more)");
  EXPECT_FALSE(read.empty);
  EXPECT_THAT(read.unknown, IsEmpty());
  EXPECT_EQ(rest_, " { more");
  EXPECT_EQ(text("classname"), "monster");
  EXPECT_EQ(value<float>("health"), 80.5f);
  EXPECT_EQ(value<vec3>("origin"), vec3(1, -2.5, 3));
  EXPECT_EQ(vm_->edict(id_).words()[vm_->program().field<EdictId>("friend").offset], 7u);
  EXPECT_EQ(value<FunctionId>("think"), vm_->program().find_function("walk"));
  EXPECT_EQ(text("hint"), "line\none");
}

TEST_F(EntityTextTest, QuakesHabits) {
  const EdictText read =
      parse(R"("angle" "90" "light" "300" "_comment" "x" "health " "5" "sky" "night" "fog" "0.1" "alpha" "0.5" })");
  EXPECT_EQ(value<vec3>("angles"), vec3(0, 90, 0));
  EXPECT_EQ(value<float>("light_lev"), 300.0f);
  EXPECT_EQ(value<float>("health"), 5.0f);
  EXPECT_EQ(value<float>("alpha"), 0.5f);
  EXPECT_THAT(read.unknown, ElementsAre(Pair("sky", "night"), Pair("fog", "0.1")));
}

TEST_F(EntityTextTest, Escapes) {
  parse(R"("hint" "a\nb" "tip" "c:\dir\\end\" })");
  EXPECT_EQ(text("hint"), "a\nb");
  EXPECT_EQ(text("tip"), "c:\\ir\\end\\");  // the letter behind a lone backslash goes with it
}

TEST_F(EntityTextTest, Empty) {
  EXPECT_TRUE(parse("}").empty);
  EXPECT_FALSE(parse("\"_note\" \"x\" }").empty);
}

TEST_F(EntityTextTest, WhatMakesNoSense) {
  EXPECT_EQ(parse_error("\"health\" \"1\""), "text of an entity ends without a closing brace");
  EXPECT_EQ(parse_error("\"health\""), "text of an entity ends behind key \"health\"");
  EXPECT_EQ(parse_error("\"health\" }"), "key \"health\" of an entity has no value");
  EXPECT_EQ(parse_error("\"think\" \"fly\" }"), "progs.dat: think is set to function \"fly\", which there is not");
  EXPECT_EQ(parse_error("\"friend\" \"64\" }"), "progs.dat: friend is set to entity \"64\", which there is not");
  EXPECT_THAT(parse_error("\"friend\" \"-1\" }"), HasSubstr("which there is not"));
}

TEST_F(EntityTextTest, IsWrittenAsQuakeSpasmDoes) {
  Edict edict = vm_->edict(id_);
  edict.set(fields::origin, vec3(1, 0, -2.25f));
  edict.set(fields::classname, vm_->strings().allocate("monster"));
  edict.set(fields::health, 0.1f);
  edict.set(fields::enemy, EdictId{1});
  edict.set(fields::think, vm_->program().find_function("walk"));
  edict.set(vm_->program().field<float>("speed_x"), 5.0f);  // has the name of a component, so it is left out
  EXPECT_EQ(write_edict(*vm_, id_),
            "{\n\"origin\" \"1.000000 0.000000 -2.250000\"\n\"classname\" \"monster\"\n\"think\" \"walk\"\n"
            "\"health\" \"0.100000\"\n\"enemy\" \"1\"\n}\n");
  EXPECT_THAT(write_edict(*vm_, id_, "\"alpha\" \"0.500000\"\n"),
              ::testing::EndsWith("\"1\"\n\"alpha\" \"0.500000\"\n}\n"));
  vm_->edicts().free(id_, 0);
  EXPECT_EQ(write_edict(*vm_, id_), "{\n}\n");
}

TEST_F(EntityTextTest, ComesBackAsItWas) {
  Edict edict = vm_->edict(id_);
  edict.set(vm_->program().field<StringId>("hint"), vm_->strings().allocate("two\nlines, \\n and a \\ at the end\\"));
  edict.set(vm_->program().field<vec3>("where"), vec3(0, 0, 4096.5f));
  edict.set(vm_->program().field<FunctionId>("act"), vm_->program().find_function("main"));
  edict.set(fields::flags, -0.0f);
  const std::string written = write_edict(*vm_, id_);
  ASSERT_TRUE(vm_->edicts().revive(id_).ok());
  std::string_view text = std::string_view(written).substr(2);
  ASSERT_TRUE(parse_edict(*vm_, id_, text).ok());
  EXPECT_EQ(this->text("hint"), "two\nlines, \\n and a \\ at the end\\");
  EXPECT_EQ(write_edict(*vm_, id_), written);
}

TEST_F(EntityTextTest, Globals) {
  const Program& program = vm_->program();
  vm_->set(program.global<float>("coins"), 12.0f);
  vm_->set(program.global<StringId>("motto"), vm_->strings().allocate("go"));
  vm_->set(program.global<EdictId>("boss"), EdictId{1});
  const std::string written = write_globals(*vm_);
  EXPECT_THAT(written, HasSubstr("\"coins\" \"12.000000\"\n\"motto\" \"go\"\n\"boss\" \"1\"\n"));
  EXPECT_THAT(written, ::testing::Not(HasSubstr("\"plan\"")));
  EXPECT_THAT(written, ::testing::Not(HasSubstr("\"spot\" ")));

  vm_->set(program.global<float>("coins"), 0.0f);
  std::string_view text = std::string_view(written).substr(2);
  EXPECT_TRUE(parse_globals(*vm_, text).ok());
  EXPECT_EQ(vm_->get(program.global<float>("coins")), 12.0f);
  EXPECT_EQ(vm_->text(vm_->get(program.global<StringId>("motto"))), "go");
  text = "\"no_such_global\" \"1\" }";
  EXPECT_TRUE(parse_globals(*vm_, text).ok());
  text = "\"coins\" \"1\"";
  EXPECT_FALSE(parse_globals(*vm_, text).ok());
}

}  // namespace
}  // namespace fb::progs
