#include "host/pass_report.h"

#include <gtest/gtest.h>

namespace fb::host {
namespace {

TEST(PassReport, AveragesOverFrames) {
  PassReport report;
  EXPECT_EQ(report.line(), "");
  report.add({{"gbuffer", 2.0, {}}, {"paths", 10.0, {}}});
  report.add({{"gbuffer", 4.0, {}}, {"paths", 20.0, {}}});
  EXPECT_EQ(report.line(), "gpu ms a frame: gbuffer 3.00, paths 15.00; 18.00 in all");
}

}  // namespace
}  // namespace fb::host
