#include "host/game/pass_report.h"

#include <gtest/gtest.h>

namespace fb::host {
namespace {

TEST(PassReport, AveragesOverFrames) {
  PassReport report;
  EXPECT_EQ(report.line(), "");
  EXPECT_EQ(report.times_line(), "");
  report.add({{"gbuffer", 2.0, {}}, {"paths", 10.0, {}}}, {20.0, 15.0, 17.0});
  report.add({{"gbuffer", 4.0, {}}, {"paths", 20.0, {}}}, {30.0, 26.0, 29.0});
  EXPECT_EQ(report.line(), "gpu ms a frame: gbuffer 3.00, paths 15.00; 18.00 in all");
  EXPECT_EQ(report.times_line(), "ms a frame: 25.00, of these 4.50 the host's alone; input to picture 23.00");
}

}  // namespace
}  // namespace fb::host
