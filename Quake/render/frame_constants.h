// The uniform block of a frame, from the snapshot and the settings.
#pragma once

#include "base/maths.h"
#include "render/settings.h"
#include "scene/snapshot.h"
#include "shared/frame.h"

namespace fb::render {

// Where image planes lie: axes of scene::Camera, right and up scaled by the tangents of half the fields of view.
struct CameraFrame {
  vec3 position, forward, right, up;
};
CameraFrame camera_frame(const scene::Camera& camera, std::uint32_t width, std::uint32_t height);

// Tangent of half the angle that a pixel subtends, of a picture of so many rows.
float half_pixel_tangent(const CameraFrame& camera, std::uint32_t height);

// Camera, sky, suns, time, sizes. What depends on the renderer's history (accumulation, jitter, adaptation) is left to
// it.
shared::FrameConstants frame_constants(const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                                       uvec2 render, uvec2 output);

}  // namespace fb::render
