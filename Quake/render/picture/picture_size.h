// How large a picture is rendered, and how large it may be on a device.
#pragma once

#include <cstdint>

#include "base/maths.h"
#include "gpu/device.h"
#include "render/picture/denoiser.h"
#include "render/passes/settings.h"
#include "scene/draw_list.h"
#include "shared/frame.h"

namespace fb::render {

// Rendered width relative to the shown one's: r_scale, or one over it where it is QuakeSpasm's whole number.
float rendered_fraction(const RenderSettings& settings);

// The part of an output that shows the picture: the area that is asked for, as far as it lies within; all of it where
// none does.
scene::Area area_within(scene::Area asked, uvec2 output);

// What is rendered for an output of this size (r_scale).
uvec2 scaled_size(uvec2 output, const RenderSettings& settings);

// The scale at which no more than so many pixels of an output are rendered, at most 1.
float scale_for_pixels(uvec2 output, float pixels);

// What a pixel's memory depends on beside the settings.
struct PictureParts {
  std::uint32_t gbuffer_planes = sizeof(shared::GBufferTexel) / 16;
  Denoiser::Blocks blocks;  // of the denoiser's layers
};

// The largest output of about this shape, at most this size, of which no buffer is larger than the device's limits.
uvec2 largest_output(const gpu::DeviceLimits& limits, uvec2 output, const RenderSettings& settings,
                     const PictureParts& parts = {});

// Throws OutOfMemory, with a size that would do, where the device's limits do not allow the picture.
void check_picture_size(const gpu::Device& device, uvec2 output, const RenderSettings& settings,
                        const PictureParts& parts);

}  // namespace fb::render
