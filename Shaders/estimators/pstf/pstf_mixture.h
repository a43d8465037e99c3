// The factor on a control variate that is the difference of a mixture's two densities (Pantaleoni 2020, Eq. 27; Hua
// 2023), learnt from moments.
#ifndef FB_PSTF_MIXTURE_H
#define FB_PSTF_MIXTURE_H
#include "estimators/pstf/pstf.h"
FB_NAMESPACE_BEGIN

// Covariance over variance, nearer to 0 by what chance alone makes of so many samples, and 0 where they are few. Of
// either sign: where the second density alone is in proportion to the light it is minus its share, where the first one
// is it is plus its own. As printed beta is a number of one sign, which mends the one case and spoils the other.
FB_CONST float kMostMixtureBeta = 1.0f;
FB_FN float learnt_mixture_beta(ControlMoments m) {
  if (!(m.samples >= kFewSamples) || !(m.hh > 0.0f)) return 0.0f;
  float chance = sqrt(max(m.gg, 0.0f) * m.hh / m.samples);
  float sure = max(abs(m.gh) - chance, 0.0f) / m.hh;
  return m.gh < 0.0f ? -min(sure, kMostMixtureBeta) : min(sure, kMostMixtureBeta);
}

FB_NAMESPACE_END
#endif
