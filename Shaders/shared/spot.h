// Lamps as maps have them: those that shine within a cone alone, and those whose light falls off by another law than
// the square of the distance, which the tools that bake light offer.
#ifndef FB_SHARED_SPOT_H
#define FB_SHARED_SPOT_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// A spot's share of its radiance in a direction of that cosine to its axis: none from `least` on, all up to `full`.
FB_FN float spot_share(float cosine, float least, float full) {
  if (cosine <= least) return 0.0f;
  return cosine >= full ? 1.0f : (cosine - least) / (full - least);
}

// A lamp's light at a distance over what falls off by its square, by the law of a light's "delay"; `scaled`: the
// distance times the law's scale, where both are equal. Linear: 1 - d / range, in halves of the range; it ends there.
// The offset one is 1 / (d + 128)^2.
FB_CONST uint kFallSquare = 0u;
FB_CONST uint kFallLinear = 1u;
FB_CONST uint kFallInverse = 2u;
FB_CONST uint kFallNone = 3u;
FB_CONST uint kFallOffset = 4u;
FB_CONST float kMostScaledFall = 64.0f;  // from there on a light without falloff has the square's again
FB_FN float fall_share(uint law, float scaled) {
  float x = min(scaled, kMostScaledFall);
  if (law == kFallLinear) return x * x * max(2.0f - x, 0.0f);
  if (law == kFallInverse) return x;
  if (law == kFallNone) return x * x;
  if (law == kFallOffset) return 4.0f * x * x / ((x + 1.0f) * (x + 1.0f));
  return 1.0f;
}

FB_NAMESPACE_END
#endif
