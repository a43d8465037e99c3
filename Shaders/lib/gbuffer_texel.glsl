// The G-buffer as passes read it after it was drawn: four words at once, through a texel buffer where that is faster.
#ifndef FB_LIB_GBUFFER_TEXEL
#define FB_LIB_GBUFFER_TEXEL
#include "lib/frame_bindings.glsl"
#include "lib/read_texels.glsl"

FB_FRAME_ARRAY(kBindGBuffer, 16, readonly, GBufferQuadArray, uvec4, gbuffer_quads)
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsGBuffer) uniform usamplerBuffer gbuffer_texels;

uvec4 gbuffer_quad(uint at, uint quad) {
  return READ_TEXELS ? texelFetch(gbuffer_texels, int(at * 5u + quad)) : gbuffer_quads.at[at * 5u + quad];
}

GBufferTexel gbuffer_at(uint at) {
  uvec4 words = gbuffer_quad(at, 3u);
  return GBufferTexel(uintBitsToFloat(gbuffer_quad(at, 0u)), uintBitsToFloat(gbuffer_quad(at, 1u)),
                      uintBitsToFloat(gbuffer_quad(at, 2u)), words.x, words.y, words.z, words.w,
                      uintBitsToFloat(gbuffer_quad(at, 4u)));
}
#endif
