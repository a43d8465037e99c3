// A suite's results on disk: a folder with what was measured with (manifest.json), a file for each piece (pieces/), and
// all of it in one (results.json, results.csv), which is made of the former alone: resumed, sharded and merged runs
// give the same. Misc/docs/formats.md has the members.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "lab/json_reader.h"
#include "lab/suite/experiment.h"

namespace fb::lab {

// What results must have in common to be compared. Members in the order in which a difference is told.
struct Manifest {
  std::string suite, program, device, driver, intersector, overrides;
  bool operator==(const Manifest&) const = default;
};

class SuiteFolder {
 public:
  // Opens or begins a folder. Fails if it cannot be written, or holds results of something else, and says of what.
  static Result<SuiteFolder> open(const std::string& path, const Manifest& manifest);
  // Of results that are there.
  static Result<SuiteFolder> existing(const std::string& path);

  const std::string& path() const { return path_; }
  const Manifest& manifest() const { return manifest_; }
  bool has(const std::string& piece) const;
  // A piece by its name. Written at once or not at all.
  Status add(const std::string& piece, const Json& json) const;
  void skip(const std::string& experiment, const std::string& why) { skipped_.emplace_back(experiment, why); }
  // results.json and results.csv of all pieces that are there.
  Status write_results(const ExperimentSuite& suite, const std::string& command, double load) const;
  Result<Json> piece(const std::string& name) const;
  std::vector<std::string> piece_names() const;
  Status copy_from(const SuiteFolder& other, const std::string& piece) const;
  std::string picture_path(const std::string& piece, const std::string& configuration) const;

 private:
  std::string path_;
  Manifest manifest_;
  std::vector<std::pair<std::string, std::string>> skipped_;
};

// Joins what shards have made into `to`. Fails where they differ, where a piece is there twice and where one is
// missing, and names it.
// `overrides`: Manifest's; where it or the suite is not what the pieces were measured by, that is refused, too.
Status merge_shards(const ExperimentSuite& suite, const std::vector<std::string>& folders, const std::string& to,
                    const std::string& command, const std::string& overrides);

}  // namespace fb::lab
