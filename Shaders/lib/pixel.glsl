// Which pixel an invocation works on, and the camera's rays. A workgroup of 64 covers 8x8 pixels in Morton order, so
// that eight neighbouring lanes hold 4x2 pixels.
#ifndef FB_LIB_PIXEL
#define FB_LIB_PIXEL
#include "lib/frame_bindings.glsl"
#include "shared/rng.h"

layout(local_size_x = 64) in;

uvec2 invocation_pixel() {
  uint i = gl_LocalInvocationID.x;
  uvec2 in_tile =
      uvec2((i & 1u) | ((i >> 1u) & 2u) | ((i >> 2u) & 4u), ((i >> 1u) & 1u) | ((i >> 2u) & 2u) | ((i >> 3u) & 4u));
  return gl_WorkGroupID.xy * 8u + in_tile;
}

// The pixel of a block at which light is sampled in this frame; at the picture's edge perhaps beyond it.
uvec2 light_pixel(uvec2 block) { return block * frame.light_block + uvec2(frame.light_x, frame.light_y); }

// The place of a pixel's block among all, for arrays of one element a lit pixel (ArrayRow::Per::kPixel).
uint lit_index(uvec2 pixel) { return pixel.y / frame.light_block * frame.light_width + pixel.x / frame.light_block; }

uvec2 medium_pixel(uvec2 block) { return block * frame.medium_block + uvec2(frame.medium_x, frame.medium_y); }

// Where in its pixel a camera ray goes through, from the middle.
vec2 jitter_of(uvec2 pixel) {
  vec2 jitter = vec2(frame.jitter_x, frame.jitter_y);
  if (frame.jitter_seed == 0u) return jitter;
  uint start = hash_combine(pixel.y * frame.width + pixel.x, frame.jitter_seed);
  return fract(jitter + 0.5 + vec2(start >> 16u, start & 0xffffu) / 65536.0) - 0.5;
}

// Direction through a point of the image, in pixels from the top left; not normalised: its component along the camera's
// forward axis is 1.
vec3 camera_direction(vec2 point) {
  vec2 s = point / vec2(frame.width, frame.height) * 2.0 - 1.0;
  return frame.camera_forward.xyz + s.x * frame.camera_right.xyz - s.y * frame.camera_up.xyz;
}

// Where a world point was in the previous frame's image, in pixels; w of the result is its depth (<= 0: behind).
vec3 previous_pixel(vec3 world) {
  vec3 d = world - frame.prev_camera_position.xyz;
  float depth = dot(d, frame.prev_camera_forward.xyz);
  vec3 right = frame.prev_camera_right.xyz, up = frame.prev_camera_up.xyz;
  vec2 s = vec2(dot(d, right) / dot(right, right), -dot(d, up) / dot(up, up)) / depth;
  return vec3((s * 0.5 + 0.5) * vec2(frame.width, frame.height), depth);
}
#endif
