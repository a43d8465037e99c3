#include "base/progress.h"

#include <gtest/gtest.h>

#include <array>

namespace fb {
namespace {

struct Printed {
  std::FILE* file = std::tmpfile();
  double now = 0.0;
  ~Printed() { std::fclose(file); }
  ProgressOptions options() {
    return {.file = file, .clock = [this] { return now; }};
  }
  std::string text() const {
    std::rewind(file);
    std::array<char, 4096> bytes{};
    return std::string(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file));
  }
};

TEST(Progress, ALineEveryFewSecondsSaysWhatIsLeft) {
  Printed printed;
  Progress progress("second", 100, printed.options());
  for (int i = 1; i <= 12; ++i) {
    printed.now = i;
    progress.update(static_cast<std::uint64_t>(i));
  }
  EXPECT_EQ(printed.text(), "second: 5 of 100, 95 s left\nsecond: 10 of 100, 90 s left\n");
}

TEST(Progress, ShortWorkAndQuietWorkShowNothing) {
  Printed printed;
  Progress brief("second", 2, printed.options());
  printed.now = 4.9;
  brief.update(2);
  ProgressOptions quiet = printed.options();
  quiet.quiet = true;
  Progress silent("second", 2, quiet);
  printed.now = 100.0;
  silent.update(1);
  EXPECT_EQ(printed.text(), "");
}

}  // namespace
}  // namespace fb
