#include "lab/ztest/ztest_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/hash.h"
#include "render/renderer.h"
#include "shared/rng.h"

namespace fb::lab {
namespace {

bool shows_the_same(const scene::FrameSnapshot& a, const scene::FrameSnapshot& b) {
  const auto hash = [](const scene::FrameSnapshot& s) {
    const auto key = hash_span(std::span<const scene::Instance>(s.instances), s.assets->generation);
    const scene::Camera cameras[] = {s.camera};
    return hash_span(std::span<const scene::Camera>(cameras), key);
  };
  return a.time == b.time && hash(a) == hash(b);
}

render::Frames frames_of(const std::string& estimator) {
  const render::TechniqueInfo* technique = render::find_technique(estimator);
  return technique != nullptr ? technique->frames : render::Frames::kIndependent;
}

// Plays a film for an estimator, frame after frame.
class Player {
 public:
  Player(gpu::Device& device, const Film& film, const Sampling& sampling)
      : device_(device), film_(film), sampling_(sampling), settings_(sampling.settings) {
    settings_.accumulate = 0;
    settings_.jitter = 0;
  }

  // Forgets everything and rewinds.
  Status restart(std::uint32_t run) {
    settings_.seed = sampling_.settings.seed + static_cast<int>(run);
    next_ = 0;
    if (renderer_) {
      renderer_->reset_learning();
      return ok_status();
    }
    auto renderer = render::Renderer::create(device_, settings_);
    if (!renderer) return renderer.error();
    renderer_ = std::move(*renderer);
    renderer_->resize(sampling_.plan.width, sampling_.plan.height);
    return ok_status();
  }
  void pass_over(std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i, ++next_)
      if (frames_of(settings_.estimator) != render::Frames::kIndependent)
        renderer_->render(frame(), nullptr, settings_);
  }
  // Of pixels that take turns (r_light_scale) the mean of the frames that sampled them.
  Result<Picture> average(std::uint32_t frames) {
    const std::size_t pixels = std::size_t{sampling_.plan.width} * sampling_.plan.height;
    std::vector<vec4> sums(pixels, vec4(0.0f));
    for (std::uint32_t i = 0; i < frames; ++i, ++next_) {
      renderer_->render(frame(), nullptr, settings_);
      const std::vector<vec4> radiance = renderer_->read().linear();
      for (std::size_t p = 0; p < pixels; ++p) sums[p] += vec4(radiance[p].w * vec3(radiance[p]), radiance[p].w);
    }
    Picture picture{sampling_.plan.width, sampling_.plan.height, std::vector<vec3>(pixels)};
    for (std::size_t p = 0; p < pixels; ++p) {
      if (!(sums[p].w > 0))
        return Error{fmt::format(
            "{} frames a run sample some pixels never, which take turns (r_light_scale): give more", frames)};
      picture.pixels[p] = vec3(sums[p]) / sums[p].w;
    }
    return picture;
  }
  std::uint32_t lost() const { return renderer_->read().counters().not_finite; }

 private:
  scene::FrameSnapshot frame() const {
    scene::FrameSnapshot snapshot = film_[std::min<std::size_t>(next_, film_.size() - 1)];
    snapshot.frame = next_;
    return snapshot;
  }

  gpu::Device& device_;
  const Film& film_;
  const Sampling& sampling_;
  render::RenderSettings settings_;
  std::unique_ptr<render::Renderer> renderer_;
  std::uint64_t next_ = 0;
};

// `side` is 0 for the reference and 1 for what is tested.
Sampling nth_attempt(Sampling sampling, std::uint32_t side, int attempt) {
  const std::uint32_t stream = 2 * static_cast<std::uint32_t>(attempt) + side;
  const auto seed = static_cast<std::uint32_t>(sampling.settings.seed);
  sampling.settings.seed = static_cast<int>(shared::hash_combine(seed, stream) & 0x3fffffffu);
  sampling.plan.runs <<= attempt;
  return sampling;
}

}  // namespace

Result<Film> collect_film(FrameSource& source, std::uint64_t last) {
  Film film;
  for (std::uint64_t i = 0; i <= std::max<std::uint64_t>(last, 1); ++i) {
    scene::FrameSnapshot snapshot;
    auto more = source.next(snapshot);
    if (!more) return more.error();
    if (!*more) return Error{fmt::format("there is no frame {}: the demo has {} frames at this rate", i, i)};
    film.push_back(std::move(snapshot));
    if (i == 1 && shows_the_same(film[0], film[1])) {
      film.pop_back();
      return film;
    }
  }
  film.resize(last + 1);
  return film;
}

Result<SampledRuns> render_runs(gpu::Device& device, const Film& film, const Sampling& sampling) {
  const RunPlan& plan = sampling.plan;
  const bool moves = film.size() > 1;
  if (moves && film.size() < std::uint64_t{plan.skip} + plan.frames)
    return Error{fmt::format("a film of {} frames is too short: {} to skip and {} to measure", film.size(), plan.skip,
                             plan.frames)};
  SampledRuns result{BlockRuns(plan.width, plan.height, plan.block)};
  Player player(device, film, sampling);
  // What a frame took from those before it would make one sequence of all runs.
  const bool restarts = plan.fresh || moves || frames_of(sampling.settings.estimator) == render::Frames::kCorrelated;
  for (std::uint32_t run = 0; run < plan.runs; ++run) {
    if (run == 0 || restarts) {
      if (auto status = player.restart(run); !status) return status.error();
      player.pass_over(plan.skip);
    }
    const auto picture = player.average(plan.frames);
    if (!picture) return picture.error();
    result.blocks.add(*picture);
  }
  result.lost = player.lost();
  return result;
}

std::string Verdict::text() const {
  std::string text = ztest_text(test);
  if (repeated) text = fmt::format("first p {:.3g}; repeated with twice the runs:\n", first_p) + text;
  if (lost > 0) text += fmt::format("{} samples were not finite and counted as zero\n", lost);
  return text + (biased ? "BIASED\n" : "no bias found\n");
}

Result<const SampledRuns*> ReferenceRuns::attempt(int index) {
  std::optional<SampledRuns>& runs = runs_[index];
  if (runs) return &*runs;
  auto rendered = render_runs(device_, film_, nth_attempt(sampling_, 0, index));
  if (!rendered) return rendered.error();
  runs = std::move(*rendered);
  return &*runs;
}

Result<Verdict> judge(ReferenceRuns& reference, Sampling tested, double alpha) {
  Verdict verdict;
  for (int attempt = 0; attempt < 2; ++attempt) {
    auto expected = reference.attempt(attempt);
    if (!expected) return expected.error();
    auto found = render_runs(reference.device(), reference.film(), nth_attempt(tested, 1, attempt));
    if (!found) return found.error();
    verdict.lost += found->lost;
    if (attempt == 1) verdict.first_p = verdict.test.p;
    verdict.repeated = attempt == 1;
    verdict.test = z_test((*expected)->blocks, found->blocks);
    verdict.biased = attempt == 1 && verdict.test.p < alpha;
    if (verdict.test.p >= alpha) break;
  }
  return verdict;
}

}  // namespace fb::lab
