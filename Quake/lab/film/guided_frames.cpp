#include "lab/film/guided_frames.h"

#include <algorithm>
#include <utility>

#include "lab/reference/replicates.h"
#include "render/passes/frame_keys.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kIterationsOfOneFrame = 4;

}  // namespace

bool shows_time(const scene::FrameSnapshot& snapshot) {
  if (snapshot.sky.mode == scene::SkyMode::kLayers) return true;
  if (!snapshot.assets) return false;
  return std::ranges::any_of(snapshot.assets->materials, [](const scene::Material& m) {
    constexpr std::uint32_t kMoves = scene::kMaterialWarp | scene::kMaterialLiquid;
    return (m.flags & kMoves) != 0 || m.frames.size() > 1 || m.alternate_frames.size() > 1;
  });
}

void GuidedFrames::render(render::Renderer& renderer, render::RenderSettings settings,
                          const scene::FrameSnapshot& snapshot) {
  const auto samples = static_cast<std::uint32_t>(std::max(settings.spp, 1));
  settings = settings_of_samples(std::move(settings));
  scene::FrameSnapshot timeless = snapshot;
  if (!shows_time(snapshot)) timeless.time = 0;
  // Exposure says how it is shown, not what is seen.
  render::RenderSettings seen = settings;
  seen.exposure = 1;
  seen.auto_exposure = 0;
  const std::uint64_t key = render::view_key(render::scene_key(timeless), seen);
  if (snapshot.cut || key != key_) {
    snapshot_ = snapshot;
    iteration_ = samples_ = 0;
    frames_ = left_ = 1;
  } else if (left_ == 0) {
    if (++iteration_ >= kIterationsOfOneFrame) frames_ *= 2;
    left_ = frames_;
  }
  key_ = key;
  gpu_ms_ = estimator_ms_ = 0;
  const auto frame = [&] {
    renderer.render(snapshot_, nullptr, settings);
    snapshot_.cut = false;
    for (const render::PassTime& pass : renderer.pass_times()) {
      gpu_ms_ += pass.milliseconds;
      if (pass.kind == render::PassKind::kEstimator) estimator_ms_ += pass.milliseconds;
    }
  };
  // All of a picture's samples differ by their number alone, which goes on over pictures.
  renderer.begin_iteration(iteration_, frames_ * samples);
  for (std::uint32_t k = 0; k < samples; ++k) {
    snapshot_.frame = all_++;
    renderer.restart_accumulation();
    frame();
  }
  samples_ += samples;
  --left_;
  renderer.end_iterations();
  frame();
}

}  // namespace fb::lab
