#ifndef FB_LIB_READ_TEXELS
#define FB_LIB_READ_TEXELS
#include "shared/bindings.h"

// Arrays that have a texel buffer are read through it: nearly twice as fast as storage buffers on lavapipe before Mesa 24,
// slower after.
layout(constant_id = kSpecReadTexels) const bool READ_TEXELS = false;
#endif
