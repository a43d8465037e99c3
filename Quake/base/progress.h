// Progress of long work on stderr, with an estimate of what is left: on a terminal one line that is written again and
// again, elsewhere a line now and then. Short work shows nothing.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

namespace fb {

struct ProgressOptions {
  bool quiet = false;
  bool lines = false;  // lines on a terminal, too: where others write between them
  std::FILE* file = stderr;
  std::function<double()> clock = nullptr;  // seconds; absent: the machine's
};

class Progress {
 public:
  static constexpr double kRewriteSeconds = 0.2, kLineSeconds = 5.0;  // between two of a kind, and before the first

  // `what` goes before the numbers: "frame: 3 of 60, 12 s left".
  Progress(std::string what, std::uint64_t total, ProgressOptions options = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void update(std::uint64_t done);

 private:
  std::string what_;
  std::uint64_t total_;
  ProgressOptions options_;
  bool rewrites_;
  bool shown_ = false;
  double start_, last_;
};

}  // namespace fb
