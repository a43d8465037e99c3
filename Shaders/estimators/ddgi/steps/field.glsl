// Step `field`: what probes know of the light that a vertex sends on.
#ifndef FB_DDGI_FIELD
#define FB_DDGI_FIELD
#include "estimators/ddgi/steps/begin.glsl"
#include "estimators/ddgi/steps/surface_light.glsl"

const bool kHasField = true;
const bool kEndsInField = true;

// How a vertex goes on.
const uint kWhole = 0u;     // as in `nee`: probes know nothing, or are not asked
const uint kCoat = 1u;      // probes say what its Lambert part sends, and the path goes on from its coat
const uint kEnds = 2u;      // they say all
const uint kDirect = 3u;    // the path sees what falls straight on it, and ends there; the rest probes say
const uint kMirrored = 4u;  // what falls straight on it is left to kDirect, and the path goes on from its coat

struct Field {
  bool known;
  bool ends;     // a path that arrives here ends
  vec3 diffuse;  // light that its Lambert part sends
  vec3 all;      // that a path which ends here brings
  uint probe;    // of which steps/cells.glsl asks from where light is reflected to here; kDdgiNoProbe: none
};

Field field_at(Vertex v, inout Path path) {
  bool first = !path.own.entered;
  float length_of_ray = distance(v.position, path.own.from), cosine = dot(v.view, v.scatter.normal);
  if (first)
    path.own.seen_area = ddgi_seen_area(length_of_ray, cosine);
  else
    path.own.width += ddgi_spread(length_of_ray, path.own.pdf, cosine);
  bool asks = kPlus ? !first || ddgi.ddgi_vertex == 1 : path.own.kind != kDirect;
  // r_fog_bounces 1: light straight from what glows alone.
  asks = asks && !(IN_MEDIUM && ONE_BOUNCE);
  // Where the first vertex' light is not that of probes, one of them may still say from where light comes.
  bool draws = kPlus && !IN_MEDIUM && first && !asks && ddgi_keeps_sent(ddgi.ddgi_control, ddgi.ddgi_guide);
  float pick = draws ? rng_uniform(path.own.rng) : 0.0;
  bool wide = !first && path.own.width * path.own.width > ddgi.ddgi_footprint * path.own.seen_area;
  SurfaceLight light = light_of_surface(v, length_of_ray, kPlus && ddgi.ddgi_view_bias != 0, kPlus, asks || draws, true,
                                        pick, path.own.rng);
  Field f;
  f.known = light.known && asks;
  f.diffuse = light.diffuse;
  f.all = light.diffuse + light.glossy;
  f.ends = kPlus ? f.known && (wide || !has_coat(v)) : path.own.kind == kDirect;
  f.probe = draws ? light.drawn : kDdgiNoProbe;
  return f;
}

vec3 field_reflection(Field there, Field here, Vertex v) { return there.all; }
bool field_suffices(Field there, Field here, Path path) { return there.ends; }
#endif
