#include "console/quakespasm_cvars.h"

#include <gmock/gmock.h>

namespace fb::con {
namespace {

using testing::HasSubstr;

class QuakeSpasmCvarsTest : public testing::Test {
 protected:
  QuakeSpasmCvarsTest() { add_quakespasm_cvars(console); }
  Console console;
};

TEST_F(QuakeSpasmCvarsTest, EachSaysThatItHasNoEffect) {
  ASSERT_GT(console.cvars().size(), 100u);
  for (const Cvar* cvar : console.cvars()) {
    EXPECT_FALSE(cvar->has_effect()) << cvar->name();
    EXPECT_THAT(cvar->spec().help, HasSubstr("; no effect here: ")) << cvar->name();
  }
  EXPECT_EQ(console.cvar("volume").string(), "0.7");
}

TEST_F(QuakeSpasmCvarsTest, ConfigHoldsThoseThatSomebodyChanged) {
  EXPECT_EQ(console.config_text(), "");
  console.execute("volume 0.3; gamma 1; r_speeds 1; joy_enable 0");
  EXPECT_EQ(console.config_text(), "joy_enable \"0\"\nvolume \"0.3\"\n") << "r_speeds is in nobody's configuration";
  console.execute("reset volume");
  EXPECT_EQ(console.config_text(), "joy_enable \"0\"\n");
  console.execute("seta crosshair 1");
  EXPECT_THAT(console.config_text(), HasSubstr("crosshair \"1\"\n"));
}

TEST_F(QuakeSpasmCvarsTest, WhoeverAddsOneTakesItsPlace) {
  console.execute("volume 5; gamma 2");
  const Cvar& before = console.cvar("volume");
  const Cvar& volume = console.add_cvar({"volume", "1", "how loud it is", kCvarArchive, 0.0f, 1.0f});
  EXPECT_EQ(&volume, &before) << "whoever holds it still does";
  EXPECT_TRUE(volume.has_effect());
  EXPECT_EQ(volume.string(), "1") << "what was set is taken by the new one's rules";
  EXPECT_EQ(console.add_cvar("gamma", "1", "").string(), "2");
  EXPECT_EQ(console.add_cvar("contrast", "1.2", "").string(), "1.2") << "nobody had set it: the new default";
  EXPECT_DEATH(console.add_cvar("volume", "1", ""), "there is a cvar volume already");
}

TEST_F(QuakeSpasmCvarsTest, WhatIsThereStays) {
  Console other;
  other.add_cvar("volume", "0.5", "how loud it is");
  add_quakespasm_cvars(other);
  add_quakespasm_cvars(other);
  EXPECT_TRUE(other.cvar("volume").has_effect());
  EXPECT_EQ(other.cvar("volume").default_string(), "0.5");
}

TEST_F(QuakeSpasmCvarsTest, ListAndHelpMarkThem) {
  const auto before = console.scrollback().total();
  console.execute("cvarlist volume\nhelp volume");
  const auto lines = console.scrollback().latest(console.scrollback().total() - before);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].text, "- volume \"0.7\"");
  EXPECT_THAT(lines[2].text, HasSubstr("no effect here: a dedicated server is silent"));
  EXPECT_THAT(lines[3].text, HasSubstr("kept in config.cfg where it is not at its default"));
}

}  // namespace
}  // namespace fb::con
