// Debug views: what `r_debug` shows in the place of the picture, by name or by number. A row is a view; its colour is a
// case in passes/debug_view.comp or, for a technique's own, in the technique's step `views`.
//
//   X(constant, number, owner, name, help)
#ifndef FB_SHARED_DEBUG_VIEWS_H
#define FB_SHARED_DEBUG_VIEWS_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// Who draws a view: passes/debug_view.comp, a technique that knows path guiding's views, or passes/debug_view.comp with
// the former frame's G-buffer beside this one's.
FB_CONST uint kViewOfFrame = 0u;
FB_CONST uint kViewOfGuide = 1u;
FB_CONST uint kViewOfFormer = 2u;

// clang-format off
#define FB_DEBUG_VIEWS(X) \
  X(kViewPicture, 0u, kViewOfFrame, "off", "the picture") \
  X(kViewNormal, 1u, kViewOfFrame, "normals", "geometric normals") \
  X(kViewShadingNormal, 2u, kViewOfFrame, "shading_normals", "shading normals") \
  X(kViewAlbedo, 3u, kViewOfFrame, "albedo", "albedo") \
  X(kViewEmission, 4u, kViewOfFrame, "emission", "emission") \
  X(kViewDepth, 5u, kViewOfFrame, "depth", "view depth") \
  X(kViewMotion, 6u, kViewOfFrame, "motion", "motion vectors") \
  X(kViewInstance, 7u, kViewOfFrame, "instances", "instance ids") \
  X(kViewMaterial, 8u, kViewOfFrame, "materials", "material ids") \
  X(kViewGloss, 9u, kViewOfFrame, "gloss", "roughness, specular and metalness") \
  X(kViewRadiance, 10u, kViewOfFrame, "radiance", "this frame's radiance, not accumulated") \
  X(kViewError, 11u, kViewOfFrame, "error", "standard error of the accumulated mean, relative to it") \
  X(kViewDeviation, 12u, kViewOfFrame, "deviation", "denoiser: relative standard deviation of the luminance") \
  X(kViewHistory, 13u, kViewOfFrame, "history", "denoiser: length of the history, logarithmic") \
  X(kViewDisocclusion, 14u, kViewOfFrame, "disocclusion", "denoiser: history that starts in this frame (red), or lately") \
  X(kViewDenoised, 15u, kViewOfFrame, "denoised", "denoiser: filtered irradiance") \
  X(kViewNoisy, 16u, kViewOfFrame, "noisy", "denoiser: irradiance before the filter") \
  X(kViewFormer, 17u, kViewOfFormer, "former", "albedo where the former frame saw each point; red: it did not") \
  X(kViewGuideDirection, 20u, kViewOfGuide, "guide_direction", "path guiding: direction of the strongest lobe") \
  X(kViewGuideCosine, 21u, kViewOfGuide, "guide_cosine", "path guiding: its mean cosine") \
  X(kViewGuideWeight, 22u, kViewOfGuide, "guide_weight", "path guiding: its score") \
  X(kViewGuideSamples, 23u, kViewOfGuide, "guide_samples", "path guiding: samples that it counts") \
  X(kViewGuideLevel, 24u, kViewOfGuide, "guide_level", "path guiding: level of the adaptive grid, and its cells") \
  X(kViewGuideCollisions, 25u, kViewOfGuide, "guide_collisions", "path guiding: hash collisions") \
  X(kViewGuideAge, 26u, kViewOfGuide, "guide_age", "path guiding: frames since the last sample") \
  X(kViewGuideCache, 27u, kViewOfGuide, "guide_cache", "path guiding: the irradiance cache") \
  X(kViewGuideSampler, 28u, kViewOfGuide, "guide_sampler", "path guiding: what was sampled: a lobe, or the BSDF") \
  X(kViewGuideShare, 29u, kViewOfGuide, "guide_share", "path guiding: probability of guiding") \
  X(kViewNotFinite, 30u, kViewOfFrame, "not_finite", "pixels with samples that were not finite, in red") \
  X(kViewGuideIncident, 31u, kViewOfGuide, "guide_incident", "path guiding: light by direction at the picture's middle, and the density it is sampled with") \
  X(kViewGuideCover, 32u, kViewOfGuide, "guide_cover", "path guiding: the sampler's view; linear pictures hold second moments (testdemos/coverage.py)")
// clang-format on

#define FB_VIEW_CONSTANT(constant, number, owner, name, help) FB_CONST uint constant = number;
FB_DEBUG_VIEWS(FB_VIEW_CONSTANT)

FB_NAMESPACE_END
#endif
