// This frame's exposure from the histogram: the mean log luminance between the 20th and the 95th percentile is brought
// to frame.exposure_target, but the 90th percentile is not pushed beyond what the tone curve can still tell apart;
// eased over time by frame.adaptation, and at rest while that is not far off. Clears histogram and grid for the next
// frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/frame_bindings.glsl"
#include "lib/exposure.glsl"

layout(local_size_x = 64) in;

void follow_picture() {
  uint total = 0u;
  for (uint i = 0u; i < kHistogramBins; ++i) total += exposure_buffer.at[0].histogram[i];
  const float kBrightest = 4.0;  // where the filmic curve comes within a few steps of white
  float bright = -100.0;
  float low = float(total) * 0.20, high = float(total) * 0.95, before = 0.0, weight = 0.0, sum = 0.0;
  for (uint i = 0u; i < kHistogramBins; ++i) {
    float after = before + float(exposure_buffer.at[0].histogram[i]);
    float inside = max(0.0, min(after, high) - max(before, low));
    sum += inside * bin_log2_luminance(i);
    weight += inside;
    if (before < float(total) * 0.9 && after >= float(total) * 0.9) bright = bin_log2_luminance(i);
    before = after;
  }
  // A part of a dark room's darkness stays: eyes know a cellar from a yard.
  float wanted = exposure_buffer.at[0].state.log_exposure;
  if (weight > 0.0) wanted = min(log2(frame.exposure_target) - 0.85 * sum / weight, log2(kBrightest) - bright);
  float now = exposure_buffer.at[0].state.log_exposure, off = wanted - now;
  float far = frame.adaptation < 1.0 ? sign(off) * max(abs(off) - frame.exposure_rest, 0.0) : off;
  float value = clamp(now + far * frame.adaptation, frame.exposure_least, frame.exposure_most);
  exposure_buffer.at[0].state.log_exposure = value;
  exposure_buffer.at[0].state.exposure = frame.exposure * (frame.auto_exposure > 0.0 ? exp2(value) : 1.0);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) follow_picture();
  barrier();
  for (uint i = lane; i < kHistogramBins; i += 64u) exposure_buffer.at[0].histogram[i] = 0u;
  for (uint i = lane; i < kGridCells; i += 64u)
    exposure_buffer.at[0].grid_count[i] = exposure_buffer.at[0].grid_sum[i] = 0u;
}
