// Shows the progress of long work on stderr, with an estimate of the remaining time: on a terminal in one line that is
// rewritten, elsewhere in a new line now and then. Short work shows nothing.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

namespace fb {

struct ProgressOptions {
  bool quiet = false;
  bool lines = false;  // print lines on a terminal too, for work that prints other lines in between
  std::FILE* file = stderr;
  std::function<double()> clock = nullptr;  // seconds; null: the system's clock
};

class Progress {
 public:
  static constexpr double kRewriteSeconds = 0.2, kLineSeconds = 5.0;  // between two updates, and before the first

  // `what` is printed before the numbers: "frame: 3 of 60, 12 s left".
  Progress(std::string what, std::uint64_t total, ProgressOptions options = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void update(std::uint64_t done);
  // Another total, where it turns out on the way.
  void expect(std::uint64_t total) { total_ = total; }

 private:
  std::string what_;
  std::uint64_t total_;
  ProgressOptions options_;
  bool rewrites_;
  bool shown_ = false;
  double start_, last_;
};

}  // namespace fb
