// Anti-aliasing of the finished picture by its edges: where luma changes sharply, the pixel is blended along the edge's
// direction, which the gradient of a 3x3 neighbourhood gives (the idea of Lottes 2009). Off: a copy.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"

vec3 ldr_at(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(frame.width, frame.height) - 1);
  return unpackUnorm4x8(ldr.at[uint(p.y) * frame.width + uint(p.x)]).rgb;
}
float luma(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }
vec3 ldr_bilinear(vec2 p) {
  vec2 base = floor(p), f = p - base;
  ivec2 i = ivec2(base);
  return mix(mix(ldr_at(i), ldr_at(i + ivec2(1, 0)), f.x), mix(ldr_at(i + ivec2(0, 1)), ldr_at(i + ivec2(1, 1)), f.x),
             f.y);
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  if (frame.fxaa == 0u || frame.debug_view != 0u) {
    smoothed.at[at] = ldr.at[at];
    return;
  }
  ivec2 p = ivec2(pixel);
  vec3 centre = ldr_at(p);
  float nw = luma(ldr_at(p + ivec2(-1, -1))), n = luma(ldr_at(p + ivec2(0, -1))), ne = luma(ldr_at(p + ivec2(1, -1)));
  float w = luma(ldr_at(p + ivec2(-1, 0))), c = luma(centre), e = luma(ldr_at(p + ivec2(1, 0)));
  float sw = luma(ldr_at(p + ivec2(-1, 1))), s = luma(ldr_at(p + ivec2(0, 1))), se = luma(ldr_at(p + ivec2(1, 1)));
  float low = min(c, min(min(n, s), min(w, e))), high = max(c, max(max(n, s), max(w, e)));
  if (high - low < max(0.05, high * 0.125)) {
    smoothed.at[at] = ldr.at[at];
    return;
  }
  vec2 gradient = vec2(ne + 2.0 * e + se - nw - 2.0 * w - sw, sw + 2.0 * s + se - nw - 2.0 * n - ne);
  vec2 along = vec2(-gradient.y, gradient.x);
  float scale = max(abs(along.x), abs(along.y));
  vec3 color = centre;
  if (scale > 1e-4) {
    along /= scale;
    vec2 q = vec2(p);
    vec3 near = 0.5 * (ldr_bilinear(q - along * 0.5) + ldr_bilinear(q + along * 0.5));
    vec3 wide = 0.5 * near + 0.25 * (ldr_bilinear(q - along * 1.5) + ldr_bilinear(q + along * 1.5));
    float y = luma(wide);
    color = y < low || y > high ? near : wide;
  }
  smoothed.at[at] = packUnorm4x8(vec4(color, 1.0));
}
