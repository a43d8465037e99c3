// Dispatches that a frame has only where some pixel needs them: the G-buffer's shader asks for them. Each is a
// VkDispatchIndirectCommand in kBindCounters, for this frame and the former one in turns.
#ifndef FB_SHARED_WORK_H
#define FB_SHARED_WORK_H
#include "shared/frame.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kWorkMedium = 0u;  // over the medium's blocks: light is scattered to the camera
FB_CONST uint kWorkSecond = 1u;  // over the light's blocks: a pixel shows two surfaces
FB_CONST uint kWorkWater = 2u;   // over tiles that show an interface (lib/water_tiles.glsl)
FB_CONST uint kWorkKinds = 3u;
FB_CONST uint kWorkWords = 4u;  // workgroups in x, 0: not asked for; y; z; of kWorkWater the tiles

// Index of its first word. `parity`: FrameConstants::work_parity, or the other for the former frame.
FB_FN uint work_word(uint kind, uint parity) { return kCounterFirstWork + kWorkWords * (kWorkKinds * parity + kind); }

FB_NAMESPACE_END
#endif
