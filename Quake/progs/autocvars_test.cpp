#include "progs/autocvars.h"

#include "console/console.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

class AutocvarsTest : public testing::QcTest {
 protected:
  void run_with_cvars() {
    ASSERT_TRUE(start(
        "var float autocvar_size = 1.5; var string autocvar_word = \"first\"; var vector autocvar_place = '1 2 3';"
        "entity autocvar_no_value; float autocvar_echo; float autocvar_;"
        "void() main = { put(autocvar_size); puts(autocvar_word); putv(autocvar_place); };"
        "void() change = { autocvar_size = 9; };"));
    autocvars = std::make_unique<Autocvars>(*vm_, console);
  }
  void TearDown() override {
    autocvars.reset();
    QcTest::TearDown();
  }
  std::string values() {
    autocvars->refresh();
    EXPECT_TRUE(run().ok());
    return output();
  }
  con::Console console;
  std::unique_ptr<Autocvars> autocvars;
};

TEST_F(AutocvarsTest, MissingCvarsAreMadeWithTheGlobalsValues) {
  run_with_cvars();
  EXPECT_EQ(values(), "1.5 [first] (1 2 3)");
  EXPECT_EQ(console.cvar("size").default_string(), "1.5");
  EXPECT_EQ(console.cvar("place").default_string(), "1 2 3");
  for (const char* none : {"place_x", "no_value", "echo", ""}) EXPECT_EQ(console.find_cvar(none), nullptr) << none;
}

TEST_F(AutocvarsTest, GlobalsFollowTheCvars) {
  console.add_cvar("size", "4", "the engine's own");
  run_with_cvars();
  EXPECT_EQ(values(), "4 [first] (1 2 3)");
  console.set("word", "second");
  console.set("place", "-1 0.5 100");
  EXPECT_EQ(values(), "4 [second] (-1 0.5 100)");
  ASSERT_TRUE(run("change").ok());
  EXPECT_EQ(values(), "9 [second] (-1 0.5 100)") << "QuakeC may store in it";
  console.set("size", "2");
  EXPECT_EQ(values(), "2 [second] (-1 0.5 100)");
  console.set("place", "nonsense");
  EXPECT_EQ(values(), "2 [second] (0 0 0)");
}

}  // namespace
}  // namespace fb::progs
