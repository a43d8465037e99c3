// A reference is the mean of blocks: runs of samples that begin with nothing learnt and have random numbers of their
// own. Blocks made at another time or on another machine are the same blocks, so a reference that was interrupted, made
// more precise or split over machines is, to the bit, the one that was made in one run (r_deterministic where the
// estimator learns).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/picture.h"

namespace fb::lab {

struct BlockPlan {
  std::uint32_t index = 0;
  std::uint32_t first = 0;    // samples a pixel before it
  std::uint32_t samples = 0;  // a pixel
};
// Blocks of 256 samples, eight of them, then of 512, and so on: few files for many samples, and an interruption loses
// no more than a part. The last takes what does not fill another one.
std::uint32_t block_samples(std::uint32_t index);
std::vector<BlockPlan> plan_blocks(std::uint32_t spp);

struct ReferenceBlock {
  BlockPlan plan;
  Reference content;  // no variance where the block is a single sample
};

// Mean of blocks, weighted by their samples, and its variance from that of each, since blocks are independent.
class ReferenceSum {
 public:
  // In the order of their indices: sums in another order may differ in the last bit.
  void add(const ReferenceBlock& block);
  std::uint32_t samples() const { return samples_; }
  Reference reference() const;

 private:
  std::uint32_t width_ = 0, height_ = 0, samples_ = 0;
  bool variance_known_ = true;
  std::vector<dvec3> mean_, variance_;  // sums of samples * mean and samples^2 * variance of the mean
};

// Mean luminance of pixels, and the standard error of a pixel's luminance (root of the mean square over pixels, colours
// taken as if they erred together) relative to it; zero where nothing glows.
struct ReferenceError {
  double mean_luminance = 0, relative = 0;
};
ReferenceError error_of(const Reference& reference);

// The files of one reference's blocks: FOLDER/KEY/block_INDEX_SAMPLES.exr.
class BlockFolder {
 public:
  // Empty folder: blocks are kept nowhere. Fails if it cannot be made.
  static Result<BlockFolder> open(const std::string& folder, std::uint64_t key, uvec2 size);
  // One that is there: `path` holds the blocks themselves.
  static BlockFolder existing(const std::string& path, uvec2 size);

  const std::string& path() const { return path_; }
  // Nothing where the file is missing, damaged or of another size: it is made again, over it.
  std::optional<ReferenceBlock> read(const BlockPlan& plan) const;
  Status keep(const ReferenceBlock& block) const;
  std::string file(const BlockPlan& plan) const;

 private:
  std::string path_;
  uvec2 size_{0, 0};
};

}  // namespace fb::lab
