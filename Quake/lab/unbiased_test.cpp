// Estimators that claim to be unbiased, held to pt's mean on scenes that are hard for them, and the proof that a bias
// would be seen. A row is a scene, an estimator and what is set; a new feature is a new row. Small pictures and few
// runs, so that all of it takes seconds; `fullbright-lab ztest` runs a row for as long as one likes.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>

#include "lab/ztest_job.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

// Of one row; with the verdict's repetition, a whole table seldom errs: some 1e-8 a row.
constexpr double kAlpha = 1e-4;

struct Row {
  std::string scene, estimator;
  std::vector<std::string> sets;
  RunPlan plan;
  int spp = 4;
  bool biased = false;  // what must be found
};

RunPlan plan(std::uint32_t runs, std::uint32_t frames, std::uint32_t skip = 0, bool fresh = false) {
  RunPlan p;
  p.width = 48;
  p.height = 36;
  p.block = 6;
  p.runs = runs;
  p.frames = frames;
  p.skip = skip;
  p.fresh = fresh;
  return p;
}

void PrintTo(const Row& row, std::ostream* out) {
  *out << row.scene << ' ' << row.estimator;
  for (const std::string& set : row.sets) *out << ' ' << set;
}

render::RenderSettings settings_of(const Row& row) {
  con::Console console;
  render::register_render_cvars(console);
  for (const std::string& set : row.sets) {
    const std::size_t equals = set.find('=');
    EXPECT_TRUE(console.find_cvar(set.substr(0, equals)) && console.set(set.substr(0, equals), set.substr(equals + 1)))
        << set;
  }
  render::RenderSettings settings = render::read_render_settings(console);
  settings.estimator = row.estimator;
  settings.spp = row.spp;
  return settings;
}

class UnbiasedTest : public render::DeviceTest, public testing::WithParamInterface<Row> {
 protected:
  static void TearDownTestSuite() {
    references_.clear();
    DeviceTest::TearDownTestSuite();
  }
  // pt on a row's scene: rows of the same scene and plan share it.
  struct Expected {
    Film film;
    std::unique_ptr<ReferenceRuns> runs;
  };
  static Expected* expected(const Row& row) {
    const RunPlan& p = row.plan;
    auto& at = references_[fmt::format("{} {} {} {} {}", row.scene, p.runs, p.frames, p.skip, row.spp)];
    if (at.runs) return &at;
    auto source = code_scene(row.scene, 60);
    auto film = source ? collect_film(**source, p.skip + p.frames - 1) : Result<Film>(source.error());
    if (!film) {
      ADD_FAILURE() << film.error().message;
      return nullptr;
    }
    at.film = std::move(*film);
    Sampling sampling{{}, p};
    sampling.settings.spp = 2 * row.spp;
    at.runs = std::make_unique<ReferenceRuns>(*device_, at.film, sampling);
    return &at;
  }
  inline static std::map<std::string, Expected> references_;
};

TEST_P(UnbiasedTest, HasTheMeanOfPt) {
  const Row& row = GetParam();
  Expected* reference = expected(row);
  ASSERT_NE(reference, nullptr);
  const auto verdict = judge(*reference->runs, {settings_of(row), row.plan}, kAlpha);
  ASSERT_TRUE(verdict.ok()) << verdict.error().message;
  EXPECT_EQ(verdict->biased, row.biased) << verdict->text() << ztest_map(verdict->test);
  EXPECT_EQ(verdict->lost, 0u) << "energy lost to NaN";
  RecordProperty("p", fmt::format("{:.3g}", verdict->test.p));
  RecordProperty("detectable_percent", fmt::format("{:.3g}", 100 * verdict->test.detectable(kAlpha)));
}

std::string row_name(const testing::TestParamInfo<Row>& info) {
  std::string name = fmt::format("{}_{}_{}", info.index, info.param.scene, info.param.estimator);
  for (const std::string& set : info.param.sets) name += "_" + set;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

// The harness: pt against itself with other seeds is fair, pt with an error put in is not.
const Row kHarness[] = {
    {"cbox", "pt", {}, plan(16, 4), 4, false},
    {"cbox", "pt", {"r_bounces=1"}, plan(16, 4), 4, true},
    {"cbox", "pt", {"r_bounces=3"}, plan(16, 4), 4, true},
    {"lava", "pt", {}, plan(16, 4), 4, false},
    {"rocket", "pt", {}, plan(16, 4, 10), 4, false},
};
INSTANTIATE_TEST_SUITE_P(Harness, UnbiasedTest, testing::ValuesIn(kHarness), row_name);

using PowerTest = render::DeviceTest;

TEST_F(PowerTest, FindsTwoPercentMoreLight) {
  auto source = code_scene("lava", 60);
  ASSERT_TRUE(source.ok());
  auto film = collect_film(**source, 0);
  ASSERT_TRUE(film.ok());
  Film brighter = *film;  // no cvar scales what glows in scenes made in code
  auto assets = std::make_shared<scene::Assets>(*brighter[0].assets);
  assets->generation = scene::next_generation();
  for (scene::Material& material : assets->materials) material.emission *= 1.02f;
  brighter[0].assets = assets;
  Sampling reference{{}, plan(16, 4)}, tested = reference;
  reference.settings.spp = tested.settings.spp = 4;
  tested.settings.seed = 1000;
  const auto expected = render_runs(*device_, *film, reference), found = render_runs(*device_, brighter, tested);
  ASSERT_TRUE(expected.ok() && found.ok());
  const ZTest test = z_test(expected->blocks, found->blocks);
  EXPECT_LT(test.p, kAlpha) << ztest_text(test);
  EXPECT_LT(test.detectable(kAlpha), 0.02);
  EXPECT_LT(test.energy.low, 0.02);
  EXPECT_GT(test.energy.high, 0.02);
}

// With the same seeds on both sides every difference would be zero, and no bias would ever be found.
TEST_F(PowerTest, TheSidesAreIndependent) {
  auto source = code_scene("lava", 60);
  ASSERT_TRUE(source.ok());
  const auto film = collect_film(**source, 0);
  ASSERT_TRUE(film.ok());
  const Sampling sampling{{}, plan(8, 2)};
  ReferenceRuns reference(*device_, *film, sampling);
  const auto verdict = judge(reference, sampling, kAlpha);
  ASSERT_TRUE(verdict.ok());
  EXPECT_FALSE(verdict->biased);
  EXPECT_GT(verdict->test.chi_squared, 0.5 * static_cast<double>(verdict->test.tested));
}

}  // namespace
}  // namespace fb::lab
