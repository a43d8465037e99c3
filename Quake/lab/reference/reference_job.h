// Renders a reference block by block, to so many samples, to an error or for a time; what is there already is not made
// again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/frame_source.h"
#include "lab/reference/reference_blocks.h"
#include "render/renderer.h"

namespace fb::lab {

// What the blocks' samples are of. Two references of one key have the same blocks.
struct ReferenceSubject {
  scene::FrameSnapshot snapshot;
  render::RenderSettings settings;  // estimator and seed included; jitter other than 0 covers the whole pixel
  std::uint32_t width = 0, height = 0;
  std::uint32_t warmup = 0;  // samples of each block that are thrown away: who learns has learnt from them
  std::uint64_t key() const;
};

// The block from `folder`, or rendered and kept there. `progress`: samples of it that are done.
Result<ReferenceBlock> make_block(render::Renderer& renderer, const ReferenceSubject& subject, const BlockPlan& plan,
                                  const BlockFolder& folder, const std::function<void(std::uint32_t)>& progress);

struct ReferenceJob {
  std::uint64_t frame = 0;
  std::uint32_t width = 640, height = 360;
  std::uint32_t spp = 1024;   // at most, where an error or a time is given
  double relative_error = 0;  // it ends when the standard error is no larger (ReferenceError); 0: no matter
  double seconds = 0;         // it ends when the next block would take longer; 0: no matter
  std::uint32_t warmup = 0;
  std::uint32_t shard = 1,
                shards = 1;   // with more than one: every `shards`-th block from `shard` on (from 1), and no picture
  std::string out;            // an .exr file
  std::string blocks;         // folder in which blocks are kept; empty: nowhere
  std::string view, program;  // told in the manifest: what is looked at, which build looked
  bool quiet = false;
};
struct ReferenceSummary {
  std::uint32_t samples = 0, made = 0;  // a pixel: in the mean (a shard: in its blocks), rendered now
  ReferenceError error;
  std::string folder;  // that holds the blocks
};
// Writes R, G, B (mean radiance), variance.R, .G, .B (of that mean), albedo, normal and depth at the pixels' middles. A
// manifest beside the blocks says what they are of.
Result<ReferenceSummary> render_reference(FrameSource& source, render::Renderer& renderer,
                                          render::RenderSettings settings, const ReferenceJob& job);

// Joins what shards have made into the file `out`. Each folder is a shard's (ReferenceJob::blocks). Fails where they
// are of different things, where a block is there twice and where one is missing, and names it.
Result<ReferenceSummary> merge_references(const std::vector<std::string>& folders, const std::string& out);

}  // namespace fb::lab
