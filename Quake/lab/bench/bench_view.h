// What a bench looks at: a view that stands still, or consecutive frames of one that moves; and their references.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "lab/frame_source.h"
#include "lab/picture.h"
#include "render/renderer.h"

namespace fb::lab {

struct ViewOptions {
  std::uint64_t first = 0, last = 0;  // frames that are measured, inclusive
  std::uint32_t warmup = 0;           // frames before them that are rendered to learn from
  bool hold = false;                  // frame `first` stands still for all of them
  double frames_per_second = 60;
};
struct View {
  bool still = false;
  std::uint32_t warmup = 0, measured = 0;
  std::uint64_t first_frame = 0;                // the source's number of the first snapshot of a view that moves
  std::vector<scene::FrameSnapshot> snapshots;  // one if still, else warmup + measured
  std::uint32_t frames() const { return warmup + measured; }
  // Frame `index` of run `run`. Frames count up over the runs; each run begins with a cut.
  scene::FrameSnapshot at(std::uint32_t run, std::uint32_t index) const;
};
// A source whose frames are all alike is still without being held. A view that moves needs its warm-up frames before
// `first`. Fails where the source ends too early.
Result<View> collect_view(FrameSource& source, const ViewOptions& options);

// A frame held still: nothing moves since the former frame, which was a step of time ago; animation (a function of the
// time) stands, too.
scene::FrameSnapshot held(scene::FrameSnapshot snapshot, double frames_per_second);

struct ReferenceOptions {
  std::string estimator = "pt";  // an unbiased one
  std::uint32_t spp = 4096;
  std::uint32_t width = 320, height = 180;
  std::string folder;  // where their blocks are kept under their content's key; empty: nowhere
  bool quiet = false;
};
// References of the view's measured frames (of a still one: one), with these settings.
Result<std::vector<Reference>> make_references(const View& view, gpu::Device& device, render::RenderSettings settings,
                                               const ReferenceOptions& options);

// What reports tell of references: over them, pixels and channels.
struct ReferenceFigures {
  double mean = 0, variance = 0;
  bool variance_known = true;  // of all
};
ReferenceFigures figures_of(const std::vector<Reference>& references);
// Whether the reference has what is rendered of `name`, or a sentence that says what has which size.
Status check_size(const Reference& reference, uvec2 rendered, std::string_view name);

}  // namespace fb::lab
