// Estimators that claim to be unbiased, held to pt's mean on scenes that are hard for them. A row is a scene, an
// estimator and what is set; a new feature is a new row. Small pictures and few runs, so that all of it takes seconds;
// `fullbright-lab ztest` runs a row for as long as one likes. That a bias would be seen: the rows of kHarness, and
// power_test.cpp.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <cctype>
#include <ostream>

#include "lab/ztest/ztest_job.h"
#include "render/techniques/technique.h"
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
  bool biased = false;                 // what must be found
  std::vector<std::string> both = {};  // set for pt, too
  std::string reference = "pt";        // where pt finds too little, another that pt's rows hold to it
};

RunPlan plan(std::uint32_t runs, std::uint32_t frames, std::uint32_t skip = 0, bool fresh = false) {
  const char* times = std::getenv("FULLBRIGHT_UNBIASED_TIMES");
  if (times != nullptr) runs *= static_cast<std::uint32_t>(std::max(std::atoi(times), 1));
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

std::string describe(const Row& row) {
  const char* state = !row.plan.fresh && row.plan.skip > 0 ? " warm" : "";
  return fmt::format("{} {}{} {} {}", row.scene, row.estimator, row.plan.fresh ? " cold" : state,
                     fmt::join(row.sets, " "), fmt::join(row.both, " "));
}
void PrintTo(const Row& row, std::ostream* out) { *out << describe(row); }

render::RenderSettings settings_of(const std::vector<std::string>& sets) {
  con::Console console;
  render::register_render_cvars(console);
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    EXPECT_TRUE(console.find_cvar(set.substr(0, equals)) && console.set(set.substr(0, equals), set.substr(equals + 1)))
        << set;
  }
  return render::read_render_settings(console);
}

class UnbiasedStatistics : public render::DeviceTest, public testing::WithParamInterface<Row> {
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
    auto& at = references_[fmt::format("{} {} {} {} {} {} {}", row.scene, row.reference, p.runs, p.frames, p.skip,
                                       row.spp, fmt::join(row.both, " "))];
    if (at.runs) return &at;
    auto source = code_scene(row.scene, 60);
    auto film = source ? collect_film(**source, p.skip + p.frames - 1) : Result<Film>(source.error());
    if (!film) {
      ADD_FAILURE() << film.error().message;
      return nullptr;
    }
    at.film = std::move(*film);
    Sampling sampling{settings_of(row.both), p};
    sampling.settings.estimator = row.reference;                        // the cvar's default is what the game uses
    sampling.settings.spp = (row.reference == "pt" ? 8 : 2) * row.spp;  // pt's are noisy, and cheap
    at.runs = std::make_unique<ReferenceRuns>(*device_, at.film, sampling);
    return &at;
  }
  static void look_at(const Row& row) {
    Expected* reference = expected(row);
    ASSERT_NE(reference, nullptr);
    std::vector<std::string> sets = row.both;
    sets.insert(sets.end(), row.sets.begin(), row.sets.end());
    Sampling tested{settings_of(sets), row.plan};
    tested.settings.estimator = row.estimator;
    tested.settings.spp = row.spp;
    const auto verdict = judge(*reference->runs, tested, kAlpha);
    ASSERT_TRUE(verdict.ok()) << verdict.error().message;
    EXPECT_EQ(verdict->biased, row.biased) << verdict->text() << ztest_map(verdict->test);
    EXPECT_EQ(verdict->lost, 0u) << "energy lost to NaN";
    const ZTest& test = verdict->test;
    fmt::print("{}: p {:.2g}, bias {:+.2f}% to {:+.2f}%, would find {:.2f}%{}\n", describe(row), test.p,
               100 * test.energy.low, 100 * test.energy.high, 100 * test.detectable(kAlpha),
               verdict->repeated ? " (looked twice)" : "");
  }
  inline static std::map<std::string, Expected> references_;
};

TEST_P(UnbiasedStatistics, HasTheMeanOfPt) { look_at(GetParam()); }

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
INSTANTIATE_TEST_SUITE_P(Harness, UnbiasedStatistics, testing::ValuesIn(kHarness), row_name);

// Path guiding: warm and cold, light that stands and light that moves.
RunPlan warm() { return plan(12, 4, 12); }
RunPlan cold() { return plan(16, 3, 0, true); }

// Every technique that says it is unbiased, new ones, too; ssmm is below.
std::vector<Row> every_unbiased() {
  std::vector<Row> rows;
  for (const render::TechniqueInfo& technique : render::techniques())
    if (technique.unbiased() && technique.name != "pt" && technique.name != "ssmm")
      rows.push_back({"kinds", std::string(technique.name), {}, warm(), 4});
  return rows;
}
INSTANTIATE_TEST_SUITE_P(Every, UnbiasedStatistics, testing::ValuesIn(every_unbiased()), row_name);

const Row kGuided[] = {
    {"cbox", "mcpg", {}, warm(), 2},           {"one_light", "mcpg", {}, warm(), 2},
    {"one_light", "mcpg", {}, cold(), 2},      {"one_light", "mcpg", {"r_deterministic=1"}, warm(), 2},
    {"many", "mcpg", {}, cold(), 2},           {"candles", "mcpg", {}, warm(), 4},
    {"strips", "mcpg", {}, warm(), 8},         {"rocket", "mcpg", {}, plan(12, 6, 4), 4},
    {"moving", "mcpg", {}, plan(12, 4, 8), 2},
};
INSTANTIATE_TEST_SUITE_P(Guided, UnbiasedStatistics, testing::ValuesIn(kGuided), row_name);

// Next-event estimation: what glows by itself, by texture, by pose, through holes and panes; sky and suns; coats.
const Row kLooksForLights[] = {
    {"kinds", "nee", {"r_nee_candidates=1"}, warm(), 4},
    {"cbox_glossy", "nee", {}, plan(16, 4), 4},
    {"moving", "nee", {}, plan(12, 4, 8), 2},
    {"one_light", "mcpg_nee", {}, cold(), 2},
    {"candles", "mcpg_nee", {}, warm(), 4},
};
INSTANTIATE_TEST_SUITE_P(LooksForLights, UnbiasedStatistics, testing::ValuesIn(kLooksForLights), row_name);

// Samples of light that pixels and frames share: lamps that come and go and change, what moves, water; light of two
// reflections past coats and what is translucent.
const Row kReused[] = {
    {"candles_flicker", "restir_di", {}, plan(12, 4, 4), 4, false, {"r_bounces=1"}, "nee"},
    {"moving", "restir_di", {}, plan(12, 4, 8), 2, false, {}, "nee"},
    {"ripple_above", "restir_di", {}, plan(12, 4, 4), 4, false, {"r_water=1"}, "nee"},
    {"cbox_glossy", "restir_di", {"r_restir_visibility=2"}, plan(12, 4, 8), 2, false, {"r_bounces=1"}, "nee"},
    {"cbox_glossy", "restir_di", {"r_restir_visibility=1"}, plan(12, 4, 8), 2, true, {"r_bounces=1"}, "nee"},
    {"cbox_glossy",
     "restir_di",
     {"r_restir_candidates=2", "r_restir_visibility=2"},
     plan(12, 4, 8),
     2,
     false,
     {"r_bounces=1"},
     "nee"},
    {"cbox_glossy", "restir_gi", {}, plan(12, 4, 8), 2, false, {}, "nee"},
    {"kinds", "restir_gi", {"r_restir_gi_neighbors=3"}, plan(12, 4, 8), 2, false, {}, "nee"},
    {"moving", "restir_gi", {}, plan(12, 4, 8), 2, false, {}, "nee"},
    {"cbox", "restir_guided", {}, plan(12, 4, 8), 2, false, {}, "nee"},
};
INSTANTIATE_TEST_SUITE_P(Reused, UnbiasedStatistics, testing::ValuesIn(kReused), row_name);

// Lobes that the pixels of a tile share: what is exchanged, and what is biased where it is not. Of many lamps a tile
// has no lobe for each, and what none stands for is rare and bright: that takes more runs than others need.
const Row kMixtures[] = {
    {"kinds", "ssmm", {}, plan(24, 4, 12), 48, false, {}, "nee"},
    {"cbox", "ssmm", {}, plan(24, 4, 12), 8, false, {"r_bounces=1"}, "nee"},
    {"cbox", "ssmm", {"r_ssmm_temporal=1"}, plan(24, 4, 12), 8, false, {"r_bounces=1"}, "nee"},
    {"cbox", "ssmm", {"r_ssmm_shuffle=0"}, plan(24, 4, 12), 8, true, {"r_bounces=1"}, "nee"},
    {"cbox", "ssmm", {"r_ssmm_world=1"}, plan(24, 4, 12), 8, false, {"r_bounces=1"}, "nee"},
    {"moving", "ssmm_nee", {"r_ssmm_indirect=1", "r_ssmm_world=1"}, plan(12, 4, 8), 2, false, {}, "nee"},
};
INSTANTIATE_TEST_SUITE_P(Mixtures, UnbiasedStatistics, testing::ValuesIn(kMixtures), row_name);

// Fields of light in the world: control variates that are wrong on purpose, known integrals and estimated ones, trees
// and mixtures, and the forms that are printed, which are biased.
const Row kFields[] = {
    {"cbox_glossy",
     "pstf_cv_nee",
     {"r_pstf_learn_beta=0", "r_pstf_beta=2", "r_pstf_noise=1"},
     warm(),
     2,
     false,
     {},
     "nee"},
    {"moving", "pstf_is_cv_nee", {"r_pstf_learn_beta=0"}, plan(12, 4, 8), 2, false, {}, "nee"},
    {"moving", "pstf_is_cv_nee", {"r_pstf_gaussians=8"}, plan(12, 4, 8), 2, false, {}, "nee"},
    {"cbox_glossy",
     "pstf_cv_nee",
     {"r_pstf_two_level=2", "r_pstf_learn_beta=0", "r_pstf_noise=1"},
     warm(),
     2,
     false,
     {},
     "nee"},
    {"cbox_glossy", "mcpg_cv", {"r_pstf_learn_beta=0", "r_pstf_noise=1"}, warm(), 2, false, {}, "nee"},
    {"cbox_glossy", "pstf_cv_nee", {"r_pstf_learn_beta=0", "r_pstf_form=1"}, warm(), 2, true, {}, "nee"},
    {"cbox_glossy", "pstf_cv_nee", {"r_pstf_learn_beta=0", "r_pstf_form=2"}, warm(), 2, true, {}, "nee"},
};
INSTANTIATE_TEST_SUITE_P(Fields, UnbiasedStatistics, testing::ValuesIn(kFields), row_name);

// Fog, with light straight from what glows and with what surfaces reflect into it. Shafts are held to nee, whose mean
// is that of pt (below) and of integrals (render/fog_statistics_test.cpp).
const Row kFog[] = {
    {"slab", "nee", {}, warm(), 4},
    {"slab", "mcpg", {}, warm(), 4},
    {"slab", "mcpg_nee", {}, cold(), 4},
    {"window", "mcpg_nee", {}, cold(), 4, false, {}, "nee"},
    {"window", "mcpg_nee", {}, warm(), 4, false, {"r_fog_bounces=2"}, "nee"},
    {"window", "mcpg", {}, warm(), 8, false, {"r_fog_bounces=2"}, "nee"},
    {"window", "nee", {"r_fog_bounces=1"}, warm(), 4, true, {"r_fog_bounces=2"}, "nee"},
};
INSTANTIATE_TEST_SUITE_P(Fog, UnbiasedStatistics, testing::ValuesIn(kFog), row_name);

// Interfaces of water: no straight ray finds the sun under them. Waves stand still.
const Row kWater[] = {
    {"ripple_soft", "nee", {}, plan(16, 4), 4, false, {"r_water=1"}},
    {"ripple_soft", "mcpg", {}, warm(), 4, false, {"r_water=1"}},
    {"ripple_soft", "mcpg_nee", {}, warm(), 4, false, {"r_water=1"}},
    {"ripple_above", "nee", {}, plan(16, 4), 4, false, {"r_water=1"}},
    {"ripple_above", "mcpg_nee", {}, warm(), 4, false, {"r_water=1"}},
    {"ripple_murky", "mcpg_nee", {}, warm(), 4, false, {"r_water=1"}},
};
INSTANTIATE_TEST_SUITE_P(Water, UnbiasedStatistics, testing::ValuesIn(kWater), row_name);

// Glass: no straight ray finds the lamp from within it.
const Row kGlass[] = {
    {"torus_soft", "nee", {}, warm(), 4},
    {"torus_soft", "mcpg", {}, warm(), 4},
};
INSTANTIATE_TEST_SUITE_P(Glass, UnbiasedStatistics, testing::ValuesIn(kGlass), row_name);

// Every feature off, some settings at their ends, more scenes. Looked at where time is given:
// FULLBRIGHT_UNBIASED_TIMES.
using MoreUnbiasedStatistics = UnbiasedStatistics;
TEST_P(MoreUnbiasedStatistics, HasTheMeanOfPt) { look_at(GetParam()); }
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MoreUnbiasedStatistics);

bool more_is_asked_for() { return std::getenv("FULLBRIGHT_UNBIASED_TIMES") != nullptr; }

std::vector<Row> every_unbiased_cold_and_moving() {
  std::vector<Row> rows;
  if (!more_is_asked_for()) return rows;
  for (const render::TechniqueInfo& technique : render::techniques()) {
    if (!technique.unbiased() || technique.name == "pt" || technique.name == "ssmm") continue;
    rows.push_back({"kinds", std::string(technique.name), {}, cold(), 4});
    rows.push_back({"moving", std::string(technique.name), {}, plan(12, 4, 8), 4, false, {}, "nee"});
    rows.push_back({"slab", std::string(technique.name), {}, warm(), 4});
  }
  return rows;
}
INSTANTIATE_TEST_SUITE_P(EveryColdMovingInFog, MoreUnbiasedStatistics,
                         testing::ValuesIn(every_unbiased_cold_and_moving()), row_name);

// Pixels that take turns see other moments of what moves, so that a moving reference takes the same turns.
const Row kFeatures[] = {
    {"rocket", "restir_di", {}, plan(16, 6, 4), 4, false, {}, "nee"},
    {"lightsout", "restir_di", {}, plan(12, 8, 96), 4, false, {}, "nee"},
    {"moving", "restir_di", {}, plan(16, 16, 8), 4, false, {"r_denoise=1", "r_light_scale=0.5"}, "nee"},
    {"moving", "restir_gi", {}, plan(16, 16, 8), 4, false, {"r_denoise=1", "r_light_scale=0.5"}, "nee"},
    {"cbox", "restir_guided", {"r_denoise=1", "r_light_scale=0.5"}, plan(16, 16, 8), 4, false, {}, "nee"},
    {"cbox", "ssmm", {"r_denoise=1", "r_light_scale=0.5"}, plan(24, 16, 12), 8, false, {"r_bounces=1"}, "nee"},
    {"cbox", "mcpg_nee", {"r_denoise=1", "r_light_scale=0.5"}, plan(16, 16, 8), 4},
    {"rocket", "ssmm", {"r_ssmm_world=1"}, plan(24, 8, 6), 8, false, {}, "nee"},
    {"occluder", "ssmm_nee", {"r_ssmm_world=1"}, plan(12, 4, 12), 4, false, {}, "nee"},
    {"ripple_above", "ssmm_nee", {}, warm(), 8, false, {"r_water=1"}, "nee"},
    {"lava", "ssmm", {"r_ssmm_tile=32"}, warm(), 4, false, {}, "nee"},
    {"lava", "pstf_cv", {"r_pstf_learn_beta=0", "r_pstf_noise=2"}, warm(), 2},
    {"lava", "pstf_is_cv", {"r_pstf_learn_beta=0", "r_pstf_beta=2"}, cold(), 2},
    {"lava", "pstf_cv", {"r_pstf_two_level=4", "r_pstf_learn_beta=0", "r_pstf_noise=2"}, warm(), 2},
    {"lava", "pstf_is_cv", {"r_pstf_gaussians=4", "r_pstf_learn_beta=0", "r_pstf_beta=2"}, cold(), 2},
    {"rocket", "pstf_is_nee", {}, plan(12, 6, 4), 4, false, {}, "nee"},
    {"lightsout", "pstf_cv_nee", {"r_pstf_learn_beta=0"}, plan(12, 8, 96), 4, false, {}, "nee"},
    {"ripple_above", "pstf_is_cv_nee", {}, warm(), 8, false, {"r_water=1"}, "nee"},
    {"slab", "pstf_is_cv", {"r_pstf_key=1", "r_pstf_directions=3"}, warm(), 4},
    {"kinds", "mcpg", {}, warm(), 8},
    {"ripple_above", "mcpg", {}, warm(), 8, false, {"r_water=1"}},
    {"ripple_murky_above", "mcpg_nee", {}, cold(), 8, false, {"r_water=1", "r_fog_bounces=2"}},
    {"ripple_murky", "nee", {}, plan(16, 4), 8, false, {"r_water=1"}},
    {"ripple_murky", "mcpg", {}, warm(), 8, false, {"r_water=1"}},
    {"torus_soft", "mcpg_nee", {}, warm(), 8},
    {"torus_soft", "nee", {"r_glass=0"}, warm(), 8, true},
    {"torus", "mcpg", {}, warm(), 8},
    {"torus", "nee", {}, plan(16, 4), 8},
    {"ripple_soft", "mcpg", {"r_mc_apparent=0"}, warm(), 8, false, {"r_water=1"}},
    {"ripple_soft", "mcpg_nee", {}, cold(), 8, false, {"r_water=1", "r_bounces=3"}},
    {"kinds", "nee", {}, plan(16, 4), 8, false, {"r_bounces=4"}},
    {"kinds", "mcpg_nee", {"r_deterministic=1"}, cold(), 8},
    {"cbox_glossy", "mcpg_nee", {}, warm(), 2},
    {"many", "mcpg_nee", {}, warm(), 2},
    {"rocket", "mcpg_nee", {}, plan(12, 6, 4), 4},
    {"kinds", "nee", {}, plan(16, 4), 8, false, {"r_emit_sun=0"}},
    {"one_light", "nee", {}, plan(16, 4), 2},
    {"many", "nee", {}, plan(16, 4), 2},
    {"candles", "nee", {}, plan(16, 4), 4},
    {"strips", "nee", {}, plan(16, 4), 8},
    {"rocket", "nee", {}, plan(12, 6, 4), 4},
    {"lightsout", "nee", {}, plan(12, 8, 96), 4},
    {"cbox", "mcpg", {}, cold(), 2},
    {"many", "mcpg", {}, warm(), 2},
    {"candles", "mcpg", {}, cold(), 4},
    {"strips", "mcpg", {}, cold(), 8},
    {"lava", "mcpg", {}, warm(), 2},
    {"cbox_glossy", "mcpg", {}, warm(), 2},
    {"candles_flicker", "mcpg", {}, plan(12, 4, 6), 4},
    {"lightsout", "mcpg", {}, plan(12, 8, 96), 4},
    {"lightsout", "mcpg", {"r_mc_loss=0"}, plan(12, 8, 96), 4},
    {"one_light", "mcpg", {}, warm(), 2, false, {"r_bounces=1"}},
    {"cbox", "mcpg", {}, warm(), 2, false, {"r_bounces=4"}},
    {"rocket", "mcpg", {"r_deterministic=1"}, plan(12, 6, 4), 4},
    {"rocket", "mcpg", {"r_mc_predict=0"}, plan(12, 6, 4), 4},
    {"rocket", "mcpg", {"r_mc_loss=0"}, plan(12, 6, 4), 4},
    {"moving", "mcpg", {"r_mc_previous=0"}, plan(12, 4, 8), 2},
    {"one_light", "mcpg", {"r_mc_cache=0"}, warm(), 2},
    {"one_light", "mcpg", {"r_mc_learn_share=0"}, warm(), 2},
    {"one_light", "mcpg", {"r_mc_learn_share=0", "r_mc_share=0.98"}, warm(), 2},
    {"one_light", "mcpg", {"r_mc_score=0"}, warm(), 2},
    {"one_light", "mcpg", {"r_mc_world=0"}, warm(), 2},
    {"one_light", "mcpg", {"r_mc_paper=1"}, warm(), 2},
    {"candles", "mcpg", {"r_mc_train=1"}, warm(), 4},
    {"many", "mcpg", {"r_mc_states=1024", "r_mc_cells=1024"}, warm(), 2},
    {"many", "mcpg", {"r_mc_adaptive=1", "r_mc_coarser=0"}, warm(), 2},
    {"many", "mcpg", {"r_mc_adaptive=0.7", "r_mc_wider=1", "r_mc_static=16"}, warm(), 2},
    {"slab", "mcpg", {}, cold(), 4},
    {"slab", "mcpg_nee", {}, warm(), 4},
    {"slab", "mcpg", {"r_mc_adaptive=1"}, warm(), 4},
    {"slab", "mcpg", {"r_mc_paper=1"}, warm(), 4},
    {"slab", "nee", {}, warm(), 4, false, {"r_fog_bounces=2"}},
    {"window", "nee", {}, plan(24, 4), 64, false, {"r_fog_bounces=2"}},
    {"window", "nee", {}, plan(24, 4), 64},
    {"window", "mcpg", {}, warm(), 16, false, {}, "nee"},
    {"window", "mcpg", {}, cold(), 16, false, {"r_fog_bounces=2"}, "nee"},
    {"window", "mcpg_nee", {"r_deterministic=1"}, warm(), 8, false, {"r_fog_bounces=3"}, "nee"},
    {"window", "mcpg", {"r_deterministic=1"}, warm(), 16, false, {}, "nee"},
};
INSTANTIATE_TEST_SUITE_P(Features, MoreUnbiasedStatistics,
                         testing::ValuesIn(more_is_asked_for()
                                               ? std::vector<Row>(std::begin(kFeatures), std::end(kFeatures))
                                               : std::vector<Row>()),
                         row_name);

}  // namespace
}  // namespace fb::lab
