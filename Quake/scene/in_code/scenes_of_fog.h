// Scenes made in code whose point is the medium between the surfaces: single scattering that an integral gives, and
// shafts of light.
#pragma once

#include "scene/snapshot.h"

namespace fb::scene {

// A medium without end and one sphere that glows in it, kSlabRadius about kSlabLamp; nothing else, and black beyond.
// The camera is at the origin and looks along x, with the lamp in the picture. What a ray of the camera brings that
// passes by the lamp is an integral over the lamp's triangles and one along the ray. `g`: of Henyey and Greenstein's
// function.
FrameSnapshot slab(float extinction, float g);
const vec3 kSlabLamp(160.0f, 48.0f, 16.0f);
constexpr float kSlabRadius = 16.0f;
const vec3 kSlabRadiance(30.0f, 20.0f, 12.0f);

// A dark closed hall with fog, 512 x 384 x 256, into which a sun shines through the bars of a window in its left wall.
// The sun is 6 degrees in radius, so that reference paths find it by chance; the face of sky behind the bars is black
// but for it.
FrameSnapshot window();
constexpr float kWindowWall = 192.0f;  // y of the wall's inner side

}  // namespace fb::scene
