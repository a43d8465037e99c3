#include "host/lab/judged_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <utility>

#include "base/hash.h"
#include "base/number.h"
#include "host/lab/lab_numbers.h"
#include "lab/content_key.h"
#include "platform/program_directory.h"

namespace fb::host {
namespace {

constexpr const char* kThisProgram = "this";

Result<lab::Lane> lane_of(const ConfigurationText& text, const std::string& name, const lab::Program& program) {
  lab::Lane lane;
  lane.name = program.name == kThisProgram ? name : name + "@" + program.name;
  lane.program = program;
  for (const std::string& assignment : text.assignments) {
    const std::size_t equals = assignment.find('=');
    const std::string cvar = assignment.substr(0, equals), value = assignment.substr(equals + 1);
    if (cvar == "r_estimator") {
      lane.estimator = value;
    } else if (cvar == "r_spp") {
      const auto spp = whole_number_in<std::uint32_t>("--config " + text.name + ": r_spp", value, 1, kMostSamples);
      if (!spp) return spp.error();
      lane.spp = *spp;
    } else {
      lane.sets.push_back(assignment);
    }
  }
  return lane;
}

}  // namespace

Result<std::vector<lab::Program>> open_programs(const std::vector<std::string>& binaries) {
  std::vector<std::pair<std::string, std::string>> wanted{
      {kThisProgram, (platform::program_directory() / "fullbright-lab").string()}};
  for (const std::string& text : binaries) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
      return Error{fmt::format("--binary {}: NAME=PROGRAM is wanted", text)};
    for (const auto& [name, path] : wanted)
      if (name == text.substr(0, equals))
        return Error{fmt::format("--binary {}: there is a program {} already", text, name)};
    wanted.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  std::vector<lab::Program> programs;
  for (auto& [name, path] : wanted) {
    auto program = lab::open_program(name, path);
    if (!program) return program.error();
    programs.push_back(std::move(*program));
  }
  return programs;
}

Result<std::vector<lab::Lane>> lanes_of(const std::vector<ConfigurationText>& texts,
                                        const std::vector<lab::Program>& programs) {
  std::vector<lab::Lane> lanes;
  for (const ConfigurationText& text : texts) {
    const std::size_t at = text.name.find('@');
    const std::string name = text.name.substr(0, at), wanted = at == std::string::npos ? "" : text.name.substr(at + 1);
    bool found = false;
    for (const lab::Program& program : programs) {
      if (!wanted.empty() && program.name != wanted) continue;
      auto lane = lane_of(text, name, program);
      if (!lane) return lane.error();
      lanes.push_back(std::move(*lane));
      found = true;
    }
    if (!found) return Error{fmt::format("--config {}: there is no program {}; --binary names it", text.name, wanted)};
  }
  return lanes;
}

Result<std::vector<std::string>> other_tone_curves(const std::vector<lab::Program>& programs,
                                                   const lab::JudgeJob& job) {
  std::vector<std::string> sentences;
  for (const lab::Program& program : programs) {
    const auto used = [&](const lab::Lane& lane) { return lane.program.name == program.name; };
    if (std::none_of(job.lanes.begin(), job.lanes.end(), used)) continue;
    const auto steps = lab::tone_curve_difference(program, job);
    if (!steps) return steps.error();
    if (*steps > lab::kSameToneCurve)
      sentences.push_back(
          fmt::format("{}: its tone curve differs from this program's, which shows the references, by up to {:.0f} of "
                      "255: its errors contain that",
                      program.name, *steps));
  }
  return sentences;
}

Result<JudgedTruth> find_truth(const lab::SuiteView& view, const std::string& basedir,
                               const std::vector<std::string>& sets, const std::string& device,
                               const lab::JudgedReferenceOptions& wanted) {
  StageOptions options = stage_of(view, basedir, device, {wanted.width, wanted.height});
  options.estimator = wanted.estimator;
  options.sets.insert(options.sets.end(), sets.begin(), sets.end());
  Stage stage;
  if (auto status = open_stage(stage, options); !status) return Error{view.name + ": " + status.error().message};
  const auto collected = lab::collect_view(
      *stage.source,
      {.first = view.first, .last = view.last, .warmup = 0, .hold = false, .frames_per_second = options.fps});
  if (!collected) return Error{view.name + ": " + collected.error().message};
  JudgedTruth truth;
  for (const scene::FrameSnapshot& snapshot : collected->snapshots) {
    const std::uint64_t key = lab::content_key(snapshot);
    truth.scene = hash_bytes(&key, sizeof key, truth.scene);
  }
  auto references = lab::make_judged_references(*collected, *stage.renderer, stage.settings, wanted);
  if (!references) return references.error();
  truth.references = std::move(*references);
  truth.device = stage.device->report().name;
  return truth;
}

std::string scratch_folder() {
  return (std::filesystem::temp_directory_path() / fmt::format("fullbright-picture-{:08x}", std::random_device{}()))
      .string();
}

}  // namespace fb::host
