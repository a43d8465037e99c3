// Step `views`: what reservoirs hold.
#include "lib/store_light.glsl"
#include "shared/color.h"

const bool kHasViews = true;

void draw_view(PathPixel p, bool lit, Vertex v) {
  LightReservoir r = unpack_light(final_reservoirs.at[lit_index(p.pixel)]);
  vec3 color = vec3(0.0);
  if (frame.debug_view == kViewRestirAge) {
    color = r.age == 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(r.age / 64.0);
  } else if (frame.debug_view == kViewRestirConfidence) {
    color = vec3(r.confidence / 64.0);
  } else if (frame.debug_view == kViewRestirLamp) {
    uint h = hash_combine(r.chosen.name, 0x9e3779b9u);
    color = vec3(h & 0xffu, (h >> 8u) & 0xffu, (h >> 16u) & 0xffu) / 255.0;
  } else {
    color = vec3(log2(max(r.weight, 1e-12)) / 40.0 + 0.5);
  }
  if (!reuses(r))
    color = vec3(0.5);
  else if (r.chosen.name == 0u || !lit)
    color = vec3(0.0);
  ldr.at[p.at] = packUnorm4x8(vec4(clamp(color, 0.0, 1.0), 1.0));
}
