// Step `views`: the lobes that pixels sample.
#include "lib/store_light.glsl"

const bool kHasViews = true;

void draw_view(PathPixel p, bool lit, Vertex v) {
  ChainState s = FB_LOAD_CHAIN(chain_lobes, lit_index(p.pixel));
  vec3 color = vec3(0.0);
  if (lit && is_valid_state(s)) {
    VmfLobe lobe = lobe_at(v, s);
    color = frame.debug_view == kViewSsmmCount
                ? vec3(0.05 + 0.95 * log2(s.count + 1.0) / log2(float(ssmm.ssmm_count) + 1.0))
                : (0.5 + 0.5 * lobe.mu) * clamp(0.2 + 0.06 * log2(lobe.kappa + 1.0), 0.0, 1.0);
  }
  ldr.at[p.at] = packUnorm4x8(vec4(color, 1.0));
}
