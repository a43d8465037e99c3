// Step `views`: what the cell at a pixel knows.
#ifndef FB_PSTF_STEPS_VIEWS
#define FB_PSTF_STEPS_VIEWS
#include "estimators/pstf/pstf_mixture.h"
#include "estimators/pstf/steps/guidance.glsl"
#include "lib/store_light.glsl"
#include "shared/tone.h"

const bool kHasViews = true;

vec3 beta_color(float beta) { return vec3(1.0 - abs(beta), beta < 0.0 ? 0.8 : 0.2, abs(beta)); }

void draw_view(PathPixel p, bool lit, Vertex v) {
  vec3 color = vec3(0.0);
  if (lit) {
    Path path = path_of(p, 0u);
    uint rng = rng_seed(p.at, frame.frame, 0u, frame.seed);
    path.own.group_rng = rng;
    Field here = field_at(v, path);
    Guidance g;
    prepare_cell(v, here, path, g);
    bool known = here.place.slot != kNoIndex;
    if (frame.debug_view == kViewPstfField)
      color = known ? srgb_from_linear(filmic(outgoing_light(here.place.slot, g.normal) * exposure_now()))
                    : vec3(0.5, 0.0, 0.5);
    else if (frame.debug_view == kViewPstfBeta)
      color = known ? beta_color(kHasTrees ? learnt_mixture_beta(g.moments) : learnt_beta(g.moments)) : vec3(0.0);
    else
      color = known ? 0.5 + g.light.b * (0.5 / kMostSlope) : vec3(0.0);
  }
  ldr.at[p.at] = packUnorm4x8(vec4(clamp(color, 0.0, 1.0), 1.0));
}
#endif
