// What a frame does only where some pixel needs it (shared/work.h), and the G-buffer, which finds that out.
#pragma once

#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "render/passes/pass.h"
#include "render/passes/shader_set.h"
#include "shared/frame.h"

namespace fb::render {

// `counters`: kBindCounters. `constants`: of the frame, filled.
struct Work {
  const gpu::Buffer& counters;
  const shared::FrameConstants& constants;

  // Of a dispatch of this kind.
  AskedGroups groups(std::uint32_t kind) const;
  // Before the G-buffer: nothing is asked for yet, but what fog scatters, at every pixel.
  void begin(gpu::Commands& commands) const;
};

// In two passes where there are interfaces (`variant.water`): what is seen without them, and then by way of them, in
// the tiles that show some or, if the camera is in a liquid, everywhere. `tiles`: kBindLdr, whose contents are lost.
void add_gbuffer(PassList& list, ShaderSet& shaders, const Variant& variant, const Work& work,
                 const gpu::Buffer& tiles);

}  // namespace fb::render
