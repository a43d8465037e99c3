// The picture of all iterations, which the host has made.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/mir/steps/begin.glsl"
#include "lib/pixel.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  radiance.at[at] = vec4(mir_picture.at[at].rgb, 0.0);
  if (FEATURE_MEDIUM) radiance.at[frame.width * frame.height + at] = vec4(0.0);
}
