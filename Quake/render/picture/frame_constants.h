// The uniform block of a frame, from the snapshot and the settings.
#pragma once

#include "base/maths.h"
#include "render/passes/settings.h"
#include "scene/snapshot.h"
#include "shared/frame.h"

namespace fb::render {

// Where image planes lie: axes of scene::Camera, right and up scaled by the tangents of half the fields of view.
struct CameraFrame {
  vec3 position, forward, right, up;
};
CameraFrame camera_frame(const scene::Camera& camera, std::uint32_t width, std::uint32_t height);

// The snapshot's camera now, as r_waterwarp 2 has its field of view in a liquid; and before.
CameraFrame view_frame(const scene::FrameSnapshot& snapshot, const RenderSettings& settings, uvec2 size);
CameraFrame former_view_frame(const scene::FrameSnapshot& snapshot, const RenderSettings& settings, uvec2 size);

// Whether waves distort the picture.
bool warps_picture(const scene::FrameSnapshot& snapshot, const RenderSettings& settings);

// Tangent of half the angle that a pixel subtends, of a picture of so many rows.
float half_pixel_tangent(const CameraFrame& camera, std::uint32_t height);

// Points of a low-discrepancy sequence (Roberts 2018, R2) in [-1/2, 1/2)^2, where rays go through their pixels.
vec2 jitter_at(std::uint32_t index);
// Sets the frame's jitter by r_jitter; `c` is complete otherwise. 0: none. -1: frames that accumulate, and `moving`
// ones (which anti-aliasing over time wants jittered), take the next point of the sequence. 1: every frame does, the
// sequence begins at another place for every seed (and frame, where frames do not accumulate), and pixels shift it by a
// hash of their own, so that their errors are independent; not with the denoiser or footprints, which need one jitter
// for all pixels.
void fill_jitter(shared::FrameConstants& c, const RenderSettings& settings, std::uint32_t frame, bool moving);
// Where anti-aliasing, whose picture is `smooth`, reads the rendered one.
void fill_taps(shared::FrameConstants& c, uvec2 render, uvec2 smooth);

// Camera, sky, suns, time, sizes. What depends on the renderer's history (accumulation, jitter, adaptation) is left to
// it.
shared::FrameConstants frame_constants(const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                                       uvec2 render, uvec2 output);

}  // namespace fb::render
