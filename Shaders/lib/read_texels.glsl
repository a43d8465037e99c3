#ifndef FB_LIB_READ_TEXELS
#define FB_LIB_READ_TEXELS
#include "shared/bindings.h"

// Arrays that have a texel buffer are read through it: faster than storage buffers on lavapipe.
layout(constant_id = kSpecReadTexels) const bool READ_TEXELS = false;
#endif
