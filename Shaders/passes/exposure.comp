// This frame's exposure from the histogram: the mean log luminance between the 20th and the 95th percentile is brought to
// frame.exposure_target, eased over time by frame.adaptation. Clears the histogram for the next frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/frame_bindings.glsl"
#include "lib/exposure.glsl"

layout(local_size_x = 1) in;

void main() {
  uint total = 0u;
  for (uint i = 0u; i < kHistogramBins; ++i) total += histogram[i];
  float low = float(total) * 0.20, high = float(total) * 0.95, before = 0.0, weight = 0.0, sum = 0.0;
  for (uint i = 0u; i < kHistogramBins; ++i) {
    float after = before + float(histogram[i]);
    float inside = max(0.0, min(after, high) - max(before, low));
    sum += inside * bin_log2_luminance(i);
    weight += inside;
    before = after;
    histogram[i] = 0u;
  }
  float wanted = weight > 0.0 ? sum / weight : exposure_state.log_luminance;
  float value = mix(exposure_state.log_luminance, wanted, frame.adaptation);
  exposure_state.log_luminance = value;
  // Half of a dark room's darkness stays: eyes know the difference between a cellar and a yard.
  float automatic = frame.exposure_target * exp2(-value * 0.85);
  exposure_state.exposure = frame.exposure * (frame.auto_exposure > 0.0 ? clamp(automatic, 0.02, 200.0) : 1.0);
}
