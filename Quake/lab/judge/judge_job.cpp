#include "lab/judge/judge_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.h"
#include "lab/judge/judge_pictures.h"

namespace fb::lab {
namespace {

// What does not change from sequence to sequence.
struct ViewTruth {
  const std::vector<JudgedReference>& references;
  std::vector<Picture> shown;  // sRGB values
  std::vector<std::vector<bool>> edges, inside;
  std::vector<Reference> interiors;  // of the references
  ReferenceFacts facts;

  const JudgedReference& at(std::size_t frame) const { return references[std::min(frame, references.size() - 1)]; }
  const Picture& shown_at(std::size_t frame) const { return shown[std::min(frame, shown.size() - 1)]; }
  const std::vector<bool>& edges_at(std::size_t frame) const { return edges[std::min(frame, edges.size() - 1)]; }
  const std::vector<bool>& inside_at(std::size_t frame) const { return inside[std::min(frame, inside.size() - 1)]; }
  const Reference& interior_at(std::size_t frame) const { return interiors[std::min(frame, interiors.size() - 1)]; }
};

double mean_radiance(const Picture& picture) {
  double sum = 0;
  for (const vec3& p : picture.pixels) sum += double{p.x} + p.y + p.z;
  return picture.pixels.empty() ? 0 : sum / (3.0 * static_cast<double>(picture.pixels.size()));
}

// Frames are shown at the exposure of the first: it stays fixed within a view.
ViewTruth find_truth(const std::vector<JudgedReference>& references) {
  const double exposure = references.front().exposure;
  const bool tone_map = references.front().tone_map;
  ViewTruth truth{references, {}, {}, {}, {}, {}};
  ReferenceFacts& facts = truth.facts;
  const auto share = 1.0 / static_cast<double>(references.size());
  for (const JudgedReference& reference : references) {
    truth.shown.push_back(shown(reference.radiance.mean, exposure, tone_map));
    truth.edges.push_back(silhouettes(reference.guides));
    truth.inside.push_back(interior(reference.guides));
    const Reference& inside = truth.interiors.emplace_back(pixels_where(reference.radiance, truth.inside.back()));
    facts.interior += share * static_cast<double>(inside.mean.pixels.size()) /
                      static_cast<double>(reference.radiance.mean.pixels.size());
    facts.mean += share * mean_radiance(inside.mean);
    facts.epsilon += share * relative_epsilon(inside.mean);
    facts.flip += share * reference_flip(reference.radiance, exposure, tone_map);
  }
  double variance = 0;
  for (const Reference& inside : truth.interiors) {
    const Errors own = measure(inside, inside.mean, {facts.epsilon});
    facts.rel_variance += share * own.reference_rel_variance;
    variance += share * share * own.reference_bias_error * own.reference_bias_error;
  }
  facts.bias_error = facts.mean > 0 ? std::sqrt(variance) / facts.mean : 0;
  return truth;
}

struct Measured {
  Figures figures = unknown_figures();
  IsolatedPixels isolated;
  std::uint64_t not_finite = 0;
  std::vector<float> flip;  // per pixel
};

Measured measure_frame(const ViewTruth& truth, const std::vector<JudgedFrame>& frames, std::size_t index,
                       const JudgeJob& job) {
  Measured m;
  const JudgedReference& reference = truth.at(index);
  const JudgedFrame& frame = frames[index];
  m.flip = flip::ldr_flip(decoded(truth.shown_at(index)), decoded(frame.shown), job.pixels_per_degree);
  m.figures[kFlip] = flip::mean_of(m.flip);
  m.figures[kFlipEdges] = mean_where(m.flip, truth.edges_at(index));
  m.isolated = isolated_pixels(truth.shown_at(index), frame.shown);
  m.figures[kDark] = m.isolated.dark;
  m.figures[kBright] = m.isolated.bright;
  if (index > 0) {
    m.figures[kFlicker] = flicker({truth.shown_at(index - 1), frames[index - 1].shown, truth.at(index - 1).guides},
                                  {truth.shown_at(index), frame.shown, reference.guides});
  }
  if (index > 1 && frame.linear)
    m.figures[kLag] = lag(truth.at(index - 2).radiance.mean, reference.radiance.mean, *frame.linear);
  const Reference& inside = truth.interior_at(index);
  if (!frame.linear || inside.mean.pixels.empty()) return m;
  const Picture test = pixels_where(*frame.linear, truth.inside_at(index));
  const Errors errors = measure(inside, test, {truth.facts.epsilon});
  m.figures[kRelMse] = errors.rel_mse_corrected();
  m.figures[kRelMseTrimmed] = trimmed_rel_mse(inside, test, truth.facts.epsilon);
  m.figures[kTopShare] = errors.top_share;
  if (truth.facts.mean > 0) m.figures[kBias] = errors.bias / truth.facts.mean;
  m.not_finite = errors.not_finite;
  return m;
}

// Adds a seed to the lane; returns FLIP of its last frame, per pixel.
std::vector<float> add_seed(LaneFigures& lane, const ViewTruth& truth, const Sequence& sequence, const JudgeJob& job) {
  std::vector<Figures> frames;
  std::vector<float> last;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    Measured m = measure_frame(truth, sequence.frames, i, job);
    lane.most_dark = std::max(lane.most_dark, m.isolated.dark);
    lane.most_bright = std::max(lane.most_bright, m.isolated.bright);
    lane.not_finite += m.not_finite;
    frames.push_back(m.figures);
    last = std::move(m.flip);
  }
  Figures seed = mean_of(frames);
  if (sequence.times.all > 0) {
    seed[kGBufferMs] = sequence.times.gbuffer;
    seed[kPathsMs] = sequence.times.paths;
    seed[kDenoiserMs] = sequence.times.denoiser;
    seed[kAllMs] = sequence.times.all;
  }
  lane.seeds.push_back(seed);
  return last;
}

std::vector<std::string> fixed_exposure(float exposure) {
  return {"r_autoexposure=0", fmt::format("r_exposure={}", exposure)};
}

Status check_sizes(const SuiteView& view, const std::vector<JudgedReference>& references, const JudgeJob& job) {
  if (references.size() != 1 && references.size() != view.frames())
    return Error{fmt::format("{}: {} references of {} frames", view.name, references.size(), view.frames())};
  for (const JudgedReference& reference : references) {
    const Picture& mean = reference.radiance.mean;
    if (mean.width != job.width || mean.height != job.height)
      return Error{fmt::format("{}: the reference has {}x{} pixels, {}x{} are judged", view.name, mean.width,
                               mean.height, job.width, job.height)};
  }
  return ok_status();
}

}  // namespace

Result<JudgedView> judge_view(const SuiteView& view, const std::string& basedir,
                              const std::vector<JudgedReference>& references, const JudgeJob& job,
                              const std::function<void()>& done) {
  if (auto status = check_sizes(view, references, job); !status) return status.error();
  const ViewTruth truth = find_truth(references);
  JudgedView result{view, references.front().exposure, {}};
  result.figures.reference = truth.facts;
  result.figures.lanes.resize(job.lanes.size());
  std::vector<Beside> columns(job.lanes.size());
  for (std::uint32_t seed = 0; seed < job.seeds; ++seed) {
    for (std::size_t k = 0; k < job.lanes.size(); ++k) {
      const std::size_t lane = (k + job.first_seed + seed) % job.lanes.size();
      SequenceRequest request{&job.lanes[lane], &view,      basedir,  job.device,
                              job.width,        job.height, job.sets, job.scratch};
      const auto exposure = fixed_exposure(result.exposure);
      request.sets.insert(request.sets.end(), exposure.begin(), exposure.end());
      request.sets.push_back(fmt::format("r_seed={}", job.first_seed + seed));
      const auto sequence = job.runner(request);
      if (!sequence) return sequence.error();
      FB_CHECK_EQ(sequence->frames.size(), view.frames());
      std::vector<float> flip = add_seed(result.figures.lanes[lane], truth, *sequence, job);
      if (seed == 0) columns[lane] = {sequence->frames.back().shown, std::move(flip)};
      if (done) done();
    }
  }
  if (!job.pictures.empty()) {
    const std::size_t last = view.frames() - 1;
    auto status = write_side_by_side(job.pictures, job.picture_name.empty() ? view.name : job.picture_name,
                                     truth.shown_at(last), truth.edges_at(last), columns);
    if (!status) return status.error();
  }
  return result;
}

Result<double> tone_curve_difference(const Program& program, const JudgeJob& job) {
  constexpr float kExposure = 1.5f;  // of a scene that is neither dark nor all white then
  SuiteView view;
  view.name = "tone curve";
  view.scene = "cbox";
  Lane lane{program.name, program, "pt", 4, {"r_denoise=0", "r_fxaa=0", "r_jitter=0"}};
  SequenceRequest request{&lane, &view, "", job.device, 64, 36, fixed_exposure(kExposure), job.scratch};
  const auto sequence = job.runner(request);
  if (!sequence) return sequence.error();
  const JudgedFrame& frame = sequence->frames.front();
  if (!frame.linear) return std::numeric_limits<double>::infinity();
  const Picture wanted = shown(*frame.linear, kExposure, true);
  float largest = 0;
  for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
    const vec3 d = glm::abs(wanted.pixels[i] - frame.shown.pixels[i]);
    largest = std::max({largest, d.x, d.y, d.z});
  }
  return 255.0 * largest;
}

}  // namespace fb::lab
