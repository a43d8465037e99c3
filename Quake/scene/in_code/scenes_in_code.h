// Snapshots made by functions, with their own Assets: the exact cases of tests and of the laboratory. No file is read.
// All emission is EmissionKind::kConstant, so that no cvar scales it.
#pragma once

#include <cstdint>
#include <memory>

#include "scene/snapshot.h"

namespace fb::scene {

// A closed cube of side 256 about the camera; every surface reflects `albedo` (Lambert) and emits `emission`. The
// radiance after n bounces is emission * (1 + albedo + ... + albedo^n) everywhere, whatever stands inside: with
// `objects` there are a box, a sphere and a tetrahedron of the same material, each an instance of its own.
FrameSnapshot furnace(float albedo, float emission, bool objects = false);

enum class CornellVariant {
  kDiffuse,
  kGlossy,  // the tall box is rough metal, the floor has a dielectric coat
};
// The Cornell box: 560 units a side, open towards the camera, a lamp of radiance (17, 12, 4) in the ceiling, black
// beyond. The two boxes are instances with transforms.
FrameSnapshot cornell_box(CornellVariant variant = CornellVariant::kDiffuse);

// A closed room of half side 128 with one sphere of `radius` and `radiance` at its centre; the camera, near the
// ceiling beside the sphere, looks down on the floor, whose middle point is (0, 0, -128). Direct light alone leaves
// albedo * radiance * radius^2 cos / d^2 at a floor point at distance d from the centre (exact for a true sphere; the
// mesh of 80 triangles has its area, see shapes.h).
FrameSnapshot one_light(float radius, float radiance, float albedo);

// A wide hall (1024 x 1024 x 256) with `count` small spheres of random place and colour, the same for the same seed.
FrameSnapshot many_lights(std::uint32_t count, std::uint64_t seed = 1);

// For motion: a room with a rigid box that turns and moves, a posed mesh between two poses while it moves, and a view
// model that rides with a moving camera. All snapshots that share `assets` are frames of one film; ids in kMoving*.
std::shared_ptr<const Assets> moving_assets();
FrameSnapshot moving(const std::shared_ptr<const Assets>& assets, double time, double prev_time);
constexpr std::uint32_t kMovingBox = kIdEntity + 1, kMovingPosed = kIdEntity + 2, kMovingViewModel = kIdViewModel;

// A panel with an alpha-tested texture (a chequer of 8 x 8 fields, every other one a hole) in front of a glowing wall;
// the panel itself is black. Half of the panel's area shows the wall.
FrameSnapshot alpha_panel();

// One quad that fills most of the picture, with a 16 x 16 texture of all palette indices (code_palette()), Lambert, no
// fullbright, under a sky of radiance 1 all around: its radiance is the texel's linear colour.
FrameSnapshot textured_quad();

// The palette of scenes in code: index i has red 17 (i mod 16), green 17 (i / 16), blue 255 - i.
formats::Palette code_palette();

}  // namespace fb::scene
