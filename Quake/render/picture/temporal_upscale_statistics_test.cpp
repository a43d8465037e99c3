// A picture that is rendered smaller and scaled up over time (r_scale with r_taa): what it gains over many frames.
#include <gtest/gtest.h>

#include <string>

#include "render/picture/test_temporal_upscale.h"

namespace fb::render {
namespace {

using TemporalUpscaleStatistics = TemporalUpscaleTest;

TEST_F(TemporalUpscaleStatistics, AStillPictureGainsWhatItsPixelsLack) {
  const double whole = error_of(settings_for(1), 40, 0), scaled = error_of(settings_for(0.5f), 40, 0);
  const double bilinear = error_of(of_one_frame(0.5f), 4, 0);
  EXPECT_LT(whole, scaled);
  EXPECT_LT(scaled, 0.45 * bilinear);
  RecordProperty("whole", std::to_string(whole));
  RecordProperty("scaled", std::to_string(scaled));
  RecordProperty("bilinear", std::to_string(bilinear));
}

TEST_F(TemporalUpscaleStatistics, MotionCarriesIt) {
  for (const float scale : {0.37f, 0.67f}) {
    const double scaled = error_of(settings_for(scale), 40, 1), bilinear = error_of(of_one_frame(scale), 4, 1);
    EXPECT_LT(scaled, 0.55 * bilinear) << scale;
  }
}

}  // namespace
}  // namespace fb::render
