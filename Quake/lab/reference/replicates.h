// The mean of a still frame's samples with an uncertainty that holds: samples are parted into replicates, whose means
// are independent of each other, and the variance is that between these means. Within a replicate every sample has a
// camera ray of its own; positions within the pixel are spread evenly, by the R2 sequence from a random start (Cranley
// and Patterson 1976), so that edges converge faster than by chance, and the scatter of single samples, which knows
// nothing of that, is never used.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lab/picture.h"
#include "render/renderer.h"

namespace fb::lab {

// Raised when the same settings and number of samples give other samples than before: replicates, blocks, their seeds,
// positions in the pixel. References made before are not taken for the same.
constexpr std::uint32_t kSamplingVersion = 1;

// The samples of each replicate, in order: as many replicates as there are samples, at most eight, which differ by one
// sample at most.
std::vector<std::uint32_t> plan_replicates(std::uint32_t samples);

// Means of replicates, weighted by their samples.
class ReplicateSum {
 public:
  void add(Picture mean, std::uint32_t samples);  // all of one size
  // Unbiased for replicates whose means have the variance of a sample over their samples, and for others that are
  // equally large. No variance of fewer than two.
  Reference reference() const;

 private:
  std::vector<Picture> means_;
  std::vector<double> samples_;
};

// All pixels are sampled in every frame, once, of what the denoiser would have been given; the frames accumulate.
// Jitter other than 0 covers the pixel.
render::RenderSettings settings_of_samples(render::RenderSettings settings);

// `samples` a pixel of the snapshot, whose `frame` and `cut` it sets. An estimator that learns goes on learning from
// one replicate to the next: each replicate's mean is unbiased whatever was learnt before it, so they are uncorrelated.
// One whose frames are correlated (render::Frames) begins each with nothing. Samples are those of settings_of_samples.
// `progress`: samples that are done.
Reference render_replicates(render::Renderer& renderer, render::RenderSettings settings, scene::FrameSnapshot snapshot,
                            std::uint32_t samples, const std::function<void(std::uint32_t)>& progress);

}  // namespace fb::lab
