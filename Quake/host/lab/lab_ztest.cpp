// fullbright-lab ztest: whether an estimator is biased relative to another.
#include <fmt/format.h>

#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/ztest/ztest_job.h"

namespace fb::host {
namespace {

struct ZTestCommand {
  StageOptions stage;
  lab::RunPlan plan;
  std::string reference = "pt", map;
  std::vector<std::string> reference_sets;
  std::uint32_t reference_spp = 0;
  double alpha = 1e-3;
  bool blocks = false;
};

// Exit status: 0 no bias found, 3 bias found, 1 the test was not possible.
int run_ztest(const ZTestCommand& c) {
  Stage stage;
  if (auto status = open_stage(stage, c.stage); !status) return fail(status.error());
  lab::RunPlan plan = c.plan;
  plan.width = stage.size.x;
  plan.height = stage.size.y;
  auto film = lab::collect_film(*stage.source, plan.skip + plan.frames - 1);
  if (!film) return fail(film.error());

  lab::Sampling tested{stage.settings, plan}, reference{stage.settings, plan};
  tested.settings.spp = static_cast<int>(c.stage.spp);
  if (auto status = known_estimator(c.reference, "--reference"); !status) return fail(status.error());
  for (const std::string& set : c.reference_sets) {
    if (auto status = set_cvar(stage.console(), set, "--reference-set " + set); !status) return fail(status.error());
  }
  reference.settings = render::read_render_settings(stage.console());
  reference.settings.estimator = c.reference;
  reference.settings.spp = static_cast<int>(c.reference_spp > 0 ? c.reference_spp : 4 * c.stage.spp);

  lab::ReferenceRuns expected(*stage.device, *film, reference);
  const auto verdict = lab::judge(expected, tested, c.alpha);
  if (!verdict) return fail(verdict.error());
  if (verdict->test.tested == 0 && verdict->test.pooled == 0)
    return fail(
        Error{"nothing was tested: in no block of pixels does either estimator's light vary (is the view black?)"});
  if (c.blocks) fmt::print("{}", lab::ztest_map(verdict->test));
  fmt::print("{}a bias of the energy of {:.3g}% would be found nine times in ten\n", verdict->text(),
             100 * verdict->test.detectable(c.alpha));
  return verdict->biased ? 3 : 0;
}

}  // namespace

LabCommand add_ztest_command(CLI::App& app) {
  auto c = std::make_shared<ZTestCommand>();
  c->stage.size = "64x48";
  CLI::App* ztest = app.add_subcommand("ztest",
                                       "tests whether an estimator is biased: compares its mean with pt's in blocks of "
                                       "pixels over independent runs; exits with 3 if biased");
  add_stage_options(*ztest, c->stage);
  add_number(*ztest, "--runs", c->plan.runs, 4u, 100000u,
             "independent runs of each estimator; a suspected bias is tested again with twice as many");
  add_number(*ztest, "--frames", c->plan.frames, 1u, 100000u, "frames averaged in a run");
  add_number(*ztest, "--skip", c->plan.skip, 0u, kMostFrames,
             "frames discarded at the start of a run, from which the estimator learns");
  ztest->add_flag("--fresh", c->plan.fresh, "start every run with nothing learnt (always so where something moves)");
  add_number(*ztest, "--block", c->plan.block, 1u, 4096u, "width and height of a block, pixels");
  ztest->add_option("--reference", c->reference, "the estimator to compare with")->capture_default_str();
  add_number(*ztest, "--reference-spp", c->reference_spp, 0u, kMostSamples,
             "samples per pixel and frame of the reference; 0: four times --spp");
  ztest->add_option("--reference-set", c->reference_sets, "cvar=value for the reference alone; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  add_number(*ztest, "--alpha", c->alpha, 1e-9, 0.5, "false-positive rate of the test");
  ztest->add_flag("--blocks", c->blocks, "print the z score of each block");
  return {ztest, [c] { return run_ztest(*c); }};
}

}  // namespace fb::host
