// What one probe says of the light that is reflected to a point from each direction, even within cells of the
// hemisphere about a normal that have the same share of the cosine: the mean over cells is the mean over the cosine,
// exactly. The paper's mean over a probe's rays is not that of the nearest ray's light (Majercik 2022, Section 5.1). So
// it may be a control variate, and a density of directions.
#ifndef FB_DDGI_CELLS
#define FB_DDGI_CELLS
#include "estimators/ddgi/steps/probes.glsl"
#include "lib/interaction.glsl"
#include "shared/color.h"

struct FrozenDirections {
  uint probe;       // kDdgiNoProbe: nothing is known
  vec3 normal;      // of the hemisphere
  vec3 mean;        // of radiance, over the cosine
  float luminance;  // of all cells, summed up
  uint drawn;       // a cell, in proportion to its luminance
};

vec3 light_of_cell(FrozenDirections d, uint cell) {
  vec3 middle = frame_about(d.normal) * sample_cosine_hemisphere(ddgi_cell_place(cell, vec2(0.5)));
  uint texel = ddgi_texel_about(middle, kDdgiLightSide);
  return unpack_rgb9e5(ddgi_light.at[(ddgi.probes + d.probe) * kDdgiLightTexels + texel]);
}
// Radiance from a direction above the surface.
vec3 light_about(FrozenDirections d, vec3 direction) {
  return light_of_cell(d, ddgi_cosine_cell(direction * frame_about(d.normal)));
}

FrozenDirections directions_about(Vertex v, uint probe, inout uint rng) {
  FrozenDirections d = FrozenDirections(probe, v.scatter.shading_normal, vec3(0.0), 0.0, 0u);
  if (probe == kDdgiNoProbe) return d;
  float pick = rng_uniform(rng);
  uint cell = 0u;
  do {
    vec3 light = light_of_cell(d, cell);
    float bright = luminance(light), share = 0.0;
    d.luminance += bright;
    if (bright > 0.0) share = bright / d.luminance;
    bool takes = pick < share;
    pick = takes ? pick / share : (pick - share) / (1.0 - share);
    d.drawn = takes ? cell : d.drawn;
    d.mean += light / float(kDdgiCells);
  } while (++cell < kDdgiCells);
  return d;
}

float frozen_pdf(FrozenDirections d, vec3 direction) {
  float cosine = dot(direction, d.normal);
  if (!(cosine > 0.0) || !(d.luminance > 0.0)) return 0.0;
  return luminance(light_about(d, direction)) / d.luminance * float(kDdgiCells) * cosine / kPiShared;
}
vec3 frozen_draw(FrozenDirections d, vec2 u) {
  return frame_about(d.normal) * sample_cosine_hemisphere(ddgi_cell_place(d.drawn, u));
}
#endif
