// fullbright-lab track: the player's positions in demos.
#include <fmt/format.h>

#include "fs/file.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/track.h"

namespace fb::host {
namespace {

struct TrackOptions {
  std::string demo, other, csv;
  float tolerance = 0.125f;
  int shift = 0;
};

Result<std::vector<lab::TrackPoint>> open_track(const std::string& path) {
  const auto bytes = fs::read_whole_file(path);
  if (!bytes) return bytes.error();
  return lab::read_track(*bytes, path);
}

int run_track(const TrackOptions& options) {
  const auto track = open_track(options.demo);
  if (!track) return fail(track.error());
  if (!options.csv.empty()) {
    if (auto status = write_text(options.csv, lab::track_csv(*track)); !status) return fail(status.error());
  }
  if (options.other.empty()) {
    if (options.csv != "-") fmt::print("{} points\n", track->size());
    return 0;
  }
  const auto other = open_track(options.other);
  if (!other) return fail(other.error());
  const lab::TrackDifference d = lab::compare_tracks(*track, *other, options.tolerance, options.shift);
  if (d.points == 0) return fail(Error{"track: there is nothing to compare"});
  fmt::print("{} and {} points, {} of them side by side, shifted by {}; furthest apart {} units, at point {}",
             track->size(), other->size(), d.points, d.shift, d.largest, d.at);
  if (!d.within) fmt::print("; over {} from point {} on, time {}", options.tolerance, d.first, (*track)[d.first].time);
  fmt::print("\n");
  return d.within ? 0 : 1;
}

}  // namespace

LabCommand add_track_command(CLI::App& app) {
  auto options = std::make_shared<TrackOptions>();
  CLI::App* track = app.add_subcommand("track",
                                       "prints the player's positions in a demo; compares two demos and exits with 1 "
                                       "if they differ by more than --tolerance");
  track->add_option("DEMO", options->demo, "the demo")->required();
  track->add_option("OTHER", options->other, "another demo of the same script");
  add_number(*track, "--tolerance", options->tolerance, 0.0f, 1e6f, "allowed distance along an axis, units");
  add_number(*track, "--shift", options->shift, 0, 1000000,
             "positions by which OTHER may start earlier or later; the best match is taken");
  track->add_option("--csv", options->csv, "write DEMO's positions to this CSV file; - is standard output");
  return {track, [options] { return run_track(*options); }};
}

}  // namespace fb::host
