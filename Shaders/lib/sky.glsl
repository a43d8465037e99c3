// The sky's radiance by direction: Quake's two scrolling layers, six images of a box, or one colour; and suns, discs of
// their angular radius.
#ifndef FB_LIB_SKY
#define FB_LIB_SKY
#include "lib/frame_bindings.glsl"
#include "lib/texture.glsl"
#include "shared/sun_disc.h"

// Quake's projection of its layers: a flattened dome, 128 texels a repeat, scrolling.
vec2 layer_uv(vec3 d, float texels_per_second) {
  vec3 flat_d = vec3(d.xy, d.z * 3.0);
  vec2 at = d.xy * (6.0 * 63.0 / max(length(flat_d), 1e-6));
  return (at + frame.time * texels_per_second) / 128.0;
}

// Face and place in it of a box seen from inside: rt bk lf ft up dn; "rt" is towards +x, where Quake looks at yaw 0.
uint box_face(vec3 d, out vec2 uv) {
  vec3 a = abs(d);
  uint face;
  vec2 s;
  if (a.x >= a.y && a.x >= a.z) {
    face = d.x > 0.0 ? frame.sky_box0 : frame.sky_box2;
    s = vec2(d.x > 0.0 ? -d.y : d.y, -d.z) / a.x;
  } else if (a.y >= a.z) {
    face = d.y > 0.0 ? frame.sky_box1 : frame.sky_box3;
    s = vec2(d.y > 0.0 ? d.x : -d.x, -d.z) / a.y;
  } else {
    face = d.z > 0.0 ? frame.sky_box4 : frame.sky_box5;
    s = vec2(-d.y, d.z > 0.0 ? d.x : -d.x) / a.z;
  }
  uv = s * 0.5 + 0.5;
  return face;
}

// Texels of layers or of a box. One fetch in a loop: a driver's compiler takes long over every copy of it.
vec3 sky_texture(vec3 direction) {
  bool layers = frame.sky_mode == kSkyLayers;
  uint count = layers && frame.sky_alpha != kNoIndex ? 2u : 1u;
  vec3 color = vec3(0.0);
  uint i = 0u;
  do {
    vec2 uv;
    uint image = box_face(direction, uv);
    if (layers) {
      image = i == 0u ? frame.sky_solid : frame.sky_alpha;
      uv = layer_uv(direction, i == 0u ? 8.0 : 16.0);
    }
    if (image == kNoIndex) break;
    Texel texel = nearest_texel(image, uv, !layers);
    color = mix(color, texel.color, i == 0u ? 1.0 : texel.alpha);
  } while (++i < count);
  return color;
}

vec3 sky_radiance(vec3 direction) {
  vec3 color = frame.sky_even.rgb;
  if (frame.sky_mode == kSkyConstant)
    color += frame.sky_color.rgb;
  else if (has_feature(kFeatureSkyTexture) && frame.sky_mode >= kSkyLayers)
    color += sky_texture(direction) * frame.sky_color.rgb;
  if (has_feature(kFeatureSuns) && frame.sun_count > 0u) {
    uint i = 0u;
    do {
      if (within_sun(direction, frame.sun_direction[i].xyz, frame.sun_direction[i].w))
        color += frame.sun_radiance[i].rgb;
    } while (++i < frame.sun_count);
  }
  return color;
}
#endif
