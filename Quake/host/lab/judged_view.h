// Shared by the commands that judge the picture that a player sees (picture, suite): programs, lanes and references.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "host/lab/lab_stage.h"
#include "lab/judge/judge_job.h"

namespace fb::host {

// This program and those that `--binary NAME=PROGRAM` names, which cannot be called `this`.
Result<std::vector<lab::Program>> open_programs(const std::vector<std::string>& binaries);
// A configuration NAME@PROGRAM is of that program; NAME alone of every program, and named so for this one.
Result<std::vector<lab::Lane>> lanes_of(const std::vector<ConfigurationText>& texts,
                                        const std::vector<lab::Program>& programs);
// One sentence for each program that shows radiance by another tone curve than this one, which shows the references.
Result<std::vector<std::string>> other_tone_curves(const std::vector<lab::Program>& programs, const lab::JudgeJob& job);

struct JudgedTruth {
  std::vector<lab::JudgedReference> references;
  std::string device;
  std::uint64_t scene = 0;  // hash of what is seen in the judged frames
};
// Makes or finds the references of a view; `sets` are "cvar=value" of all lanes.
Result<JudgedTruth> find_truth(const lab::SuiteView& view, const std::string& basedir,
                               const std::vector<std::string>& sets, const std::string& device,
                               const lab::JudgedReferenceOptions& wanted);

// A folder of its own for the frames of a sequence, which are removed when they have been read.
std::string scratch_folder();

}  // namespace fb::host
