// Where the light of a frame is not that of the frames before it: asked of tiles of pixels, since a pixel's own samples
// scatter too much to tell, and of tiles together with those about them. What a tile's samples differ from the means of
// the last frames is held against what it would differ by chance (a test of means; the idea of Schied 2018, "Gradient
// Estimation for Real-Time Adaptive Temporal Filtering", but no sample is traced twice).
#ifndef FB_SHARED_LIGHT_CHANGE_H
#define FB_SHARED_LIGHT_CHANGE_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kChangeTile = 16u;           // pixels a side
FB_CONST float kRememberedFrames = 19.0f;  // that the mean of the last frames counts as (r_svgf_moments_alpha 0.1)
FB_CONST float kLeastKept = 0.01f;         // frames: of a history that is gone
FB_CONST float kInterpolated = 2.25f;  // variance of a sample over that of what is interpolated from four, in the mean

// Sums over samples: of luminance less the mean of the last frames there; of its square; of those means; of the
// variance of a sample by the last frames; of their number, one less than which they are divided by; and of samples.
struct ChangeSums {
  float difference, square, level, variance, remembered, samples;
};
FB_CONST uint kChangeWords = 8u;  // a tile: the sums, and what of the history is kept

FB_FN ChangeSums change_sum(ChangeSums a, ChangeSums b, float share) {
  ChangeSums s;
  s.difference = a.difference + share * b.difference;
  s.square = a.square + share * b.square;
  s.level = a.level + share * b.level;
  s.variance = a.variance + share * b.variance;
  s.remembered = a.remembered + share * b.remembered;
  s.samples = a.samples + share * b.samples;
  return s;
}

// What of the history is to be kept where samples differ so: 1 where that may be chance (three standard deviations and
// 3% of the light), 0 where it is not (a third more).
FB_FN float kept_of_change(ChangeSums s) {
  if (s.samples < 4.0f) return 1.0f;
  float scattered = max(s.square - s.difference * s.difference / s.samples, 0.0f);
  float frames = max(s.remembered / s.samples, 1.0f);
  float deviation = sqrt(max(s.variance * (1.0f + 1.0f / frames), scattered));  // of the difference
  float level = max(abs(s.level), abs(s.level + s.difference));
  float off = abs(s.difference) / (3.0f * deviation + 0.03f * level + 1e-6f * s.samples);
  return clamp(4.0f - 3.0f * off, 0.0f, 1.0f);
}

FB_NAMESPACE_END
#endif
