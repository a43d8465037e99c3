// Set 1 and the uniform block, for every pass.
#ifndef FB_LIB_FRAME_BINDINGS
#define FB_LIB_FRAME_BINDINGS
#include "shared/frame.h"

layout(set = 0, binding = 16, std140) uniform FrameBlock { FrameConstants frame; };

layout(set = 1, binding = 0, std430) buffer GBufferBlock { GBufferTexel gbuffer[]; };
layout(set = 1, binding = 1, std430) buffer RadianceBlock { vec4 radiance[]; };
layout(set = 1, binding = 2, std430) buffer MeanBlock { vec4 mean_radiance[]; };
layout(set = 1, binding = 3, std430) buffer M2Block { vec4 m2_radiance[]; };
layout(set = 1, binding = 4, std430) buffer LdrBlock { uint ldr[]; };
layout(set = 1, binding = 5, std430) buffer SmoothBlock { uint smoothed[]; };
layout(set = 1, binding = 6, std430) buffer OutputBlock { uint output_pixels[]; };
layout(set = 1, binding = 7, std430) buffer ExposureBlock { ExposureState exposure_state; uint histogram[]; };
layout(set = 1, binding = 8, std430) readonly buffer QuadBlock { GpuQuad quads[]; };
layout(set = 1, binding = 9, std430) readonly buffer TileBlock { uint tiles[]; };
layout(set = 1, binding = 10, std430) readonly buffer AtlasBlock { uint atlas[]; };
layout(set = 1, binding = 11, std430) buffer CounterBlock { uint counters[]; };

// The guide's (passes that do not learn leave them alone).
layout(set = 1, binding = 12, std430) buffer GuideStateBlock { uvec4 guide_states[]; };
layout(set = 1, binding = 13, std430) buffer GuideProposalBlock { uvec4 guide_proposals[]; };
layout(set = 1, binding = 14, std430) buffer GuideCacheBlock { uint guide_cache[]; };
#endif
