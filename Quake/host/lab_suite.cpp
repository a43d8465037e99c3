// fullbright-lab suite, suite-merge: whole sets of measurements, resumed where they were interrupted, split over
// machines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

#include "base/hash.h"
#include "base/log.h"
#include "base/progress.h"
#include "host/build_text.h"
#include "host/lab_numbers.h"
#include "host/lab_stage.h"
#include "host/options.h"
#include "lab/content_key.h"
#include "lab/image_io.h"
#include "lab/suite/suite_results.h"

namespace fb::host {
namespace {

struct SuiteOptions {
  std::string suite, out, basedir, librequake, size, device, shard, references;
  std::vector<std::string> experiments, sets;
  std::uint32_t repeats = 0, reference_samples = 0;
  bool quiet = false;
};

// The suite with what the command line changes. Experiments that are not asked for are left out.
Result<lab::ExperimentSuite> read_wanted(const SuiteOptions& o) {
  auto suite = lab::read_experiments(o.suite);
  if (!suite) return suite.error();
  std::vector<std::string> names;
  for (const std::string& list : o.experiments)
    for (const std::string& name : split(list, ',')) names.push_back(name);
  for (const std::string& name : names) {
    const auto is = [&](const lab::Experiment& e) { return e.name == name; };
    if (std::ranges::none_of(suite->experiments, is))
      return Error{fmt::format("--experiments {}: {} has no such experiment", name, o.suite)};
  }
  if (!names.empty())
    std::erase_if(suite->experiments,
                  [&](const lab::Experiment& e) { return std::ranges::find(names, e.name) == names.end(); });
  std::optional<uvec2> size;
  if (!o.size.empty()) {
    const auto parsed = parse_size(o.size);
    if (!parsed) return Error{"--size: " + parsed.error().message};
    size = *parsed;
  }
  for (lab::Experiment& e : suite->experiments) {
    if (size) e.size = *size;
    if (o.repeats > 0) e.repeats = o.repeats;
    if (o.reference_samples > 0) e.reference_samples = o.reference_samples;
    e.view.sets.insert(e.view.sets.end(), o.sets.begin(), o.sets.end());
    if (auto status = unbiased_estimator(e.reference_estimator, e.name + ": \"reference_estimator\"");
        !status && e.errors)
      return status.error();
  }
  return suite;
}

constexpr double kMostFitting = 4096;  // samples a frame

double machine_load() {
  double load = -1.0;
  std::ifstream("/proc/loadavg") >> load;
  return load;
}

// A view of an experiment at one of its values, ready to be measured again and again.
struct OpenView {
  std::size_t experiment = 0, value = 0;
  Stage stage;
  lab::View view;
  std::vector<lab::Reference> references;
  std::vector<lab::Configuration> configurations;
  std::uint64_t scene = 0;
};

Status open_suite_view(OpenView& open, const lab::Experiment& e, const SuiteOptions& o) {
  const lab::SuiteView view = lab::view_at(e, open.value);
  const uvec2 size = lab::size_at(e, open.value);
  StageOptions stage;
  stage.basedir = place_of(view, o.basedir, o.librequake).basedir;
  stage.scene = view.scene;
  stage.map = view.map;
  stage.demo = view.demo;
  stage.camera = view.camera;
  stage.fps = view.frames_per_second;
  stage.size = fmt::format("{}x{}", size.x, size.y);
  stage.device = o.device;
  stage.sets = view.sets;
  stage.quiet = true;
  if (auto status = open_stage(open.stage, stage); !status) return Error{e.name + ": " + status.error().message};
  open.stage.settings.jitter = std::max(open.stage.settings.jitter, 0);
  for (const lab::ExperimentConfiguration& text : e.configurations) {
    auto configuration = configuration_of(open.stage.console(), {text.name, text.sets}, text.name);
    if (!configuration) return Error{fmt::format("{}: {}", e.name, configuration.error().message)};
    configuration->settings.jitter = open.stage.settings.jitter;
    open.configurations.push_back(std::move(*configuration));
  }
  auto collected = lab::collect_view(
      *open.stage.source, {view.first, view.last, view.warmup, e.hold || !view.map.empty(), view.frames_per_second});
  if (!collected) return Error{e.name + ": " + collected.error().message};
  open.view = std::move(*collected);
  for (const scene::FrameSnapshot& snapshot : open.view.snapshots) {
    const std::uint64_t key = lab::content_key(snapshot);
    open.scene = hash_bytes(&key, sizeof key, open.scene);
  }
  const std::uint32_t samples = e.errors ? e.reference_samples : 1;
  auto made = lab::make_references(
      open.view, *open.stage.device, open.stage.settings,
      {e.errors ? e.reference_estimator : "pt", samples, size.x, size.y, e.errors ? o.references : "", o.quiet});
  if (!made) return Error{e.name + ": " + made.error().message};
  open.references = std::move(*made);
  open.stage.renderer.reset();  // each configuration has its own
  return ok_status();
}

Status keep_pictures(const lab::SuiteFolder& folder, const std::string& piece, const OpenView& open,
                     const lab::BenchResult& result) {
  const auto write = [&](const std::string& name, const lab::Picture& picture) {
    lab::ExrImage exr(picture.width, picture.height);
    exr.add_colors("", picture.pixels);
    return lab::write_exr(folder.picture_path(piece, name), exr);
  };
  for (const lab::ConfigurationResult& c : result.configurations)
    if (auto status = write(c.name, c.picture); !status) return status;
  return write("reference", open.references.back().mean);
}

// The first frames of a view, enough to tell how long they take.
lab::View beginning(const lab::View& view) {
  lab::View few = view;
  few.warmup = std::min(view.warmup, 4u);
  few.measured = std::min(view.measured, 4u);
  if (!few.still) few.snapshots.resize(few.frames());
  return few;
}

// Each configuration's samples a frame, so many that its own passes last as long, one at least. The time of a sample
// depends on their number, so what was found is corrected once.
Status fit_to_time(lab::BenchJob& job, OpenView& open, double milliseconds) {
  const lab::View view = beginning(open.view);
  std::vector<lab::Reference> references = open.references;
  if (!view.still) references.resize(view.measured);
  for (lab::Configuration& c : job.configurations) c.settings.spp = 1;
  for (int step = 0; step < 2; ++step) {
    const auto result = lab::run_bench(*open.stage.device, view, references, job);
    if (!result) return result.error();
    for (std::size_t i = 0; i < job.configurations.size(); ++i) {
      render::RenderSettings& settings = job.configurations[i].settings;
      const double took = std::max(result->configurations[i].estimator_passes.median, 1e-6);
      settings.spp = static_cast<int>(std::clamp(std::round(settings.spp * milliseconds / took), 1.0, kMostFitting));
    }
  }
  return ok_status();
}

Status measure_piece(const lab::ExperimentSuite& suite, const lab::Piece& piece, OpenView& open,
                     lab::SuiteFolder& folder) {
  const lab::Experiment& e = suite.experiments[piece.experiment];
  const uvec2 size = lab::size_at(e, piece.value);
  lab::BenchJob job;
  job.configurations = open.configurations;
  for (lab::Configuration& c : job.configurations) c.settings.seed += static_cast<int>(1000 * piece.repeat);
  job.width = size.x;
  job.height = size.y;
  job.quiet = true;
  if (e.vary.of_time())
    if (auto status = fit_to_time(job, open, e.vary.values[piece.value]); !status) return status;
  const auto result = lab::run_bench(*open.stage.device, open.view, open.references, job);
  if (!result) return Error{e.name + ": " + result.error().message};
  const double error = result->reference_mean > 0 ? std::sqrt(result->reference_variance) / result->reference_mean : 0;
  if (e.picture && e.errors && piece.repeat == 0)
    if (auto status = keep_pictures(folder, lab::piece_name(suite, piece), open, *result); !status) return status;
  return folder.add(suite, piece, *result, open.scene, error);
}

// What the command line changes of the suite.
std::string overrides_of(const SuiteOptions& o) {
  return fmt::format("size {}, repeats {}, reference samples {}, set {}", o.size.empty() ? "-" : o.size, o.repeats,
                     o.reference_samples, fmt::join(o.sets, " "));
}

Result<lab::Manifest> manifest_of(const lab::ExperimentSuite& suite, const SuiteOptions& o) {
  gpu::DeviceOptions wanted;
  wanted.preferred = o.device;
  auto device = gpu::Device::create(wanted);
  if (!device) return device.error();
  auto renderer = render::Renderer::create(**device, {});
  if (!renderer) return renderer.error();
  lab::Manifest manifest;
  manifest.suite = fmt::format("{:016x}", suite.hash);
  manifest.program = version_text() + ", " + build_text();
  manifest.device = (*device)->report().name;
  manifest.driver = (*device)->report().driver;
  manifest.intersector = (*renderer)->intersector_name();
  manifest.overrides = overrides_of(o);
  return manifest;
}

std::string command_of(const SuiteOptions& o) {
  std::string command = "fullbright-lab suite " + o.suite + " --out DIR";
  if (!o.size.empty()) command += " --size " + o.size;
  if (o.repeats > 0) command += fmt::format(" --repeats {}", o.repeats);
  if (o.reference_samples > 0) command += fmt::format(" --reference-samples {}", o.reference_samples);
  for (const std::string& set : o.sets) command += " --set " + set;
  return command;
}

int run_suite(SuiteOptions& o) {
  auto suite = read_wanted(o);
  if (!suite) return fail(suite.error());
  const auto shard = parse_shard(o.shard);
  if (!shard) return fail(shard.error());
  if (o.references.empty()) o.references = o.out + "/references";
  set_log_level(LogLevel::kWarning);
  const auto manifest = manifest_of(*suite, o);
  if (!manifest) return fail(manifest.error());
  auto folder = lab::SuiteFolder::open(o.out, *manifest);
  if (!folder) return fail(folder.error());

  std::vector<bool> there(suite->experiments.size(), true);
  for (std::size_t i = 0; i < suite->experiments.size(); ++i) {
    const std::string missing = place_of(suite->experiments[i].view, o.basedir, o.librequake).missing;
    if (missing.empty()) continue;
    there[i] = false;
    folder->skip(suite->experiments[i].name, missing);
    fmt::print(stderr, "{}\n", missing);
  }
  std::vector<lab::Piece> own;
  std::size_t number = 0;
  for (const lab::Piece& piece : lab::pieces_of(*suite))
    if (number++ % shard->count == shard->index - 1 && there[piece.experiment]) own.push_back(piece);
  std::vector<lab::Piece> left;
  for (const lab::Piece& piece : own)
    if (!folder->has(lab::piece_name(*suite, piece))) left.push_back(piece);
  if (left.size() < own.size() && !o.quiet)
    fmt::print(stderr, "{} of {} pieces are there already\n", own.size() - left.size(), own.size());

  std::unique_ptr<OpenView> open;
  {
    Progress progress("piece", left.size(), {.quiet = o.quiet});
    for (std::size_t i = 0; i < left.size(); ++i) {
      const lab::Piece& piece = left[i];
      if (!open || open->experiment != piece.experiment || open->value != piece.value) {
        open = std::make_unique<OpenView>();
        open->experiment = piece.experiment;
        open->value = piece.value;
        if (auto status = open_suite_view(*open, suite->experiments[piece.experiment], o); !status)
          return fail(status.error());
      }
      if (auto status = measure_piece(*suite, piece, *open, *folder); !status) return fail(status.error());
      progress.update(i + 1);
    }
  }
  if (auto status = folder->write_results(*suite, command_of(o), machine_load()); !status) return fail(status.error());
  fmt::print("{}/results.json: {} pieces{}\n", o.out, own.size(),
             shard->count > 1 ? fmt::format(", shard {}; suite-merge joins them", o.shard) : "");
  return 0;
}

}  // namespace

LabCommand add_suite_command(CLI::App& app) {
  auto o = std::make_shared<SuiteOptions>();
  CLI::App* command = app.add_subcommand("suite",
                                         "runs a set of experiments: views, configurations and what is varied, "
                                         "interleaved; started again it goes on where "
                                         "it was interrupted");
  command->add_option("SUITE", o->suite, "the experiments: a JSON file, such as testdemos/suites/quick.json")
      ->required();
  command->add_option("--out", o->out, "folder for the results")->required();
  command->add_option("--experiments", o->experiments, "only these, by their names: cbox,start");
  command->add_option("--size", o->size, "WIDTHxHEIGHT, in the place of the suite's");
  add_number(*command, "--repeats", o->repeats, 0u, 1000u, "runs of each measurement; 0: as the suite says");
  add_number(*command, "--reference-samples", o->reference_samples, 0u, kMostSamples,
             "samples per pixel of references; 0: as the suite says");
  command->add_option("--references", o->references,
                      "folder in which references are kept (default: references in --out)");
  command->add_option("--set", o->sets, "cvar=value, for all; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--shard", o->shard, "I/N: only this of N parts, I from 1; each into a folder of its own");
  command->add_option("--basedir", o->basedir, "the base game's folder, which holds id1; default: beside the program");
  command->add_option("--librequake", o->librequake,
                      "LibreQuake's folder, which holds id1; default: FULLBRIGHT_TEST_DATA, else ../shared/librequake; "
                      "experiments without their data are skipped");
  command->add_option("--device", o->device,
                      "Vulkan device: part of its name, or its index in `fullbright -listdevices`");
  command->add_flag("--quiet", o->quiet, "print no progress");
  return {command, [o] { return run_suite(*o); }};
}

LabCommand add_suite_merge_command(CLI::App& app) {
  struct MergeOptions {
    SuiteOptions suite;
    std::vector<std::string> folders;
  };
  auto o = std::make_shared<MergeOptions>();
  CLI::App* command = app.add_subcommand("suite-merge", "joins the folders that the shards of a suite have written");
  command->add_option("SUITE", o->suite.suite, "the suite's file")->required();
  command->add_option("FOLDERS", o->folders, "the shards' folders")->required();
  command->add_option("--out", o->suite.out, "folder for the joined results")->required();
  command->add_option("--experiments", o->suite.experiments, "as the shards were given it");
  add_number(*command, "--repeats", o->suite.repeats, 0u, 1000u, "as the shards were given it");
  command->add_option("--size", o->suite.size, "as the shards were given it");
  add_number(*command, "--reference-samples", o->suite.reference_samples, 0u, kMostSamples,
             "as the shards were given it");
  command->add_option("--set", o->suite.sets, "as the shards were given it")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  return {command, [o] {
            const auto suite = read_wanted(o->suite);
            if (!suite) return fail(suite.error());
            const auto status =
                lab::merge_shards(*suite, o->folders, o->suite.out, command_of(o->suite), overrides_of(o->suite));
            return status ? 0 : fail(status.error());
          }};
}

}  // namespace fb::host
