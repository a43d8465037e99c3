#include "host/lab/suite_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "host/lab/judged_view.h"
#include "host/lab/lab_stage.h"
#include "lab/content_key.h"
#include "lab/image_io.h"
#include "lab/suite/judged_piece.h"
#include "lab/suite/measured_piece.h"

namespace fb::host {
namespace {

constexpr double kMostFitting = 4096;  // samples a frame

// --- raw samples ---

class MeasuredView : public OpenView {
 public:
  explicit MeasuredView(const lab::Experiment& experiment) : experiment_(experiment) {}

  Status open(std::size_t value, const SuiteOptions& o) {
    const lab::Experiment& e = experiment_;
    const lab::SuiteView view = lab::view_at(e, value);
    const uvec2 size = lab::size_at(e, value);
    StageOptions stage = stage_of(view, place_of(view, o.basedir, o.librequake).basedir, o.device, size);
    stage.quiet = true;
    if (auto status = open_stage(stage_, stage); !status) return Error{e.name + ": " + status.error().message};
    stage_.settings.jitter = std::max(stage_.settings.jitter, 0);
    for (const lab::ExperimentConfiguration& text : e.configurations) {
      auto configuration = configuration_of(stage_.console(), {text.name, text.sets}, text.name);
      if (!configuration) return Error{fmt::format("{}: {}", e.name, configuration.error().message)};
      configuration->settings.jitter = stage_.settings.jitter;
      configurations_.push_back(std::move(*configuration));
    }
    auto collected = lab::collect_view(
        *stage_.source, {view.first, view.last, view.warmup, e.hold || !view.map.empty(), view.frames_per_second});
    if (!collected) return Error{e.name + ": " + collected.error().message};
    view_ = std::move(*collected);
    for (const scene::FrameSnapshot& snapshot : view_.snapshots) {
      const std::uint64_t key = lab::content_key(snapshot);
      scene_ = hash_bytes(&key, sizeof key, scene_);
    }
    const std::uint32_t samples = e.errors ? e.reference_samples : 1;
    auto made = lab::make_references(
        view_, *stage_.device, stage_.settings,
        {e.errors ? e.reference_estimator : "pt", samples, size.x, size.y, e.errors ? o.references : "", o.quiet});
    if (!made) return Error{e.name + ": " + made.error().message};
    references_ = std::move(*made);
    stage_.renderer.reset();  // each configuration has its own
    return ok_status();
  }

  Result<lab::Json> measure(const lab::Piece& piece, const std::string& name, const lab::SuiteFolder& folder) override {
    const lab::Experiment& e = experiment_;
    const uvec2 size = lab::size_at(e, piece.value);
    lab::BenchJob job;
    job.configurations = configurations_;
    for (lab::Configuration& c : job.configurations) c.settings.seed += static_cast<int>(1000 * piece.repeat);
    job.width = size.x;
    job.height = size.y;
    job.quiet = true;
    if (e.vary.of_schedules()) return iterate(piece, name, folder, job);
    if (e.vary.of_time())
      if (auto status = fit_to_time(job, e.vary.values[piece.value]); !status) return status.error();
    const auto result = lab::run_bench(*stage_.device, view_, references_, job);
    if (!result) return Error{e.name + ": " + result.error().message};
    if (e.picture && e.errors && piece.repeat == 0)
      if (auto status = keep_pictures(folder, name, *result, &lab::ConfigurationResult::picture); !status)
        return status.error();
    return lab::measured_piece(e, piece, *result, scene_, relative_error(result->reference));
  }

 private:
  static double relative_error(const lab::ReferenceFigures& reference) {
    return reference.mean > 0 ? std::sqrt(reference.variance) / reference.mean : 0;
  }

  // One run of a picture in iterations, by settings and size of `as`.
  Result<lab::Json> iterate(const lab::Piece& piece, const std::string& name, const lab::SuiteFolder& folder,
                            const lab::BenchJob& as) {
    lab::IterateJob job;
    job.configurations = as.configurations;
    job.schedule = experiment_.vary.schedules[piece.value];
    job.width = as.width;
    job.height = as.height;
    job.runs = 1;
    job.quiet = true;
    const auto result = lab::run_iterate(*stage_.device, view_, references_.front(), job);
    if (!result) return Error{experiment_.name + ": " + result.error().message};
    if (experiment_.picture && piece.repeat == 0)
      if (auto status = keep_pictures(folder, name, *result, &lab::IteratedConfiguration::first); !status)
        return status.error();
    return lab::iterated_piece(experiment_, piece, *result, scene_, relative_error(result->reference));
  }

  template <typename Job, typename Configuration>
  Status keep_pictures(const lab::SuiteFolder& folder, const std::string& piece, const Job& result,
                       lab::Picture Configuration::*picture_of) const {
    const auto write = [&](const std::string& name, const lab::Picture& picture) {
      lab::ExrImage exr(picture.width, picture.height);
      exr.add_colors("", picture.pixels);
      return lab::write_exr(folder.picture_path(piece, name), exr);
    };
    for (const Configuration& c : result.configurations)
      if (auto status = write(c.name, c.*picture_of); !status) return status;
    return write("reference", references_.back().mean);
  }

  // The first frames of the view, enough to tell how long they take.
  lab::View beginning() const {
    lab::View few = view_;
    few.warmup = std::min(view_.warmup, 4u);
    few.measured = std::min(view_.measured, 4u);
    if (!few.still) few.snapshots.resize(few.frames());
    return few;
  }

  // Each configuration's samples a frame, so many that its own passes last as long, one at least. The time of a sample
  // depends on their number, so what was found is corrected once.
  Status fit_to_time(lab::BenchJob& job, double milliseconds) {
    const lab::View view = beginning();
    std::vector<lab::Reference> references = references_;
    if (!view.still) references.resize(view.measured);
    for (lab::Configuration& c : job.configurations) c.settings.spp = 1;
    for (int step = 0; step < 2; ++step) {
      const auto result = lab::run_bench(*stage_.device, view, references, job);
      if (!result) return result.error();
      for (std::size_t i = 0; i < job.configurations.size(); ++i) {
        render::RenderSettings& settings = job.configurations[i].settings;
        const double took = std::max(result->configurations[i].estimator_passes.median, 1e-6);
        settings.spp = static_cast<int>(std::clamp(std::round(settings.spp * milliseconds / took), 1.0, kMostFitting));
      }
    }
    return ok_status();
  }

  const lab::Experiment& experiment_;
  Stage stage_;
  lab::View view_;
  std::vector<lab::Reference> references_;
  std::vector<lab::Configuration> configurations_;
  std::uint64_t scene_ = 0;
};

// --- pictures that a player sees ---

class JudgedView : public OpenView {
 public:
  explicit JudgedView(const lab::Experiment& experiment) : experiment_(experiment) {}

  Status open(const std::vector<lab::Program>& programs, const SuiteOptions& o) {
    const lab::Experiment& e = experiment_;
    std::vector<ConfigurationText> texts;
    for (const lab::ExperimentConfiguration& c : e.configurations)
      texts.push_back({c.name.find('@') == std::string::npos ? c.name + "@this" : c.name, c.sets});
    auto lanes = lanes_of(texts, programs);
    if (!lanes) return Error{fmt::format("{}: {}", e.name, lanes.error().message)};
    job_.lanes = std::move(*lanes);
    job_.width = e.size.x;
    job_.height = e.size.y;
    job_.seeds = 1;
    job_.device = o.device;
    job_.scratch = scratch_folder();
    basedir_ = place_of(e.view, o.basedir, o.librequake).basedir;
    auto truth =
        find_truth(e.view, basedir_, {}, o.device,
                   {e.reference_estimator, e.reference_samples, e.size.x, e.size.y, o.references, e.name, o.quiet});
    if (!truth) return truth.error();
    truth_ = std::move(*truth);
    return ok_status();
  }

  Result<lab::Json> measure(const lab::Piece& piece, const std::string& name, const lab::SuiteFolder& folder) override {
    std::vector<lab::PassTimes> times(job_.lanes.size());
    job_.first_seed = piece.repeat + 1;
    job_.pictures = experiment_.picture && piece.repeat == 0 ? folder.path() + "/pieces" : "";
    job_.picture_name = name;
    job_.runner = [&](const lab::SequenceRequest& request) {
      auto sequence = lab::run_sequence(request);
      if (sequence) times[static_cast<std::size_t>(request.lane - job_.lanes.data())] = sequence->times;
      return sequence;
    };
    const auto judged = lab::judge_view(experiment_.view, basedir_, truth_.references, job_, nullptr);
    if (!judged) return judged.error();
    return lab::judged_piece(experiment_, piece, *judged, job_.lanes, times, truth_.scene);
  }

 private:
  const lab::Experiment& experiment_;
  std::string basedir_;
  lab::JudgeJob job_;
  JudgedTruth truth_;
};

}  // namespace

Result<std::unique_ptr<OpenView>> open_suite_view(const lab::Experiment& experiment, std::size_t value,
                                                  const std::vector<lab::Program>& programs, const SuiteOptions& o) {
  if (experiment.judged) {
    auto view = std::make_unique<JudgedView>(experiment);
    if (auto status = view->open(programs, o); !status) return status.error();
    return std::unique_ptr<OpenView>(std::move(view));
  }
  auto view = std::make_unique<MeasuredView>(experiment);
  if (auto status = view->open(value, o); !status) return status.error();
  return std::unique_ptr<OpenView>(std::move(view));
}

}  // namespace fb::host
