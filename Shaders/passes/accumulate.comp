// Mean and squared deviations over the frames of a static view (Welford 1962); without accumulation, this frame alone.
// Frames that do not sample a pixel do not count there. Squared deviations are written from a pixel's second sample on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "lib/work.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  vec3 x = radiance.at[at].rgb;
#if MEDIUM
  if (asked_for(kWorkMedium)) x += radiance.at[frame.width * frame.height + at].rgb;
  bool sampled = pixel == medium_pixel(pixel / frame.medium_block);  // light is sampled there, too
#else
  bool sampled = pixel == light_pixel(pixel / frame.light_block);
#endif
  if (frame.accumulated_frames == 0u) {
    mean_radiance.at[at] = sampled ? vec4(x, 1.0) : vec4(0.0);
    return;
  }
  if (!sampled) return;
  vec4 former = mean_radiance.at[at];
  float n = former.w + 1.0;
  vec3 delta = x - former.rgb, mean = former.rgb + delta / n;
  vec3 squares = n > 2.0 ? m2_radiance.at[at].rgb : vec3(0.0);
  if (n > 1.0) m2_radiance.at[at] = vec4(squares + delta * (x - mean), 0.0);
  mean_radiance.at[at] = vec4(mean, n);
}
