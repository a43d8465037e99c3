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
#include "fs/file.h"
#include "host/build_text.h"
#include "host/lab/judged_view.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "host/options.h"
#include "host/lab/suite_view.h"

namespace fb::host {
namespace {

constexpr const char* kOfTheSuite = "as the suite says";  // the default of what changes it

// The suite with what the command line changes, and which of its experiments are asked for.
struct Wanted {
  lab::ExperimentSuite suite;
  std::vector<bool> chosen;
};

Result<Wanted> read_wanted(const SuiteOptions& o) {
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
  std::vector<bool> chosen;
  for (const lab::Experiment& e : suite->experiments)
    chosen.push_back(names.empty() || std::ranges::find(names, e.name) != names.end());
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
  return Wanted{std::move(*suite), std::move(chosen)};
}

lab::ExperimentSuite only(lab::ExperimentSuite suite, const std::vector<bool>& chosen) {
  std::vector<lab::Experiment> kept;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) kept.push_back(std::move(suite.experiments[i]));
  suite.experiments = std::move(kept);
  return suite;
}

// Without the experiments of which nothing is asked for or there.
lab::ExperimentSuite suite_of_results(const Wanted& wanted, const lab::SuiteFolder& folder) {
  std::vector<bool> told = wanted.chosen;
  for (const lab::Piece& piece : lab::pieces_of(wanted.suite))
    if (folder.has(lab::piece_name(wanted.suite, piece))) told[piece.experiment] = true;
  return only(wanted.suite, told);
}

double machine_load() {
  double load = -1.0;
  std::ifstream("/proc/loadavg") >> load;
  return load;
}

// What the command line changes of the suite.
std::string overrides_of(const SuiteOptions& o) {
  std::string text = fmt::format("size {}, repeats {}, reference samples {}, set {}", o.size.empty() ? "-" : o.size,
                                 o.repeats, o.reference_samples, fmt::join(o.sets, " "));
  for (const std::string& binary : o.binaries) {  // by what it is, not where
    const std::size_t equals = std::min(binary.find('='), binary.size());
    const auto bytes = fs::read_whole_file(binary.substr(std::min(equals + 1, binary.size())));
    text += fmt::format(", binary {} {:016x}", binary.substr(0, equals),
                        bytes ? hash_bytes(bytes->data(), bytes->size()) : 0);
  }
  return text;
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
  for (const std::string& binary : o.binaries) command += " --binary " + binary;
  return command;
}

Status measure(const lab::ExperimentSuite& suite, const std::vector<lab::Piece>& pieces, lab::SuiteFolder& folder,
               const SuiteOptions& o) {
  std::vector<lab::Program> programs;
  if (std::ranges::any_of(suite.experiments, &lab::Experiment::judged)) {
    auto opened = open_programs(o.binaries);
    if (!opened) return opened.error();
    programs = std::move(*opened);
  }
  std::unique_ptr<OpenView> open;
  lab::Piece opened;
  Progress progress("piece", pieces.size(), {.quiet = o.quiet});
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const lab::Piece& piece = pieces[i];
    if (!open || opened.experiment != piece.experiment || opened.value != piece.value) {
      open.reset();  // before the next one takes memory
      auto made = open_suite_view(suite.experiments[piece.experiment], piece.value, programs, o);
      if (!made) return made.error();
      open = std::move(*made);
      opened = piece;
    }
    const std::string name = lab::piece_name(suite, piece);
    const auto json = open->measure(piece, name, folder);
    if (!json) return json.error();
    if (auto status = folder.add(name, *json); !status) return status;
    progress.update(i + 1);
  }
  return ok_status();
}

int run_suite(SuiteOptions& o) {
  const auto wanted = read_wanted(o);
  if (!wanted) return fail(wanted.error());
  const lab::ExperimentSuite* suite = &wanted->suite;
  const auto shard = parse_shard(o.shard);
  if (!shard) return fail(shard.error());
  if (o.references.empty()) o.references = o.out + "/references";
  set_log_level(LogLevel::kWarning);
  const auto manifest = manifest_of(*suite, o);
  if (!manifest) return fail(manifest.error());
  auto folder = lab::SuiteFolder::open(o.out, *manifest);
  if (!folder) return fail(folder.error());

  std::vector<bool> there = wanted->chosen;
  for (std::size_t i = 0; i < suite->experiments.size(); ++i) {
    if (!there[i]) continue;
    const std::string missing = place_of(suite->experiments[i].view, o.basedir, o.librequake).missing;
    if (missing.empty()) continue;
    there[i] = false;
    folder->skip(suite->experiments[i].name, missing);
    fmt::print(stderr, "{}\n", missing);
  }
  std::vector<lab::Piece> own;
  std::size_t number = 0;
  for (const lab::Piece& piece : lab::pieces_of(*suite))
    if (wanted->chosen[piece.experiment] && number++ % shard->count == shard->index - 1 && there[piece.experiment])
      own.push_back(piece);
  std::vector<lab::Piece> left;
  for (const lab::Piece& piece : own)
    if (!folder->has(lab::piece_name(*suite, piece))) left.push_back(piece);
  if (left.size() < own.size() && !o.quiet)
    fmt::print(stderr, "{} of {} pieces are there already\n", own.size() - left.size(), own.size());

  if (auto status = measure(*suite, left, *folder, o); !status) return fail(status.error());
  // What an earlier run measured stays in the results.
  if (auto status = folder->write_results(suite_of_results(*wanted, *folder), command_of(o), machine_load()); !status)
    return fail(status.error());
  fmt::print("{}/results.json: {} pieces{}\n", o.out, own.size(),
             shard->count > 1 ? fmt::format(", shard {}; suite-merge joins them", o.shard) : "");
  return 0;
}

void add_binaries(CLI::App& app, std::vector<std::string>& binaries, const std::string& help) {
  app.add_option("--binary", binaries, "NAME=PROGRAM: " + help + "; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
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
  add_number(*command, "--repeats", o->repeats, 1u, 1000u, "runs of each measurement")->default_str(kOfTheSuite);
  add_number(*command, "--reference-samples", o->reference_samples, 1u, kMostSamples, "samples per pixel of references")
      ->default_str(kOfTheSuite);
  command->add_option("--references", o->references,
                      "folder in which references are kept (default: references in --out)");
  command->add_option("--set", o->sets, "cvar=value, for all; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  add_binaries(*command, o->binaries, "another fullbright-lab, for configurations NAME@THAT of judged pictures");
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
  add_number(*command, "--repeats", o->suite.repeats, 1u, 1000u, "as the shards were given it")
      ->default_str(kOfTheSuite);
  command->add_option("--size", o->suite.size, "as the shards were given it");
  add_number(*command, "--reference-samples", o->suite.reference_samples, 1u, kMostSamples,
             "as the shards were given it")
      ->default_str(kOfTheSuite);
  command->add_option("--set", o->suite.sets, "as the shards were given it")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  add_binaries(*command, o->suite.binaries, "as the shards were given it");
  return {command, [o] {
            const auto wanted = read_wanted(o->suite);
            if (!wanted) return fail(wanted.error());
            const lab::ExperimentSuite suite = only(wanted->suite, wanted->chosen);
            const auto status =
                lab::merge_shards(suite, o->folders, o->suite.out, command_of(o->suite), overrides_of(o->suite));
            return status ? 0 : fail(status.error());
          }};
}

}  // namespace fb::host
