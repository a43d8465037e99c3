// Frames that several machines render: who renders which, and how their folders become one.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace fb::lab {

// Frames `first` to `last` of shard `index` (from 1) of `count`: neighbouring ones, as equally many as can be. Empty
// (first > last) where there are fewer frames than shards.
std::pair<std::uint64_t, std::uint64_t> frames_of_shard(std::uint64_t first, std::uint64_t last, std::uint32_t index,
                                                        std::uint32_t count);

// What a shard has rendered, told in its folder (frames.json) when it is done.
struct ShardOfFrames {
  std::string of;  // what all shards have in common: view, estimator, settings, size, samples, format
  std::uint64_t first = 0, last = 0;  // of all shards
  std::uint32_t index = 1, count = 1;
};
// Before a shard renders into a folder: what an earlier one told there no longer holds.
void begin_shard(const std::string& folder);
Status tell_shard(const std::string& folder, const ShardOfFrames& shard);

// Copies all frames into `to`, which gets its name only when it is whole. Fails where shards are of different things,
// where one is missing or there twice, and where a frame is missing; names it. Returns the number of frames.
Result<std::uint64_t> merge_frames(const std::vector<std::string>& folders, const std::string& to);

}  // namespace fb::lab
