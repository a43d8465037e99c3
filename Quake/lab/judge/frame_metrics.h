// What the judge measures of frames beyond compare/: the picture as a player sees it (sRGB values as stored, 0 to 1,
// called shown), held to the reference shown by the same exposure and tone curve.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/compare/flicker.h"
#include "lab/compare/metrics.h"
#include "lab/picture.h"

namespace fb::lab {

// The epsilon of relMSE for a picture, radiance squared: (0.1 m)^2, where m is the mean of the reference's channels,
// each cut at the 99th percentile of them all. It goes with the picture's own brightness, so that relMSE does not
// depend on the unit of radiance and stays relative in dark pictures; the cut keeps a lamp of a few pixels, which may
// be a thousand times brighter than what it lights, from setting the scale.
double relative_epsilon(const Picture& reference);

// relMSE without the 0.1% of pixels (kTopPixels) that hold most of it, less the reference's own share in what is left.
// Few pixels of huge weight can rule a mean; this figure they cannot.
double trimmed_rel_mse(const Reference& reference, const Picture& test, double epsilon);

// Radiance as the renderer shows it: times exposure, the tone curve unless it is off, sRGB; no dither.
Picture shown(const Picture& linear, double exposure, bool tone_map);

// Pixels that stand out alone. With luma Y of a shown picture (Rec.709 weights), e = Y - Y of the reference and
// t = kIsolated: a pixel is dark if Y + t is below every one of its up to eight neighbours' Y and e < -t; bright if Y -
// t is above every one of them and e > t. Two wrong pixels side by side are not isolated.
constexpr float kIsolated = 0.06f;
struct IsolatedPixels {
  std::uint32_t dark = 0, bright = 0;
};
IsolatedPixels isolated_pixels(const Picture& reference, const Picture& test);

// Pixels at an edge of what is seen: one of the four neighbours has another id, or the inverse depth, which is linear
// over a plane, bends along a row or a column by more than a tenth of the largest of the three.
std::vector<bool> silhouettes(const Guides& guides);

// Pixels of which neither they nor their eight neighbours are silhouettes or edges of a lamp (emission differs from one
// of four neighbours' by more than a tenth). Radiance before anti-aliasing is of one point in a pixel, the reference of
// all of it: at the edge of a lamp that is the whole error, of every configuration alike, and a thousand times that of
// noise. So linear radiance is judged inside of surfaces, and edges in the shown picture, where they are anti-aliased.
std::vector<bool> interior(const Guides& guides);
Picture pixels_where(const Picture& picture, const std::vector<bool>& chosen);  // in one row
Reference pixels_where(const Reference& reference, const std::vector<bool>& chosen);

// Mean of a map over the chosen pixels; not a number if there is none.
double mean_where(const std::vector<float>& map, const std::vector<bool>& chosen);

// How far a picture is behind light that changes: of what the light of blocks of 8x8 pixels has changed in two frames,
// the share that is missing in the picture: 0 it has followed, 1 it shows what was two frames ago, below 0 it does more
// than the light. Of blocks whose light has changed by more than a quarter, each by how much; not a number if none has.
// All are linear radiance; the camera must stand still.
double lag(const Picture& two_frames_ago, const Picture& now, const Picture& test);

// What the reference's own noise does to FLIP: FLIP of the reference, shown, against itself with one more draw of its
// noise (normal, of its variance, the channels together). Errors of about this size are the reference's.
double reference_flip(const Reference& reference, double exposure, bool tone_map);

}  // namespace fb::lab
