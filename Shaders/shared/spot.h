// Lamps that shine within a cone alone.
#ifndef FB_SHARED_SPOT_H
#define FB_SHARED_SPOT_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// A spot's share of its radiance in a direction of that cosine to its axis: none from `least` on, all up to `full`.
FB_FN float spot_share(float cosine, float least, float full) {
  if (cosine <= least) return 0.0f;
  return cosine >= full ? 1.0f : (cosine - least) / (full - least);
}

FB_NAMESPACE_END
#endif
