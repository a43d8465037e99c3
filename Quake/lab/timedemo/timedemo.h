// Timedemos: the times of every frame of demos that the game played as fast as it could, as its file of them holds
// them (scr_timedemo_json; Misc/docs/formats.md), what they come to, and how two such files differ.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "lab/statistics.h"

namespace fb::lab {

// Of a frame that was drawn, milliseconds.
struct TimedFrame {
  std::uint64_t message = 0;  // of the demo: how many had been read when it was drawn
  double time = 0;            // of the demo's clock, seconds
  double whole = 0;           // since the former frame was shown
  double waited = 0;          // of these the host waited for the device
  double latency = 0;         // from reading the input until the picture was handed to the window
};
struct TimedPass {
  std::string name;
  bool of_estimator = false;
  std::vector<double> milliseconds;  // of each frame, on the device; 0 where it had none
};
struct TimedRun {
  int frames = 0;  // that the classic line counts: neither the first nor the last
  double seconds = 0;
  std::vector<TimedFrame> times;
  std::vector<TimedPass> passes;
  double fps() const { return seconds > 0 ? frames / seconds : 0; }
  // Appends a frame; `passes`: name, whether the estimator's, milliseconds.
  struct PassOfFrame {
    std::string_view name;
    bool of_estimator = false;
    double milliseconds = 0;
  };
  void add(const TimedFrame& frame, const std::vector<PassOfFrame>& passes_of_frame);
};
struct TimedDemo {
  std::string name, hash;  // of its bytes
  std::vector<TimedRun> runs;
};
struct TimedManifest {
  std::string program, build, device, driver, started;
  std::uint32_t width = 0, height = 0, processors = 0;
  std::map<std::string, std::string> settings;  // cvars that differ from their defaults
};
struct Timedemos {
  TimedManifest manifest;
  bool complete = false;  // every demo of the list was played as often as asked
  std::vector<TimedDemo> demos;
  // The demo of that name, which is added if it is new.
  TimedDemo& demo(const std::string& name);
};

constexpr std::size_t kWorstFrames = 10;

// What the frames of a run come to. Percentiles are of the frame's whole time; by linear interpolation.
struct FrameFigures {
  double mean = 0, p1 = 0, p5 = 0, p50 = 0, p95 = 0, p99 = 0, p999 = 0;  // milliseconds
  double low_1 = 0, low_01 = 0;    // frames a second over the slowest 1% and 0.1% of frames, at least one
  std::vector<std::size_t> worst;  // the slowest frames, from the slowest on; no more than kWorstFrames
};
FrameFigures frame_figures(const TimedRun& run);
// Of the frame rate: geometric mean over runs, which has an interval from kFewestSteadyRuns on.
Estimate fps_over_runs(const TimedDemo& demo);
// A line for each demo of several runs or of a list: "hub: 3 runs, 14.1 fps [13.8, 14.4], 1% low 9.9".
std::vector<std::string> timedemo_lines(const Timedemos& timedemos);

std::string timedemos_json(const Timedemos& timedemos);
// Fails with the file and what is wrong in it.
Result<Timedemos> read_timedemos(const std::string& path);

// B against A. Ratios are A's time over B's: above 1, B is faster. Intervals (95%) are over the runs of both files
// (factor_between), from kFewestSteadyRuns of each on.
struct DemoRatio {
  std::string name;
  int frames = 0;
  std::size_t runs_a = 0, runs_b = 0;
  Estimate speed;                                        // of frames, by their whole time
  std::vector<std::pair<std::string, Estimate>> passes;  // time on the device, of passes that both have
};
struct TimedemoComparison {
  std::vector<DemoRatio> demos;
  Estimate speed;                        // geometric mean over demos
  std::size_t runs = 0;                  // of the file and demo that has the fewest
  std::vector<std::string> differences;  // of the manifests: "device: X and Y"
  std::string sentence;
};
// Fails where they are unlike: another demo, another number of frames, incomplete, not the same size.
Result<TimedemoComparison> compare_timedemos(const Timedemos& a, const std::string& name_a, const Timedemos& b,
                                             const std::string& name_b);
std::string comparison_table(const TimedemoComparison& c);
std::string comparison_json(const TimedemoComparison& c);

}  // namespace fb::lab
