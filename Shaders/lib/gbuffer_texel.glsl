// The G-buffer: a plane for each four words of GBufferTexel, so that a pass that wants one reads no other's memory.
// Read through a texel buffer where that is faster.
#ifndef FB_LIB_GBUFFER_TEXEL
#define FB_LIB_GBUFFER_TEXEL
#include "lib/frame_bindings.glsl"

FB_FRAME_ARRAY(kBindGBuffer, 16, , GBufferArray, uvec4, gbuffer)
FB_FRAME_ARRAY(kBindPreviousGBuffer, 16, readonly, PreviousGBufferArray, uvec4, previous_gbuffer)
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsGBuffer) uniform usamplerBuffer gbuffer_texels;

uint in_plane(uint plane, uint at) { return plane * frame.width * frame.height + at; }

uvec4 gbuffer_quad(uint at, uint plane) { return texelFetch(gbuffer_texels, int(in_plane(plane, at))); }

GBufferTexel gbuffer_texel(uvec4 position, uvec4 albedo, uvec4 emission, uvec4 words, uvec4 motion) {
  return GBufferTexel(uintBitsToFloat(position), uintBitsToFloat(albedo), uintBitsToFloat(emission), words.x, words.y,
                      words.z, words.w, uintBitsToFloat(motion));
}
GBufferTexel gbuffer_at(uint at) {
  return gbuffer_texel(gbuffer_quad(at, 0u), gbuffer_quad(at, 1u), gbuffer_quad(at, 2u), gbuffer_quad(at, 3u),
                       gbuffer_quad(at, 4u));
}
GBufferTexel previous_gbuffer_at(uint at) {
  return gbuffer_texel(previous_gbuffer.at[in_plane(0u, at)], previous_gbuffer.at[in_plane(1u, at)],
                       previous_gbuffer.at[in_plane(2u, at)], previous_gbuffer.at[in_plane(3u, at)],
                       previous_gbuffer.at[in_plane(4u, at)]);
}
void store_gbuffer(uint at, GBufferTexel t) {
  gbuffer.at[in_plane(0u, at)] = floatBitsToUint(t.position_t);
  gbuffer.at[in_plane(1u, at)] = floatBitsToUint(t.albedo_roughness);
  gbuffer.at[in_plane(2u, at)] = floatBitsToUint(t.emission_specular);
  gbuffer.at[in_plane(3u, at)] = uvec4(t.normal, t.shading_normal, t.id, t.material_metalness);
  gbuffer.at[in_plane(4u, at)] = floatBitsToUint(t.motion);
}
#endif
