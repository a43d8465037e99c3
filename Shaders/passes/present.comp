// The finished picture in its place in the output: scaled up where it was rendered smaller, distorted where the camera
// is in a liquid (WARP), tinted, 2D drawing on top, then QuakeSpasm's contrast and gamma over all. Quads come binned
// into tiles by the host, in their drawing order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "shared/picture_warp.h"

FB_DRAW_ARRAY(kBindQuads, 16, readonly, QuadArray, GpuQuad, quads)
FB_DRAW_ARRAY(kBindTiles, 4, readonly, TileArray, uint, tiles)
FB_DRAW_ARRAY(kBindAtlas, 4, readonly, AtlasArray, uint, atlas)

vec3 smoothed_at(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(frame.smooth_width, frame.smooth_height) - 1);
  return unpackUnorm4x8(smoothed.at[uint(p.y) * frame.smooth_width + uint(p.x)]).rgb;
}

vec3 picture_at(uvec2 pixel) {
  vec2 size = vec2(frame.smooth_width, frame.smooth_height), shown = vec2(frame.picture_width, frame.picture_height);
#if WARP
  vec2 point = warped_point(vec2(pixel) + 0.5, shown, frame.warp_phase);
#else
  if (size == shown) return smoothed_at(ivec2(pixel));
  vec2 point = vec2(pixel) + 0.5;
#endif
  vec2 p = point * size / shown - 0.5;
  vec2 base = floor(p), f = p - base;
  ivec2 i = ivec2(base);
  return mix(mix(smoothed_at(i), smoothed_at(i + ivec2(1, 0)), f.x),
             mix(smoothed_at(i + ivec2(0, 1)), smoothed_at(i + ivec2(1, 1)), f.x), f.y);
}

vec3 draw_quad(GpuQuad quad, vec2 point, vec3 below) {
  if (any(lessThan(point, quad.rectangle.xy)) || any(greaterThanEqual(point, quad.rectangle.zw))) return below;
  vec4 color = quad.color;
  if (quad.uv.xy != quad.uv.zw) {
    vec2 s = (point - quad.rectangle.xy) / (quad.rectangle.zw - quad.rectangle.xy);
    uvec2 texel = uvec2(mix(quad.uv.xy, quad.uv.zw, s));
    color *= unpackUnorm4x8(atlas.at[texel.y * frame.atlas_width + texel.x]);
  }
  return mix(below, color.rgb, color.a);
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.output_width || pixel.y >= frame.output_height) return;
  uvec2 inside = pixel - uvec2(frame.picture_x, frame.picture_y);  // wraps where it is left of it or above
  vec3 color = vec3(0.0);
  if (inside.x < frame.picture_width && inside.y < frame.picture_height)
    color = mix(picture_at(inside), frame.screen_tint.rgb, frame.screen_tint.a);
  if (frame.draw_quads != 0u) {
    uint tile = (pixel.y / kDrawTile) * frame.quad_tiles_x + pixel.x / kDrawTile;
    for (uint i = tiles.at[2u * tile]; i < tiles.at[2u * tile + 1u]; ++i)
      color = draw_quad(quads.at[tiles.at[i]], vec2(pixel) + 0.5, color);
  }
  if (frame.gamma != 1.0 || frame.contrast != 1.0)
    color = pow(clamp(color * frame.contrast, 0.0, 1.0), vec3(frame.gamma));
  if (frame.swap_red_blue != 0u) color = color.bgr;
  output_pixels.at[pixel.y * frame.output_width + pixel.x] = packUnorm4x8(vec4(color, 1.0));
}
