// Folds this frame's samples into the cells of the irradiance cache that were touched, and gives claimed cells away.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/mcpg/steps/cache.glsl"

layout(local_size_x = 64) in;

const float kMomentBlendLeast = 0.06;  // of a new frame in an old moment: some 16 frames
const float kMeanBlend = 0.06;         // the same of all cells together

void fold_samples(uint entry, uint samples) {
  uint count = min((guide_cache.at[entry + kCacheCount] & 0xffffu) + 1u, 65535u);
  float blend = max(1.0 / float(count), guide.mc_cache_alpha);
  float scale = 1.0 / (kCacheFixed * float(samples));
  for (uint i = 0u; i < 3u; ++i) {
    float mean = uintBitsToFloat(guide_cache.at[entry + kCacheMean + i]);
    mean = mix(mean, float(guide_cache.at[entry + kCacheSum + i]) * scale, blend);
    guide_cache.at[entry + kCacheMean + i] = floatBitsToUint(mean);
    guide_cache.at[entry + kCacheSum + i] = 0u;
  }
  vec4 sums = vec4(guide_cache.at[entry + kCacheMomentSum], guide_cache.at[entry + kCacheMomentSum + 1u],
                   guide_cache.at[entry + kCacheMomentSum + 2u], guide_cache.at[entry + kCacheMomentSum + 3u]);
  if (sums != vec4(0.0)) {
    vec4 moments = vec4(unpackHalf2x16(guide_cache.at[entry + kCacheMoment]),
                        unpackHalf2x16(guide_cache.at[entry + kCacheMoment + 1u]));
    vec4 now = sums / (kMomentFixed * float(samples));
    vec4 added = bound_moments(now, kTailLargest / float(guide.mc_cells));
    for (uint i = 0u; i < 4u; ++i)
      atomicAdd(guide_cache.at[guide_moment_sums_at(guide.frame_number) + i], uint(added[i] + 0.5));
    moments = moments == vec4(0.0) ? now : mix(moments, now, max(1.0 / float(count), kMomentBlendLeast));
    guide_cache.at[entry + kCacheMoment] = packHalf2x16(moments.xy);
    guide_cache.at[entry + kCacheMoment + 1u] = packHalf2x16(moments.zw);
  }
  float light = min(luminance(cached_reflection(entry)) * kTailLightFixed, kTailLargest / float(guide.mc_cells));
  atomicAdd(guide_cache.at[guide_summed_cells_at(guide.frame_number)], 1u);
  atomicAdd(guide_cache.at[guide_light_sum_at(guide.frame_number)], uint(light + 0.5));
  guide_cache.at[entry + kCacheCount] = count | (guide.frame_number << 16u);
}

// The former frame's sum, which is taken back to zero, into a mean.
void fold_sum(uint sum, uint mean, float scale) {
  float before = uintBitsToFloat(guide_cache.at[mean]), now = float(guide_cache.at[sum]) * scale;
  guide_cache.at[mean] = floatBitsToUint(before > 0.0 ? mix(before, now, kMeanBlend) : now);
  guide_cache.at[sum] = 0u;
}

void fold_sums() {
  uint number = guide.frame_number - 1u, cells = guide_cache.at[guide_summed_cells_at(number)];
  if (cells == 0u) return;
  guide_cache.at[guide_summed_cells_at(number)] = 0u;
  float scale = 1.0 / float(cells);
  for (uint i = 0u; i < 4u; ++i)
    fold_sum(guide_moment_sums_at(number) + i, guide_tail_at() + kTailMomentMeans + i, scale);
  fold_sum(guide_light_sum_at(number), guide_tail_at() + kTailLightMean, scale / kTailLightFixed);
}

void main() {
  uint touched = guide_cache.at[guide_list_count_at()];
  if (gl_GlobalInvocationID.x == 0u) {
    guide_cache.at[guide_next_count_at()] = 0u;
    fold_sums();
  }
  uint stride = gl_NumWorkGroups.x * 64u;
  for (uint i = gl_GlobalInvocationID.x; i < touched; i += stride) {
    uint entry = guide_cache.at[guide_list_at() + i];
    uint samples = guide_cache.at[entry + kCacheTouched] & ~kCacheClaimed;
    if (samples > 0u) {
      fold_samples(entry, samples);
    } else {  // claimed, and its owner did not come
      for (uint w = 0u; w < kCacheWords; ++w)
        guide_cache.at[entry + w] = w == kCacheCheck ? guide_cache.at[entry + kCacheClaim] : 0u;
      guide_cache.at[entry + kCacheCount] = guide.frame_number << 16u;
    }
    for (uint w = kCacheTouched; w < kCacheWords; ++w) guide_cache.at[entry + w] = 0u;
  }
}
