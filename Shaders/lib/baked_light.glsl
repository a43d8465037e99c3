// A map's baked light where a ray met it (shared/baked_words.h).
#ifndef FB_LIB_BAKED_LIGHT
#define FB_LIB_BAKED_LIGHT
#include "lib/segment.glsl"
#include "shared/baked_words.h"

uint baked_word(uint at) { return texels.at[image_at(frame.baked_image).first + at]; }

float style_value(uint style) { return style < 64u ? frame.light_styles[style >> 2u][style & 3u] : 1.0; }

vec3 luxel(uint at) {
  uint word = baked_word(at);
  return vec3(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u) / kPaintedLuxel;
}

bool has_baked_light(Hit hit) {
  uint face = attribute_at(instance_at(hit.instance).first_attribute + hit.triangle).face;
  return frame.baked_image != kNoIndex && face < frame.baked_faces &&
         baked_word(face * kBakedFaceWords + kBakedKind) != kBakedWhole;
}

// What a display shows a texture times, of all styles, between luxels; 1 where the map says nothing: no face of a map,
// or one that it shows whole.
vec3 baked_light(Hit hit) {
  uint face = attribute_at(instance_at(hit.instance).first_attribute + hit.triangle).face;
  if (frame.baked_image == kNoIndex || face >= frame.baked_faces) return vec3(1.0);
  GpuTriangle t = triangle_at(instance_at(hit.instance).first_triangle + hit.triangle);
  vec3 point = t.v0.xyz + t.e1.xyz * hit.bary.x + t.e2.xyz * hit.bary.y;  // where the map has it
  uint record = face * kBakedFaceWords, size = baked_word(record + kBakedSize),
       styles = baked_word(record + kBakedStyles);
  if (baked_word(record + kBakedKind) == kBakedWhole) return vec3(1.0);
  if (size == 0u) return vec3(0.0);
  vec2 most = vec2(size & 0xffffu, size >> 16u) - 1.0, at;
  for (uint a = 0u; a < 2u; ++a) {
    vec4 axis;
    for (uint c = 0u; c < 4u; ++c) axis[c] = uintBitsToFloat(baked_word(record + kBakedAxes + 4u * a + c));
    float to = dot(axis.xyz, point) + axis.w;
    at[a] = to > 0.0 ? min(to, most[a]) : 0.0;
  }
  uvec2 low = uvec2(at), high = min(low + 1u, uvec2(most));
  vec2 f = at - vec2(low);
  uint row = size & 0xffffu, first = baked_word(record + kBakedFirst);
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < 4u; ++k) {
    uint style = (styles >> (8u * k)) & 255u, from = first + k * row * (size >> 16u);
    if (style == 255u) continue;
    vec3 upper = mix(luxel(from + low.y * row + low.x), luxel(from + low.y * row + high.x), f.x);
    vec3 lower = mix(luxel(from + high.y * row + low.x), luxel(from + high.y * row + high.x), f.x);
    sum += style_value(style) * mix(upper, lower, f.y);
  }
  return sum;
}
#endif
