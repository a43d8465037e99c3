// Debug views: what `r_debug` shows in the place of the picture, by name or by number. A row is a view; its colour is a
// case in passes/debug_view.comp. A technique's own views are rows of its header (estimators/NAME/NAME.h), and the
// technique's step `views` draws them.
//
//   X(constant, number, owner, name, help)
#ifndef FB_SHARED_DEBUG_VIEWS_H
#define FB_SHARED_DEBUG_VIEWS_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// Who draws a view: passes/debug_view.comp, the same with the former frame's G-buffer beside this one's,
// passes/authored_view.comp, or the techniques of a folder, which has a number of its own from kViewOfTechniques on.
FB_CONST uint kViewOfFrame = 0u;
FB_CONST uint kViewOfFormer = 1u;
FB_CONST uint kViewOfTechniques = 2u;
FB_CONST uint kViewOfMap = 1000u;

// clang-format off
#define FB_FRAME_VIEWS(X) \
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
  X(kViewAuthored, 18u, kViewOfMap, "authored", "textures in their baked light, as QuakeSpasm shows a map; models as painted") \
  X(kViewNotFinite, 30u, kViewOfFrame, "not_finite", "pixels with samples that were not finite, in red")
// clang-format on

#define FB_VIEW_CONSTANT(constant, number, owner, name, help) FB_CONST uint constant = number;
FB_FRAME_VIEWS(FB_VIEW_CONSTANT)

FB_NAMESPACE_END
#endif
