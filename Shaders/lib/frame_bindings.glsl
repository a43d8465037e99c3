// The frame's constants and arrays, for every pass.
#ifndef FB_LIB_FRAME_BINDINGS
#define FB_LIB_FRAME_BINDINGS
#include "lib/arrays.glsl"
#include "shared/frame.h"

layout(set = kSetScene, binding = kBindFrameConstants, std140) uniform FrameBlock { FrameConstants frame; };

FB_FRAME_ARRAY(kBindRadiance, 16, , RadianceArray, vec4, radiance)
FB_FRAME_ARRAY(kBindMean, 16, , MeanArray, vec4, mean_radiance)
FB_FRAME_ARRAY(kBindM2, 16, , M2Array, vec4, m2_radiance)
FB_FRAME_ARRAY(kBindLdr, 4, , LdrArray, uint, ldr)
FB_FRAME_ARRAY(kBindSmooth, 4, , SmoothArray, uint, smoothed)
FB_FRAME_ARRAY(kBindOutput, 4, , OutputArray, uint, output_pixels)
FB_FRAME_ARRAY(kBindExposure, 16, , ExposureArray, ExposureBuffer, exposure_buffer)
FB_FRAME_ARRAY(kBindCounters, 4, , CounterArray, uint, counters)

// Factor from radiance to what the tone curve takes.
float exposure_now() { return exposure_buffer.at[0].state.exposure; }
#endif
