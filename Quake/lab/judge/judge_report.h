// What the judge says: tables for eyes, JSON with everything.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/judge/judge_job.h"

namespace fb::lab {

struct JudgeTitle {
  std::string command, suite, device, references;  // references: "nee, 2048 samples a pixel"
  std::vector<std::string> skipped;                // a sentence a view that could not be judged
  std::vector<std::string> other_curves;           // a sentence a program whose tone curve is another
};

// The heading, a view's table, and the summary over all views, which is told only of more than one.
std::string judge_heading(const JudgeJob& job, const JudgeTitle& title);
std::string view_table(const JudgedView& view, const JudgeJob& job);
std::string summary_table(const std::vector<JudgedView>& views, const JudgeJob& job);
std::string judge_json(const std::vector<JudgedView>& views, const JudgeJob& job, const JudgeTitle& title);

}  // namespace fb::lab
