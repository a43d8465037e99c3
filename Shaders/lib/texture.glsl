// Texels from the one buffer that holds them all: palette indices, grey bytes, or RGBA words. The filter is ours, so
// that it is the same on every device.
#ifndef FB_LIB_TEXTURE
#define FB_LIB_TEXTURE
#include "lib/scene_records.glsl"
#include "shared/kinds.h"

layout(constant_id = kSpecFeatures) const uint FEATURES = kFeaturesAll;
bool has_feature(uint feature) { return (FEATURES & feature) != 0u; }

const uint kFirstFullbright = 224u;
const uint kTransparentIndex = 255u;

struct Texel {
  vec3 color;   // linear Rec.709
  float alpha;  // 0 or 1 for palette images
  bool glows;   // palette index 224..255
};

Texel fetch_texel(uint image_index, ivec2 p) {
  GpuImage image = image_at(image_index);
  uint at = image.first + uint(p.y) * (image.size & 0xffffu) + uint(p.x);
  bool indexed = image.encoding == kEncodingPalette, gray = image.encoding == kEncodingGray;
  uint word = texels.at[indexed || gray ? at >> 2u : at];
  uint index = (word >> ((at & 3u) * 8u)) & 0xffu;
  uvec3 bytes = (uvec3(word) >> uvec3(0u, 8u, 16u)) & 0xffu;
  Texel texel;
  texel.color = palette_at(indexed ? uvec3(index) : kPaletteSrgb + bytes);
  if (image.encoding >= kEncodingLinear) texel.color = vec3(gray ? uvec3(index) : bytes) / 255.0;
  texel.alpha = indexed ? (index == kTransparentIndex ? 0.0 : 1.0) : gray ? 1.0 : float(word >> 24u) / 255.0;
  texel.glows = indexed && index >= kFirstFullbright;
  return texel;
}

ivec2 image_size(uint image_index) {
  uint size = image_at(image_index).size;
  return ivec2(size & 0xffffu, size >> 16u);
}

// uv in repeats of the texture.
ivec2 texel_position(uint image_index, vec2 uv, bool clamped) {
  ivec2 size = image_size(image_index);
  uv = clamped ? clamp(uv, vec2(0.0), vec2(1.0)) : uv - floor(uv);
  return min(ivec2(uv * vec2(size)), size - 1);
}

Texel nearest_texel(uint image_index, vec2 uv, bool clamped) {
  return fetch_texel(image_index, texel_position(image_index, uv, clamped));
}
#endif
