// Lights from frame to frame: a light is (instance, triangle), and instances are numbered anew each frame.
#ifndef FB_LIB_LIGHT_IDS
#define FB_LIB_LIGHT_IDS
#include "lib/frame_bindings.glsl"
#include "lib/scene_bindings.glsl"

// A light of the former frame as this frame numbers it; x is kNoIndex where it is gone. For techniques that want the
// list of lights.
uvec2 light_now(uvec2 former) {
  uint at = frame.former_first + former.x;
  return uvec2(at < frame.former_end ? light_at(at).x : kNoIndex, former.y);
}

// Element of the list of lights that stands for a light; kNoIndex: it does not glow.
uint light_element(uvec2 light) {
  if (light.x == kNoIndex || light_at(light.x).x == kNoIndex) return kNoIndex;
  return light_at(light.x).x + light.y;
}
#endif
