// An estimator held to another's mean on a film: the runs that a z-test wants, rendered; and the verdict.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "gpu/device.h"
#include "lab/frame_source.h"
#include "lab/ztest/ztest.h"
#include "render/passes/settings.h"

namespace fb::lab {

// Consecutive frames; a single one stands still for as long as it is looked at.
using Film = std::vector<scene::FrameSnapshot>;
// Frames 0 to `last` of a source; one only if the source's first two frames show the same.
Result<Film> collect_film(FrameSource& source, std::uint64_t last);

struct RunPlan {
  std::uint32_t width = 64, height = 48, block = 8;
  std::uint32_t runs = 24;
  std::uint32_t frames = 4;  // averaged in a run
  std::uint32_t skip = 0;    // frames before them: what an estimator learns from, not measured
  // Every run starts with nothing learnt; else a run goes on where the one before it ended, and `skip` comes once. So
  // do always the runs of a film of several frames, which is played from its start, and of an estimator whose frames
  // are correlated (render::Frames).
  bool fresh = false;
};

struct Sampling {
  render::RenderSettings settings;  // spp is of one frame; run n has seed + n
  RunPlan plan;
};
struct SampledRuns {
  BlockRuns blocks;
  std::uint32_t lost = 0;  // samples that were not finite
};
// Pixels are sampled at their centres, so that both sides see the same surfaces. Fails as Renderer::create does, and if
// the film is shorter than skip + frames.
Result<SampledRuns> render_runs(gpu::Device& device, const Film& film, const Sampling& sampling);

// What others are held to: rendered when first asked for, kept for who asks again.
class ReferenceRuns {
 public:
  // All must outlive it.
  ReferenceRuns(gpu::Device& device, const Film& film, Sampling sampling)
      : device_(device), film_(film), sampling_(std::move(sampling)) {}
  // Attempt 1 has other seeds than attempt 0, and twice the runs.
  Result<const SampledRuns*> attempt(int index);
  const Film& film() const { return film_; }
  gpu::Device& device() const { return device_; }

 private:
  gpu::Device& device_;
  const Film& film_;
  Sampling sampling_;
  std::optional<SampledRuns> runs_[2];
};

struct Verdict {
  ZTest test;
  std::uint32_t lost = 0;  // samples of the tested side that were not finite
  bool repeated = false;   // there was something to repeat: `test` is the repetition, with twice the runs
  double first_p = 1;
  bool biased = false;  // p was below alpha both times
  std::string text() const;
};
// Seeds of the two sides and of the repetition are drawn apart, from the samplings' own. `alpha` is the false-alarm
// rate of one test; of a verdict it is about its square. Both sides must have the same size, block, frames and skip.
Result<Verdict> judge(ReferenceRuns& reference, Sampling tested, double alpha);

}  // namespace fb::lab
