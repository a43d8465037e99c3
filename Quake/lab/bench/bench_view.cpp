#include "lab/bench/bench_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/progress.h"
#include "lab/compare/metrics.h"
#include "lab/content_key.h"
#include "lab/reference/reference_job.h"

namespace fb::lab {

scene::FrameSnapshot held(scene::FrameSnapshot s, double frames_per_second) {
  s.prev_time = s.time - 1.0 / frames_per_second;
  s.prev_camera = s.camera;
  s.cut = false;
  for (scene::Instance& instance : s.instances) {
    instance.prev_transform = instance.transform;
    instance.prev_pose = instance.pose;
    instance.flags &= ~static_cast<std::uint32_t>(scene::kInstanceNew);
  }
  return s;
}

scene::FrameSnapshot View::at(std::uint32_t run, std::uint32_t index) const {
  scene::FrameSnapshot snapshot = snapshots[still ? 0 : index];
  snapshot.frame = std::uint64_t{run} * frames() + index;
  if (index == 0) snapshot.cut = true;
  return snapshot;
}

Result<View> collect_view(FrameSource& source, const ViewOptions& options) {
  View view;
  view.warmup = options.warmup;
  view.measured = static_cast<std::uint32_t>(options.last - options.first + 1);
  const std::uint64_t begin =
      options.hold ? options.first : options.first - std::min<std::uint64_t>(options.warmup, options.first);
  const std::uint64_t end = options.hold ? options.first : options.last;
  std::uint64_t key = 0;
  bool alike = true;
  for (std::uint64_t frame = 0; frame <= end; ++frame) {
    scene::FrameSnapshot snapshot;
    const auto more = source.next(snapshot);
    if (!more) return more.error();
    if (!*more) return Error{fmt::format("there is no frame {}: the demo has {} frames at this rate", frame, frame)};
    if (frame < begin) continue;
    const std::uint64_t this_key = content_key(snapshot);
    alike = alike && (view.snapshots.empty() || this_key == key);
    key = this_key;
    view.snapshots.push_back(std::move(snapshot));
  }
  view.still = alike;
  if (view.still) {
    view.snapshots = {held(view.snapshots.back(), options.frames_per_second)};
  } else if (options.first < options.warmup) {
    return Error{fmt::format("--warmup {}: the view moves, and only {} frames come before --frames {}:{}",
                             options.warmup, options.first, options.first, options.last)};
  }
  return view;
}

Result<std::vector<Reference>> make_references(const View& view, gpu::Device& device, render::RenderSettings settings,
                                               const ReferenceOptions& options) {
  settings.estimator = options.estimator;
  std::unique_ptr<render::Renderer> renderer;  // when the first block is to be made
  const std::uint32_t count = view.still ? 1 : view.measured;
  std::vector<Reference> references;
  Progress progress("reference sample", std::uint64_t{count} * options.spp, {.quiet = options.quiet});
  for (std::uint32_t i = 0; i < count; ++i) {
    const ReferenceSubject subject{view.at(0, view.still ? 0 : view.warmup + i), settings, options.width,
                                   options.height};
    const auto folder = BlockFolder::open(options.folder, subject.key(), {options.width, options.height});
    if (!folder) return folder.error();
    ReferenceSum sum;
    for (const BlockPlan& plan : plan_blocks(options.spp)) {
      auto block = folder->read(plan);
      if (!block && !renderer) {
        auto made = render::Renderer::create(device, settings);
        if (!made) return made.error();
        renderer = std::move(*made);
      }
      if (!block) {
        auto made = make_block(*renderer, subject, plan, *folder, [&](std::uint32_t done) {
          progress.update(std::uint64_t{i} * options.spp + plan.first + done);
        });
        if (!made) return made.error();
        block = std::move(*made);
      }
      sum.add(*block);
    }
    references.push_back(sum.reference());
  }
  return references;
}

ReferenceFigures figures_of(const std::vector<Reference>& references) {
  ReferenceFigures figures;
  for (const Reference& reference : references) {
    const Errors of_black = measure(reference, Picture{reference.mean.width, reference.mean.height,
                                                       std::vector<vec3>(reference.mean.pixels.size(), vec3(0.0f))});
    figures.mean -= of_black.bias / static_cast<double>(references.size());
    figures.variance += of_black.reference_variance / static_cast<double>(references.size());
    figures.variance_known = figures.variance_known && !reference.variance.empty();
  }
  return figures;
}

Status check_size(const Reference& reference, uvec2 rendered, std::string_view name) {
  if (reference.mean.width == rendered.x && reference.mean.height == rendered.y) return ok_status();
  return Error{fmt::format("the reference has {}x{} pixels, {} renders {}x{}", reference.mean.width,
                           reference.mean.height, name, rendered.x, rendered.y)};
}

}  // namespace fb::lab
