// Whether a part of the world has other light than its cells remember, and by what factor: arithmetic, for C++ too.
//
// Of light that cells hand to each other a frame takes one reflection away, whatever they forget. But straight light,
// of emitters without a reflection between, is a frame's own: its ratio to what is remembered, over many cells, tells
// what becomes of the rest.
#ifndef FB_PSTF_CHANGE_H
#define FB_PSTF_CHANGE_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// Parts of the world: cubes, cubes four times as wide, and all of it, each for where too little is known in the one
// before. By hash: some cubes share a number, and what they know. A cell's word names both of its cubes
// (kPstfSumRegion).
FB_CONST uint kRegions = 4096u, kWideRegions = 1024u, kWholeWorld = kRegions + kWideRegions;
FB_CONST uint kAllRegions = kWholeWorld + 1u, kRegionWords = 5u;
FB_CONST float kRegionWidth = 512.0f, kWideRegion = 4.0f;  // units, and its own widths
FB_FN uint region_word(uint fine, uint wide) {
  return 1u + (fine & (kRegions - 1u)) + (wide & (kWideRegions - 1u)) * kRegions;
}
// `level`: 0 to 2.
FB_CONST uint kRegionLevels = 3u;
FB_FN uint region_of(uint word, uint level) {
  uint wide = kRegions + (word - 1u) / kRegions;
  return level == 0u ? (word - 1u) & (kRegions - 1u) : level == 1u ? wide : kWholeWorld;
}

// Sums over the cells that a frame taught, each over its remembered light and times its samples: straight light now and
// as remembered; variance of their difference as the spread of samples lets expect it, and as that of cells has it;
// samples.
struct RegionLight {
  float now, memory, variance, scatter, samples;
};
// One cell's. `before`: samples that it remembers; `light`, `second`: their mean and second moment.
FB_CONST float kMostRegionSamples = 64.0f, kMostRegionLight = 8.0f, kMostRegionVariance = 64.0f;
FB_CONST float kRegionSteps = 64.0f, kRegionVarianceSteps = 8.0f;  // with room for 2^14 cells of the most
FB_FN RegionLight light_of_cell(float straight_now, float straight, float light, float second, float samples,
                                float before) {
  RegionLight r;
  r.now = r.memory = r.variance = r.scatter = r.samples = 0.0f;
  if (!(light > 0.0f) || !(before > 0.0f)) return r;
  float n = min(samples, kMostRegionSamples);
  float variance = max(second / (light * light) - 1.0f, 0.01f) * (1.0f + samples / before);
  r.now = n * clamp(straight_now / light, 0.0f, kMostRegionLight);
  r.memory = n * clamp(straight / light, 0.0f, 1.0f);
  r.variance = n * min(variance, kMostRegionVariance);
  r.scatter = (r.now - r.memory) * (r.now - r.memory);
  r.samples = n;
  return r;
}

// Where straight light is less than a part of all, it says nothing of the rest; where it differs by less than a
// quarter, cells learn the change as they learn all else.
FB_CONST float kLeastStraight = 1.0f / 32.0f, kLeastChange = 0.25f, kMostRatio = 4.0f;
// Standard errors that tell a change of many cells, over those that tell one of a cell alone.
FB_CONST float kRegionErrors = 0.5f;
FB_FN float region_variance(RegionLight r, float errors) {
  return kRegionErrors * kRegionErrors * errors * errors * max(r.variance, r.scatter);
}

// Straight light now over what is remembered, where it differs; else 1. `errors`: 0: nothing ever does.
FB_FN float change_of_light(RegionLight r, float errors) {
  float off = r.now - r.memory;
  bool differs = errors > 0.0f && r.memory > kLeastStraight * r.samples && abs(off) > kLeastChange * r.memory &&
                 off * off > region_variance(r, errors);
  return differs ? min(r.now / r.memory, kMostRatio) : 1.0f;
}
// Whether it would have been seen to differ: else wider parts tell.
FB_FN bool knows_change(RegionLight r, float errors) {
  float least = kLeastChange * r.memory;
  return r.memory > kLeastStraight * r.samples && least * least > region_variance(r, errors);
}

// A cell whose light follows: its memory counts as so many frames, and its own straight light as much as so many
// samples.
FB_CONST float kKeptFrames = 3.0f, kFollowedSamples = 16.0f;

FB_NAMESPACE_END
#endif
