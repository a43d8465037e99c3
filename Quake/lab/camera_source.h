// A source seen from one place.
#pragma once

#include <memory>

#include "lab/frame_source.h"

namespace fb::lab {

// `camera` in the place of the source's, in every frame. A field of view of 0 is the source's own.
std::unique_ptr<FrameSource> camera_source(std::unique_ptr<FrameSource> source, const scene::Camera& camera);

}  // namespace fb::lab
