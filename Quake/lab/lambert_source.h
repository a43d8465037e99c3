// A source's frames with every material Lambert's alone: for comparison with renderers whose coats and normal maps
// differ.
#pragma once

#include <memory>

#include "lab/frame_source.h"

namespace fb::lab {

// No coats, metals, gloss images or normal maps; reflectance and emission stay.
std::unique_ptr<FrameSource> lambert_source(std::unique_ptr<FrameSource> source);

}  // namespace fb::lab
