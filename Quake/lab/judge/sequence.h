// A sequence: consecutive frames of a view by one configuration of one program, as that program's `render` command
// writes them. Old and new programs are treated alike: the judge sees nothing but their files and their times.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "lab/judge/suite.h"
#include "lab/picture.h"

namespace fb::lab {

// A fullbright-lab. One that does not know `--format both` renders twice: with the same seed, for linear radiance and
// for the shown picture.
struct Program {
  std::string name, path;
  bool writes_both = true;
};
// Asks the program for its options. Fails if it cannot be run or is no fullbright-lab.
Result<Program> open_program(std::string name, std::string path);

// What is judged.
struct Lane {
  std::string name;
  Program program;
  std::string estimator = "nee";
  std::uint32_t spp = 1;          // samples a pixel and frame
  std::vector<std::string> sets;  // "cvar=value"
};

struct SequenceRequest {
  const Lane* lane = nullptr;
  const SuiteView* view = nullptr;
  std::string basedir, device;  // empty: what the program takes by itself
  std::uint32_t width = 320, height = 180;
  std::vector<std::string> sets;  // for all lanes: exposure, seed ...
  std::string folder;             // for its files; what it leaves there is removed
};

struct PassTimes {  // milliseconds a frame on the device, medians over the sequence
  double gbuffer = 0, paths = 0, denoiser = 0, all = 0;  // paths: all passes of the estimator's, as their kind says
  struct Pass {
    std::string name;
    double milliseconds = 0;
    bool estimators = false;
  };
  std::vector<Pass> passes;
};
// Behind a pass of the estimator's own in a report of times. Programs that say it of none are older: their names tell.
constexpr const char* kEstimatorsPass = ", of the estimator";
struct JudgedFrame {
  Picture shown;                  // sRGB as stored, 0 to 1
  std::optional<Picture> linear;  // radiance before tone mapping; none if it has another size (r_scale)
};
struct Sequence {
  std::vector<JudgedFrame> frames;  // the judged ones
  PassTimes times;
};
using SequenceRunner = std::function<Result<Sequence>(const SequenceRequest&)>;

// Runs the program. Fails if it does, with its last line.
Result<Sequence> run_sequence(const SequenceRequest& request);

// The pieces: arguments of `render` for one format (png, exr, both), and its report of times (`--timing`).
std::vector<std::string> render_arguments(const SequenceRequest& request, const std::string& format);
PassTimes parse_times(const std::string& output);
// Reads what was written into the request's folder.
Result<std::vector<JudgedFrame>> read_frames(const SequenceRequest& request);

}  // namespace fb::lab
