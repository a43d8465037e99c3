// Progressive spatio-temporal filtering (Pantaleoni 2020): fields of light in a hash grid, what its techniques keep,
// what can be set, what they show, and the arithmetic of cells and control variates, for C++ too. Equations are
// numbered as in the paper.
#ifndef FB_PSTF_H
#define FB_PSTF_H
#include "estimators/pstf/pstf_change.h"
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

// A cell: seven texels of four words.
//   0: GridKey::check (0: empty), the frame that last taught it, samples of that frame, samples of all before (Eq. 11)
//   1: outgoing light: mean luminance, and mean of luminance times the normal
//   2: Co and Cg of outgoing light, Co and Cg of incident light
//   3: incident light: mean luminance, and mean of luminance times its direction
//   4: mean normal; how many samples the moments are worth
//   5: moments of the control variate (ControlMoments); second moment of outgoing light
//   6: straight part of outgoing light: mean luminance; its part of the world (region_word)
// The two fields are 24 bytes each (Section 2.6). Outgoing light is without what the surface emits, and over its
// reflectance: of a Lambert surface that is irradiance over pi, and textures do not blur. Incident light is that
// of paths' own directions, weighed as a white Lambert surface reflects it: what light that is looked for leaves.
FB_CONST uint kPstfCellWords = 28u;
// What a frame's samples add up to in a cell, in fixed point: outgoing light (6 words as above), normal (3), incident
// light (6), moments (3), second moment of outgoing light (1), samples with a direction (1), straight part of outgoing
// light (1); and the part of the world, which is no sum.
FB_CONST uint kPstfSumWords = 22u;
FB_CONST uint kPstfSumNormal = 6u, kPstfSumIncident = 9u, kPstfSumMoments = 15u, kPstfSumSecond = 18u,
              kPstfSumDirected = 19u, kPstfSumStraight = 20u, kPstfSumRegion = 21u;
FB_CONST uint kPstfClaimed = 0x80000000u;  // beside a cell's samples: another cell wants its place
FB_CONST uint kPstfTailWords = 4u + 2u * kAllRegions * kRegionWords;

// Arrays: X(constant, binding, what there is one element of, bytes of one, two halves, name). Sums: of all cells the
// samples of this frame, then the largest check that wants the cell, then what samples add up to, then the list of
// cells that have any of these; behind all kPstfTailWords: two that in turns count the
// list, two that say whether light changed, and in turns the sums of parts of the world.
#define FB_PSTF_ARRAYS(X)                                                               \
  X(kPstfCells, 5u, kTable, 4u * kPstfCellWords, false, "cells of the field")           \
  X(kPstfSums, 6u, kTable, 4u * (kPstfSumWords + 3u), false, "a frame's sums of cells") \
  X(kPstfTrees, 0u, kTable, 128u, false, "trees of cells")                              \
  X(kPstfTreeSums, 1u, kTable, 64u, false, "a frame's sums of their leaves")            \
  X(kPstfGaussians, 2u, kTable, 32u, false, "Gaussians of cells")                       \
  X(kPstfGaussianSums, 3u, kTable, 32u, false, "sums of what taught them")              \
  X(kPstfSamples, 4u, kTable, 128u, false, "a frame's samples of cells")
FB_PSTF_ARRAYS(FB_ARRAY_CONSTANT)

// `mcpg_cv` has the cells, too: their bindings are behind those of mcpg's arrays, and the block is so far behind its
// block's start, whatever else stands there.
FB_CONST uint kPstfConstantsAt = 1024u;

// Specialisation constants.
FB_CONST uint kSpecSweeps = kSpecTechnique;          // of the pass of changes: it has what no sample came to follow
FB_CONST uint kSpecTrees = kSpecTechnique;           // of the pass that folds: cells have trees
FB_CONST uint kSpecEndsInField = kSpecTechnique;     // of paths: they may end in the field
FB_CONST uint kSpecGaussians = kSpecTechnique + 1u;  // of a cell's mixture, 4 or 8; 0: cells have trees or nothing
FB_CONST uint kSpecTwoLevel = kSpecTechnique + 1u;   // of paths without trees: the integral is estimated
FB_CONST uint kSpecLaneOfSample = kSpecTechnique;    // of the pass that learns mixtures: a lane has a sample

// clang-format off
#define FB_PSTF_SETTINGS(X) \
  X(int, pstf_cells, "r_pstf_cells", 131072, 1024, 1048576, "pstf: cells of the field, 212 bytes each; rounded up to a power of two") \
  X(float, pstf_pixels, "r_pstf_pixels", 16, 0, 256, "pstf: least width of a cell, pixels") \
  X(float, pstf_angle, "r_pstf_angle", 1.2f, 0.01f, 45, "pstf: angle that a cell subtends at the camera at least, degrees") \
  X(float, pstf_spread, "r_pstf_spread", 0.1f, 0, 1, "pstf: width of a cell over the length of the ray that reached it, at least: the footprint of scattered light") \
  X(int, pstf_key, "r_pstf_key", 0, 0, 1, "pstf: what cells at one place are told apart by: 0 the surface's normal (Binder 2018), 1 the direction of outgoing light (Pantaleoni 2020)") \
  X(int, pstf_directions, "r_pstf_directions", 1, 1, 8, "pstf: with r_pstf_key 1, parts of a cube's edge that tell directions apart: six times its square of them") \
  X(int, pstf_normals, "r_pstf_normals", 1, 0, 1, "pstf: 1 outgoing light varies with the normal within a cell (two bands of spherical harmonics), 0 it does not") \
  X(float, pstf_window, "r_pstf_window", 64, 1, 10000, "pstf: frames to which a cell's memory is limited (T_max)") \
  X(float, pstf_change, "r_pstf_change", 6, 0, 1000, "pstf: standard errors by which a frame's light in a cell must differ from the memory's for that to be dropped, and straight light of a part of the world for all light there to follow; 0: never") \
  X(int, pstf_samples, "r_pstf_samples", 256, 1, 4096, "pstf: samples that a cell takes a frame, about; of more a share is taken at random") \
  X(int, pstf_train, "r_pstf_train", 2, 1, 64, "pstf: one in this many paths teaches cells that have been taught much") \
  X(int, pstf_ends, "r_pstf_ends", 0, 0, 1, "pstf: 1 last vertices of paths teach the field as well, which are without reflected light: it is darker, as paths are that end") \
  X(int, pstf_vertices, "r_pstf_vertices", 64, 0, 64, "pstf: first vertices of a path that have a control variate") \
  X(int, pstf_learn_beta, "r_pstf_learn_beta", 1, 0, 1, "pstf: factor on the control variate: 1 learnt in each cell, 0 r_pstf_beta") \
  X(float, pstf_beta, "r_pstf_beta", 0.75f, 0, 2, "pstf: factor on the control variate (beta), where it is not learnt") \
  X(int, pstf_two_level, "r_pstf_two_level", 0, 0, 64, "pstf_cv, pstf_b: directions without rays that estimate the integral of the control variate, which is then of the whole BSDF (Dereviannykh 2024); 0: it is of a Lambert surface, and its integral is known") \
  X(float, pstf_defence, "r_pstf_defence", 0.5f, 0.05f, 1, "pstf_is: share of directions by the vertex's own scattering") \
  X(float, pstf_split, "r_pstf_split", 2, 1, 100, "pstf_is: ratio of light of a tree's brightest leaf to that of the darkest two halves of one at which it splits and they collapse (T)") \
  X(int, pstf_gaussians, "r_pstf_gaussians", 0, 0, 8, "pstf_is: what cells draw directions from: 0 trees of 16 leaves, else mixtures of 4 Gaussians, from 5 on of 8") \
  X(int, pstf_em, "r_pstf_em", 1, 0, 1, "pstf_is with r_pstf_gaussians: their samples are learnt by one lane a Gaussian (0) or one lane a sample with prefix sums (1), alike but for rounding") \
  X(float, pstf_gamma, "r_pstf_gamma", 0.125f, 0, 1, "pstf_b: share of the unbiased estimate beside the field's light (gamma)") \
  X(int, pstf_vertex, "r_pstf_vertex", 2, 1, 2, "pstf_b: the vertex of a path whose light is the field's") \
  X(int, pstf_progressive, "r_pstf_progressive", 1, 0, 1, "pstf: 1 vertices teach what they reflect of the field's light, 0 first vertices teach the whole light of their paths, as in path space filtering (Keller 2014)") \
  X(int, pstf_form, "r_pstf_form", 0, 0, 2, "pstf, for tests: 1 the control variate as Eq. 24 is printed, 2 the mean of outgoing light as its integral; both biased") \
  X(float, pstf_noise, "r_pstf_noise", 0, 0, 4, "pstf, for tests: how far the control variate is off at random, relative to its mean; no bias comes of it")
// clang-format on

FB_CONST uint kViewOfPstf = kViewOfTechniques + 3u;
// clang-format off
#define FB_PSTF_VIEWS(X) \
  X(kViewPstfField, 39u, kViewOfPstf, "pstf_field", "pstf: outgoing light of the field, without textures; magenta: nothing is known") \
  X(kViewPstfBeta, 40u, kViewOfPstf, "pstf_beta", "pstf: factor on the control variate, red 0, blue 1") \
  X(kViewPstfSlope, 41u, kViewOfPstf, "pstf_slope", "pstf: where more light comes from, by the control variate's slope, as a colour")
// clang-format on
FB_PSTF_VIEWS(FB_VIEW_CONSTANT)

struct PstfConstants {
  FB_PSTF_SETTINGS(FB_UNIFORM_FIELD)
  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)
  float cell_angle;   // tangent of the angle that a cell subtends at the camera
  uint frame_number;  // frames since it forgot, from 1
  uint seen_stride;   // of this many shadow rays one is remembered; a power of two
  uint seen_ways;     // the table of ways that is read, 0 or 1
};

// --- Sums in fixed point (shared/fixed_point.h) ---
FB_CONST float kPstfSteps = 1024.0f, kPstfLargest = 256.0f;  // of light: a sample's luminance
FB_CONST float kPstfMomentSteps = 32.0f, kPstfMomentLargest = 1024.0f;

// Eq. 10: the weight of a frame's samples against those of before, at least that of a window of so many frames.
FB_FN float pstf_blend(float now, float before, float window) {
  return now > 0.0f ? max(sqrt(now / (before + now)), 1.0f / window) : 0.0f;
}

// --- Colour (luminance Y as YCoCg has it: a quarter of red and blue, half of green) ---
FB_FN vec3 ycocg_from_rgb(vec3 c) {
  return vec3(0.25f * (c.x + c.z) + 0.5f * c.y, 0.5f * (c.x - c.z), 0.5f * c.y - 0.25f * (c.x + c.z));
}
FB_FN vec3 rgb_from_ycocg(vec3 c) {
  float t = c.x - c.z;
  return vec3(t + c.y, c.x + c.z, t - c.y);
}

// --- Outgoing light by the normal ---
// Two bands of samples of many normals in a cell, read at one. Projecting as the paper says supposes normals that are
// even over the sphere: on a wall, where all are one, light would be as much as the cosine between them. So the same
// kernel's sum over the normals divides it: there it is the mean.
FB_CONST float kLeastNormals = 0.5f, kMostOfMean = 4.0f;
FB_FN float light_of_normal(float mean, vec3 first, vec3 mean_normal, vec3 normal) {
  float normals = 1.0f + 3.0f * dot(mean_normal, normal);
  if (normals < kLeastNormals) return mean;
  return clamp((mean + 3.0f * dot(first, normal)) / normals, 0.0f, kMostOfMean * max(mean, 0.0f));
}

// --- The control variate: h = albedo / pi max(n w, 0) (a + b w) ---
struct LinearLight {
  float a;
  vec3 b;
};
// Its integral over all directions, per albedo; exact for any a, b and any unit n.
FB_FN float linear_integral(LinearLight l, vec3 n) { return l.a + (2.0f / 3.0f) * dot(l.b, n); }
FB_FN float linear_at(LinearLight l, vec3 direction) { return l.a + dot(l.b, direction); }

// The linear function of direction that is nearest to incident light in the square, over directions of density cosine /
// pi about n: of its mean and its mean times direction. Variances of directions are 1/4 along the surface and
// 1/18 along n. Scaled so that the integral is 1.
FB_CONST float kMostSlope = 4.0f;  // more than any light from one direction has along the surface
FB_FN LinearLight fitted_light(float mean, vec3 first, vec3 n) {
  LinearLight l;
  l.a = 1.0f;
  l.b = vec3(0.0f);
  if (!(mean > 0.0f)) return l;
  vec3 off = first * (1.0f / mean) - n * (2.0f / 3.0f);
  float along = dot(off, n);
  vec3 b = (off - n * along) * 4.0f + n * (18.0f * along);
  float size = length(b);
  l.b = size > kMostSlope ? b * (kMostSlope / size) : b;
  l.a = 1.0f - (2.0f / 3.0f) * dot(l.b, n);
  return l;
}

// Its factor, learnt. Of samples g of light and the control variate's h, whose mean is zero, both over the cell's mean:
struct ControlMoments {
  float gh, hh, gg;  // means; gg about the mean that was known before
  float samples;     // that they are worth
};
// Covariance over variance, less what chance alone makes of so many samples, and 0 where they are few. With no
// covariance the factor is some (z - 1) sqrt(gg / (hh n)), z normal: it adds (z - 1)^2 / n of the variance.
FB_CONST float kFewSamples = 16.0f, kMostBeta = 1.5f;
FB_FN float learnt_beta(ControlMoments m) {
  if (!(m.samples >= kFewSamples) || !(m.hh > 0.0f)) return 0.0f;
  float chance = sqrt(max(m.gg, 0.0f) * m.hh / m.samples);
  return clamp((m.gh - chance) / m.hh, 0.0f, kMostBeta);
}
// Moments of `count` new samples join those of before: all count alike until new ones are a 64th.
FB_CONST float kMomentWindow = 64.0f;
FB_FN ControlMoments joined_moments(ControlMoments before, ControlMoments now) {
  if (!(now.samples > 0.0f)) return before;
  float w = max(now.samples / (before.samples + now.samples), 1.0f / kMomentWindow);
  ControlMoments m;
  m.gh = mix(before.gh, now.gh, w);
  m.hh = mix(before.hh, now.hh, w);
  m.gg = mix(before.gg, now.gg, w);
  float squares = w * w / now.samples;
  if (before.samples > 0.0f) squares += (1.0f - w) * (1.0f - w) / before.samples;
  m.samples = 1.0f / squares;
  return m;
}

// Whether a frame's mean of `samples` differs from the memory's by more than so many standard errors. `second`: the
// memory's second moment of samples.
FB_FN bool has_changed(float now, float before, float second, float samples, float errors) {
  float variance = max(second - before * before, 0.01f * before * before);
  float off = now - before;
  return errors > 0.0f && samples >= kFewSamples && off * off * samples > errors * errors * variance;
}

// A number for parts of a cube's edge, beside the face (cube_face): which of them a direction points through.
FB_FN uint direction_part(vec3 d, int parts) {
  vec3 s = vec3(abs(d.x), abs(d.y), abs(d.z));
  float most = max(max(s.x, s.y), max(s.z, 1e-20f));
  vec2 p = s.x >= s.y && s.x >= s.z ? vec2(d.y, d.z) : s.y >= s.z ? vec2(d.x, d.z) : vec2(d.x, d.y);
  float scale = 0.5f * float(parts);
  int x = int(min((p.x / most + 1.0f) * scale, float(parts) - 1.0f));
  int y = int(min((p.y / most + 1.0f) * scale, float(parts) - 1.0f));
  return uint(x + y * parts);
}

FB_NAMESPACE_END
#endif
