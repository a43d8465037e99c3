// The sky's radiance by direction: Quake's two scrolling layers, six images of a box, or one colour; and suns, discs of
// their angular radius.
#ifndef FB_LIB_SKY
#define FB_LIB_SKY
#include "lib/frame_bindings.glsl"
#include "lib/texture.glsl"

const uint kSkyConstant = 1u;
const uint kSkyLayers = 2u;
const uint kSkyBox = 3u;

// Quake's projection: a flattened dome, 128 texels a repeat; layers scroll at 8 and 16 texels a second.
vec3 sky_layers(vec3 d) {
  vec3 flat_d = vec3(d.xy, d.z * 3.0);
  vec2 at = d.xy * (6.0 * 63.0 / max(length(flat_d), 1e-6));
  vec2 uv_solid = (at + frame.time * 8.0) / 128.0, uv_alpha = (at + frame.time * 16.0) / 128.0;
  vec3 color = nearest_texel(frame.sky_solid, uv_solid, false).color;
  if (frame.sky_alpha != kNoIndex) {
    Texel front = nearest_texel(frame.sky_alpha, uv_alpha, false);
    color = mix(color, front.color, front.alpha);
  }
  return color;
}

// Faces in the order rt bk lf ft up dn, seen from inside; Quake looks along +x at yaw 0, where "rt" is.
vec3 sky_box(vec3 d) {
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
  if (face == kNoIndex) return vec3(0.0);
  return nearest_texel(face, s * 0.5 + 0.5, true).color;
}

vec3 sky_radiance(vec3 direction) {
  vec3 color = vec3(0.0);
  if (frame.sky_mode == kSkyConstant) color = frame.sky_color.rgb;
  else if (frame.sky_mode == kSkyLayers) color = sky_layers(direction) * frame.sky_color.rgb;
  else if (frame.sky_mode == kSkyBox) color = sky_box(direction) * frame.sky_color.rgb;
  for (uint i = 0u; i < frame.sun_count; ++i) {
    if (dot(direction, frame.sun_direction[i].xyz) >= frame.sun_direction[i].w) color += frame.sun_radiance[i].rgb;
  }
  return color;
}
#endif
