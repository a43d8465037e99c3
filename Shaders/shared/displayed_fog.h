// Quake's fog mixes the bytes that displays decode, by T = exp(-(density z / 64)^2). As light, T^(1.4 k) of what is
// behind and (1 - T^k)^1.4 of the fog is near to that, with k by how bright the fog is: 0.2 to 0.26 stops rms for fogs
// of all brightness and walls of 0.3 to 60% (k 1: 0.2 to 0.36).
#ifndef FB_SHARED_DISPLAYED_FOG_H
#define FB_SHARED_DISPLAYED_FOG_H
#include "shared/color.h"
#include "shared/medium.h"
FB_NAMESPACE_BEGIN

// k of a fog of this colour, as displayed.
FB_FN float displayed_fog_rate(vec3 displayed) { return 1.07f - 0.32f * luminance(displayed); }

FB_NAMESPACE_END
#endif
