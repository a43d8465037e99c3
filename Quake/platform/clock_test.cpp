#include "platform/clock.h"

#include <gtest/gtest.h>

namespace fb::platform {
namespace {

TEST(Clock, GoesForwardAndSleepsLongEnough) {
  const double start = now_seconds();
  EXPECT_GE(start, 0.0);
  sleep_seconds(0.02);
  const double after = now_seconds();
  EXPECT_GE(after - start, 0.02);
  EXPECT_LT(after - start, 10.0);
}

TEST(Clock, NegativeSleepsReturnAtOnce) {
  const double start = now_seconds();
  sleep_seconds(-5.0);
  sleep_seconds(0.0);
  EXPECT_LT(now_seconds() - start, 1.0);
}

}  // namespace
}  // namespace fb::platform
