// ReSTIR (Bitterli 2020; Wyman and Panteleev 2021; Lin 2022): what its techniques keep, what can be set, what they
// show.
#ifndef FB_RESTIR_H
#define FB_RESTIR_H
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/reservoir.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

// Arrays: X(constant, binding, what there is one element of, bytes of one, two halves, name).
//
// Reservoirs: uvec4 of a pixel at which light is sampled (steps/light_sample.glsl): the sample's name and place, W, and
// in halves its confidence and its age in frames. The former frame's are kept. Merged: those of this frame that new
// candidates and the former frame gave, before neighbours are asked. Final: by which light is looked for.
#define FB_RESTIR_ARRAYS(X)                                                \
  X(kRestirReservoirs, 3u, kPixel, 16u, true, "reservoirs of light")       \
  X(kRestirMerged, 4u, kPixel, 16u, false, "reservoirs before neighbours") \
  X(kRestirFinal, 5u, kPixel, 16u, false, "reservoirs that light is asked of")
FB_RESTIR_ARRAYS(FB_ARRAY_CONSTANT)

// Of restir_gi besides: uvec4[2] of a pixel. Reservoirs of light of two reflections (steps/indirect_sample.glsl);
// fresh: what this frame's paths found of it (steps/fresh.glsl), then reservoirs before neighbours are asked.
#define FB_RESTIR_INDIRECT_ARRAYS(X)                                                  \
  X(kRestirIndirect, 6u, kPixel, 32u, true, "reservoirs of light of two reflections") \
  X(kRestirFresh, 7u, kPixel, 32u, false, "samples of light of two reflections")
FB_RESTIR_INDIRECT_ARRAYS(FB_ARRAY_CONSTANT)

// clang-format off
#define FB_RESTIR_SETTINGS(X) \
  X(float, restir_history, "r_restir_history", 20, 0, 1000, "restir: frames of candidates that the former frame's reservoir counts as, at most; 0: nothing is reused over time") \
  X(int, restir_neighbors, "r_restir_neighbors", 3, 0, 8, "restir: neighbours whose reservoirs a pixel reuses") \
  X(float, restir_radius, "r_restir_radius", 30, 1, 200, "restir: how far away they are at most, pixels of a picture of 1080 rows") \
  X(int, restir_mis, "r_restir_mis", 0, 0, 1, "restir: weights of what is reused for the light that first vertices look for: 0 by targets, unbiased; 1 by confidence alone (1/M), biased: dark where light comes into sight") \
  X(int, restir_visibility, "r_restir_visibility", 0, 0, 2, "restir: 1 a ray drops candidates that do not arrive before they are reused, biased: what one pixel's candidates do not see is lost to others; 2 rays ask so wherever a sample is weighed, unbiased where nothing moves and nothing is translucent") \
  X(float, restir_boiling, "r_restir_boiling", 0, 0, 64, "restir: reservoirs are emptied whose W is more than so many times the mean of those in their square of 8x8 pixels (restir_gi: of light of two reflections, too), biased: dark; 0: none is") \
  X(int, restir_duplicates, "r_restir_duplicates", 0, 0, 1, "restir: 1 a history that pixels about it have as well counts as less, biased: confidence hangs on what a sample is") \
  X(int, restir_permute, "r_restir_permute", 0, 0, 1, "restir: 1 a pixel takes the history of one beside it, of another each frame, so that neighbours' samples are less alike") \
  X(int, restir_candidates, "r_restir_candidates", 0, 0, 2, "restir: new candidates: 0 of the list, whose light is shared with scattered rays; 1 what scattered rays meet, one a path; 2 both, by MIS: 1 and 2 are unbiased as r_restir_visibility 2 is, and biased without it") \
  X(int, restir_sets, "r_restir_sets", 2, 1, 32, "restir: how many times r_nee_candidates lights a pixel's first vertex draws of the list") \
  X(float, restir_trust, "r_restir_trust", 32, 0.01f, 1e6f, "restir: how many times a frame's candidates a reservoir is thought to stand for, where it shares light with scattered rays") \
  X(int, restir_hope, "r_restir_hope", 1, 0, 1, "restir: 1 which sample a reservoir keeps is chosen by what past rays let hope to arrive, too") \
  X(float, restir_gi_history, "r_restir_gi_history", 20, 0, 1000, "restir_gi: frames that the former frame's reservoir of light of two reflections counts as, at most; 0: none is reused over time") \
  X(int, restir_gi_neighbors, "r_restir_gi_neighbors", 1, 0, 8, "restir_gi: neighbours whose reservoirs of such light a pixel reuses") \
  X(int, restir_gi_visibility, "r_restir_gi_visibility", 1, 0, 1, "restir_gi: 1 MIS weights ask by rays whether another vertex sees a sample, unbiased where nothing moves and nothing is translucent; 0 they do not, biased: up to 1% too dark where seen") \
  X(int, restir_gi_radiance, "r_restir_gi_radiance", 0, 0, 1, "restir_gi: 1 samples keep the light that their second vertex sent to where they were found, and all viewers see that, biased where it has a coat, and late where light changes (Ouyang 2021)") \
  X(int, restir_teach, "r_restir_teach", 1, 0, 1, "restir_guided: 1 what a pixel's reservoir of light of two reflections held teaches a lobe, too") \
  X(int, restir_keep, "r_restir_keep", 1, 0, 1, "restir: what the next frame finds: 1 what neighbours gave, too; 0 a pixel's own history alone")
// clang-format on

// Debug views.
FB_CONST uint kViewOfRestir = kViewOfTechniques + 1u;
// clang-format off
#define FB_RESTIR_VIEWS(X) \
  X(kViewRestirAge, 33u, kViewOfRestir, "restir_age", "restir: frames since a reservoir's sample was drawn, of 64; green: this frame's") \
  X(kViewRestirConfidence, 34u, kViewOfRestir, "restir_confidence", "restir: confidence of reservoirs, of 64 frames of candidates") \
  X(kViewRestirLamp, 35u, kViewOfRestir, "restir_lamp", "restir: the lamp or sun that a reservoir holds, a colour each; black: none, grey: the pixel does not reuse") \
  X(kViewRestirWeight, 36u, kViewOfRestir, "restir_weight", "restir: W, one over the density of a reservoir's sample, by its logarithm")
// clang-format on
FB_RESTIR_VIEWS(FB_VIEW_CONSTANT)

// Where they begin in the technique's uniform block, bytes: behind those of a technique that reuses besides.
FB_CONST uint kRestirConstantsAt = 1024u;
struct RestirConstants {
  FB_RESTIR_SETTINGS(FB_UNIFORM_FIELD)
  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)
  uint seen_stride;      // of this many shadow rays one is remembered; a power of two
  uint seen_ways;        // the table of ways that is read, 0 or 1
  uint now, former;      // where the halves of the reservoirs begin, elements; former kNoIndex: there are none
  uint former_indirect;  // the same of those of two reflections, which a frame of one reflection does not write
  uint former_suns;      // bit i: sun i shone in the former frame, where it is now
};

FB_NAMESPACE_END
#endif
