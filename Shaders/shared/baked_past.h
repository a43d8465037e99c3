// A past for a frame that has none (a map's first, a cut): what the map's baked light says of a point counts as so many
// frames of history. The denoised picture alone has it, and forgets it as frames come.
#ifndef FB_SHARED_BAKED_PAST_H
#define FB_SHARED_BAKED_PAST_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kNoBakedPast = 0xffffffffu;  // in the place of pack_rgb9e5: no baked light is known here
FB_CONST float kBakedVariance = 2.0f;  // of a frame's samples about it, relative to its square: what a filter is told
FB_CONST uint kBakedTrust = 32u;       // frames, for which the filter is told so

// Irradiance (of which a surface of albedo 1 reflects as much radiance) where a display shows a texture times `luxels`,
// without the even light that is added unfiltered. `gain`: the map's field of factors there, which is a factor on
// albedo.
FB_FN vec3 baked_irradiance(vec3 luxels, vec3 gain, vec3 even) {
  vec3 shown = vec3(pow(luxels.x, 2.2f), pow(luxels.y, 2.2f), pow(luxels.z, 2.2f));
  return max(shown / max(gain, vec3(1e-3f)) - even, vec3(0.0f));
}

// Variance of a sample where `past` of `frames` are of baked light `y`, and the others say `variance`: few of them tell
// little.
FB_FN float variance_with_past(float variance, float y, float frames, float past) {
  float share = min(past / max(frames, 1.0f), 1.0f);
  return variance + share * (kBakedVariance * y * y - variance);
}

// Where samples find the map brighter or darker than it was baked, all about a pixel, baked light is made so, too. Sums
// over pixels: luminance of samples, of baked light, of samples squared.
struct BakedSums {
  float samples, baked, squares;
};
FB_CONST float kBakedSpread = 0.09f;     // variance of the factor's logarithm over places of a map
FB_CONST float kBakedCorrelated = 4.0f;  // pixels that have one sample's light between them, about
FB_CONST float kMostBakedFactor = 8.0f;
// The factor: as far from 1 as the samples' own noise lets it be told.
FB_FN float baked_factor(BakedSums s) {
  if (!(s.baked > 0.0f) || !(s.samples > 0.0f)) return 1.0f;
  float noise = kBakedCorrelated * s.squares / (s.samples * s.samples), told = kBakedSpread / (kBakedSpread + noise);
  return clamp(float(pow(s.samples / s.baked, told)), 1.0f / kMostBakedFactor, kMostBakedFactor);
}

// This frame's share beside `past` frames: it counts as `frames`.
FB_FN float share_beside_past(float frames, float past) { return frames / (frames + past); }

FB_NAMESPACE_END
#endif
