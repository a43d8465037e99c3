// The main function of every technique: a pixel's radiance is its emission, and the mean of frame.spp paths from its
// surface. The includer chooses the technique's steps (lib/path.glsl) before.
#include "lib/medium_path.glsl"
#include "lib/path.glsl"
#include "lib/store_light.glsl"

// The technique draws the picture itself: a debug view of its own. A constant, since lavapipe runs both sides of a
// branch.
layout(constant_id = kSpecShowView) const bool SHOW_VIEW = false;

// A technique that learns traces a frame's paths in parts, each every so many rows of workgroups
// (render/techniques/technique.h).
layout(push_constant) uniform Part { uint row_step, first_row; };

uvec2 block_of_part() {
  uint row = gl_WorkGroupID.y;
  return invocation_pixel() + uvec2(0u, 8u * (row * row_step + first_row - row));
}

void main() {
  PathPixel p = path_pixel(kLearns && !IN_MEDIUM ? block_of_part() : invocation_pixel());
  if (!within_picture(p)) return;
  if (IN_MEDIUM) {
    light_in_medium(p);
    return;
  }
  GBufferTexel g = gbuffer_at(p.at);
  Vertex v = first_vertex(g, p.pixel);
  bool lit = reflects_light(g);
  if (lit) {
    PixelLight light = no_light();
    uint i = 0u;
    do {
      Vertex first = v;
      uint rng;
      Path path = start_path(p, g, i, first, rng);
      add_sample(light, path, trace_path(first, path, rng));
    } while (++i < frame.spp);
    store_light(p, g, light, float(frame.spp));
  } else {
    store_emission(p, g);
    if (kRecords) record_none(p.block, p.pixel);
  }
  if (kHasViews && SHOW_VIEW) draw_view(p, lit, v);
}
