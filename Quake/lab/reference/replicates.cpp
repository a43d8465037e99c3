#include "lab/reference/replicates.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "shared/kinds.h"
#include "shared/rng.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kMostReplicates = 8;  // more know the variance better and spread positions worse

}  // namespace

std::vector<std::uint32_t> plan_replicates(std::uint32_t samples) {
  const std::uint32_t count = std::min(samples, kMostReplicates);
  std::vector<std::uint32_t> plan;
  for (std::uint32_t i = 0; i < count; ++i) plan.push_back(samples / count + (i < samples % count ? 1 : 0));
  return plan;
}

void ReplicateSum::add(Picture mean, std::uint32_t samples) {
  FB_CHECK(means_.empty() || means_.front().same_size(mean));
  means_.push_back(std::move(mean));
  samples_.push_back(samples);
}

Reference ReplicateSum::reference() const {
  Reference reference;
  if (means_.empty()) return reference;
  double all = 0, squares = 0;
  for (const double n : samples_) {
    all += n;
    squares += n * n;
  }
  const std::size_t pixels = means_.front().pixels.size();
  reference.mean = {means_.front().width, means_.front().height, std::vector<vec3>(pixels)};
  if (means_.size() > 1) reference.variance.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    dvec3 sum(0), scatter(0);
    for (std::size_t r = 0; r < means_.size(); ++r) sum += samples_[r] * dvec3(means_[r].pixels[i]);
    const dvec3 mean = sum / all;
    reference.mean.pixels[i] = vec3(mean);
    if (means_.size() < 2) continue;
    for (std::size_t r = 0; r < means_.size(); ++r) {
      const dvec3 off = samples_[r] * (dvec3(means_[r].pixels[i]) - mean);
      scatter += off * off;
    }
    reference.variance[i] = vec3(scatter / (all * all - squares));
  }
  return reference;
}

render::RenderSettings settings_of_samples(render::RenderSettings settings) {
  if (settings.denoise > 0 && settings.texture_filter < 0)
    settings.texture_filter = static_cast<int>(shared::kFilterFootprint);
  settings.denoise = 0;
  settings.spp = 1;
  settings.accumulate = 1;
  settings.jitter = settings.jitter != 0 ? 1 : 0;
  return settings;
}

Reference render_replicates(render::Renderer& renderer, render::RenderSettings settings, scene::FrameSnapshot snapshot,
                            std::uint32_t samples, const std::function<void(std::uint32_t)>& progress) {
  const auto seed = static_cast<std::uint32_t>(settings.seed);
  settings = settings_of_samples(std::move(settings));
  snapshot.frame = 0;
  snapshot.cut = true;
  ReplicateSum sum;
  std::uint32_t done = 0;
  const render::TechniqueInfo* technique = render::find_technique(settings.estimator);
  const bool restarts = technique != nullptr && technique->frames == render::Frames::kCorrelated;
  const std::vector<std::uint32_t> plan = plan_replicates(samples);
  for (std::uint32_t i = 0; i < plan.size(); ++i) {
    settings.seed = static_cast<int>(shared::hash_combine(seed, i));
    renderer.restart_accumulation();
    if (restarts) renderer.reset_learning();
    for (std::uint32_t k = 0; k < plan[i]; ++k) {
      renderer.render(snapshot, nullptr, settings);
      if (progress) progress(++done);
    }
    sum.add(picture_of(renderer.read().linear(), renderer.render_size()), plan[i]);
  }
  return sum.reference();
}

}  // namespace fb::lab
