// Luminance and the exposure histogram's bins.
#ifndef FB_LIB_EXPOSURE
#define FB_LIB_EXPOSURE
#include "shared/color.h"
#include "shared/frame.h"

const float kMinLog2Luminance = -14.0;
const float kLog2PerBin = 0.1875;

uint luminance_bin(float y) {
  return uint(clamp((log2(y) - kMinLog2Luminance) / kLog2PerBin, 0.0, float(kHistogramBins) - 1.0));
}
float bin_log2_luminance(uint bin) { return kMinLog2Luminance + (float(bin) + 0.5) * kLog2PerBin; }
#endif
