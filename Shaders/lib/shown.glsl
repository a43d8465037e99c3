// The radiance that the picture is made from: denoised, or the accumulated mean.
#ifndef FB_LIB_SHOWN
#define FB_LIB_SHOWN
#include "lib/denoise.glsl"

vec3 shown_radiance(uint at) {
  return frame.denoise != 0u ? picture_color(picture_texel(at)) : mean_radiance.at[at].rgb;
}
#endif
