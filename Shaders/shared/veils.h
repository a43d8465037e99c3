// Liquids of which the camera sees two surfaces without refraction: its own and what shines through (r_water 0).
#ifndef FB_SHARED_VEILS
#define FB_SHARED_VEILS
#include "shared/common.h"

FB_NAMESPACE_BEGIN

// Beside kFeature* (kSpecFeatures): some liquid is translucent, and no interface is in the scene.
FB_CONST uint kFeatureVeils = 128u;

FB_NAMESPACE_END
#endif
