// A view of a suite, opened once and measured again and again: raw samples held to a reference, or judged pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/judge/sequence.h"
#include "lab/suite/suite_results.h"

namespace fb::host {

struct SuiteOptions {
  std::string suite, out, basedir, librequake, size, device, shard, references;
  std::vector<std::string> experiments, sets, binaries;
  std::uint32_t repeats = 0, reference_samples = 0;
  bool quiet = false;
};

class OpenView {
 public:
  OpenView() = default;
  OpenView(const OpenView&) = delete;
  OpenView& operator=(const OpenView&) = delete;
  virtual ~OpenView() = default;
  // The piece of this name, as its file says it; its pictures are written beside that.
  virtual Result<lab::Json> measure(const lab::Piece& piece, const std::string& name,
                                    const lab::SuiteFolder& folder) = 0;
};

// At one of its values; its references are made or found. The experiment must outlive it. `programs`: those that may
// make judged pictures.
Result<std::unique_ptr<OpenView>> open_suite_view(const lab::Experiment& experiment, std::size_t value,
                                                  const std::vector<lab::Program>& programs,
                                                  const SuiteOptions& options);

}  // namespace fb::host
