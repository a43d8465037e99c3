// From linear radiance to the tone-mapped picture: what the eye and the lens do. Exposure by the histogram, exposure by
// place, bloom and the tone curve, or the debug view in their place.
#pragma once

#include "base/maths.h"
#include "render/passes/pass.h"
#include "render/passes/shader_set.h"
#include "shared/frame.h"

namespace fb::render {

// `layered`: of a pass that knows the denoiser's layers; `traced`: of one that traces the camera's rays.
void add_lens(PassList& list, ShaderSet& shaders, const shared::FrameConstants& constants, const Variant& layered,
              const Variant& traced);

}  // namespace fb::render
