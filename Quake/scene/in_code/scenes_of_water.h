// Scenes made in code whose light goes through an interface of water.
#pragma once

#include "scene/snapshot.h"

namespace fb::scene {

// Hard: all direct light on the floor is refracted, by one sine wave under a sun of half a degree, so that no straight
// ray finds it. A pool, 512 x 512, with its sky as a ceiling; the camera is under water and looks at the floor. Crests
// of the wave, at whole multiples of kRippleLength along x, focus the sun on the floor: paraxially at the depth 1 / ((1
// - 1 / n) a k^2).
constexpr float kRippleLength = 64.0f, kRippleHeight = 3.0f;  // a, k = 2 pi / length
constexpr float kRippleDepth = 128.0f;                        // of the floor, z = 0, under the mean surface
struct Ripple {
  float sun_radius = 0.5f;  // degrees
  bool lamps = false;       // one above the surface, one under it
  bool above = false;       // the camera is above it
  float scattering = 0.0f;  // of the water, 1/unit
};
FrameSnapshot ripple(const Ripple& kind = {});

// A dark bath whose ground glows like lava under 12 units of water, seen from its edge: nothing else gives light, and
// all of it has gone through the surface.
FrameSnapshot lava_bath();

}  // namespace fb::scene
