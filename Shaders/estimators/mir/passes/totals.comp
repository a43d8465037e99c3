// A frame's radiance of each pixel, with the light that a medium scatters, for the host.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/mir/steps/begin.glsl"
#include "lib/pixel.glsl"
#include "lib/scatter.glsl"
#include "lib/work.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  vec3 x = radiance.at[at].rgb;
  if (FEATURE_MEDIUM && asked_for(kWorkMedium)) x += radiance.at[frame.width * frame.height + at].rgb;
  mir_totals.at[at] = vec4(x, 0.0);
}
