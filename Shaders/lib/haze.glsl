// Fog on the camera's ways.
#ifndef FB_LIB_HAZE
#define FB_LIB_HAZE
#include "lib/frame_bindings.glsl"
#include "shared/medium.h"

Haze camera_haze() { return Haze(frame.camera_fog, frame.camera_fog_square); }
#endif
