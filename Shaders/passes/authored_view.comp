// What QuakeSpasm shows of a map (r_debug authored): textures times baked light, as bytes that a display decodes, what glows, fog.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/seen_texel.glsl"
#include "shared/baked_words.h"
#include "shared/displayed_fog.h"
#include "shared/tone.h"

uint baked_word(uint at) { return texels.at[image_at(frame.baked_image).first + at]; }

float style_value(uint style) { return style < 64u ? frame.light_styles[style >> 2u][style & 3u] : 1.0; }

vec3 luxel(uint at) {
  uint word = baked_word(at);
  return vec3(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u) / kPaintedLuxel;
}

// Of all styles, between luxels; `point` where the map has the face.
vec3 baked_light(uint face, vec3 point) {
  if (frame.baked_image == kNoIndex || face >= frame.baked_faces) return vec3(1.0);
  uint record = face * kBakedFaceWords, size = baked_word(record + kBakedSize), styles = baked_word(record + kBakedStyles);
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

vec3 authored_color(vec3 direction, Hit hit) {
  bool missed = hit.instance == kNoIndex;
  if (missed && frame.sky_beyond == 0u) return vec3(0.0);
  Surface s = load_surface(hit, direction, kFilterNearest, missed, true);
  vec3 glow = srgb_from_linear(clamp(s.emission, 0.0, 1.0));
  bool fog = FEATURE_MEDIUM && frame.camera_fog_square > 0.0;
  vec3 fog_color = srgb_from_linear(frame.fog_glow.rgb);
  float depth = haze_depth(camera_haze(), hit.t) / (kDisplayedMix * displayed_fog_rate(fog_color));
  float left = s.sky ? 1.0 - pow(frame.fog_glow.w, 1.0 / kDisplayedMix) : exp(-depth);
  vec3 shown = glow;
  if (!s.sky) {
    uint record = instance_at(hit.instance).first_attribute + hit.triangle;
    GpuTriangle t = triangle_at(instance_at(hit.instance).first_triangle + hit.triangle);
    vec3 point = t.v0.xyz + t.e1.xyz * hit.bary.x + t.e2.xyz * hit.bary.y;
    vec3 painted = srgb_from_linear(clamp(s.bsdf.albedo, 0.0, 1.0));
    // Texels that glow are whole; an image of what glows is added.
    bool whole = s.emission != vec3(0.0) && material_at(s.material).luma == kNoIndex;
    shown = whole ? max(glow, painted) : painted * baked_light(attribute_at(record).face, point) + glow;
  }
  return fog ? mix(fog_color, min(shown, vec3(1.0)), left) : shown;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, rng = seen_rng(at);
  vec3 direction = normalize(camera_direction(point_of(pixel)));
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);
  ldr.at[at] = packUnorm4x8(vec4(clamp(authored_color(direction, hit), 0.0, 1.0), 1.0));
}
