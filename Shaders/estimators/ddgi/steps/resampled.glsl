// Samples of all light that falls on a first vertex (Majercik 2022, Section 3.2): a place on any triangle of the scene,
// and what it was found to send to where it was found: what it emits, and what probes know of what it reflects. The
// measure is area on the triangle in units of its own size, so that it stays the same wherever an instance has moved,
// and shifts between pixels and frames have Jacobian 1. Suns are looked for apart, since they have no place.
#ifndef FB_DDGI_RESAMPLED
#define FB_DDGI_RESAMPLED
#include "estimators/ddgi/steps/surface_light.glsl"
#include "lib/former.glsl"
#include "lib/look_for_light.glsl"
#include "lib/pixel_start.glsl"
#include "lib/store_light.glsl"
#include "shared/reservoir.h"

FB_TECHNIQUE_ARRAY(kDdgiReservoirs, 16, , DdgiReservoirArray, uvec4, ddgi_reservoirs)
FB_TECHNIQUE_ARRAY(kDdgiMerged, 16, , DdgiMergedArray, uvec4, ddgi_merged)
FB_TECHNIQUE_ARRAY(kDdgiRest, 16, , DdgiRestArray, vec4, ddgi_rest)

struct LitSample {
  uint instance;  // kNoIndex: none
  uint triangle;
  uint bary;  // packUnorm2x16
  uint sent;  // radiance, pack_rgb9e5
};
struct LitReservoir {
  LitSample chosen;
  float weight;      // W
  float confidence;  // frames of candidates; 0: nothing is to be taken from it
};
const LitSample kNoLitSample = LitSample(kNoIndex, 0u, 0u, 0u);
LitReservoir no_lit_reservoir() { return LitReservoir(kNoLitSample, 0.0, 0.0); }

// In an array of two uvec4 an element.
#define FB_STORE_LIT(array, element, r)                                                                 \
  array.at[2u * (element)] = uvec4(r.chosen.instance, r.chosen.triangle, r.chosen.bary, r.chosen.sent); \
  array.at[2u * (element) + 1u] =                                                                       \
      uvec4(floatBitsToUint(reservoir_number(r.weight)), floatBitsToUint(r.confidence), 0u, 0u);
#define FB_LOAD_LIT(array, element) unpack_lit(array.at[2u * (element)], array.at[2u * (element) + 1u].xy)
LitReservoir unpack_lit(uvec4 a, uvec2 b) {
  return LitReservoir(LitSample(a.x, a.y, a.z, a.w), reservoir_number(uintBitsToFloat(b.x)), uintBitsToFloat(b.y));
}

// Where a sample is, for a vertex.
struct LitPlace {
  bool there;
  vec3 place;  // in this frame, or the former one
  GpuTriangle triangle;
};
LitPlace place_of_sample(LitSample s, bool former) {
  LitPlace p;
  p.there = s.instance != kNoIndex;
  Hit hit = Hit(0.0, unpackUnorm2x16(s.bary), p.there ? s.instance : 0u, p.there ? s.triangle : 0u);
  uint flags = instance_at(hit.instance).flags;
  p.triangle = world_triangle(hit.instance, hit.triangle);
  p.place = p.triangle.v0.xyz + p.triangle.e1.xyz * hit.bary.x + p.triangle.e2.xyz * hit.bary.y;
  if (former) {
    p.there = p.there && (flags & kInstanceIsNew) == 0u;
    if ((flags & kInstanceMoves) != 0u) p.place = previous_position(hit);
  }
  return p;
}

// The share of light at a distance that the bounded geometry term leaves to reservoirs (Section 3.6, after Kollig and
// Keller 2006); the rest is left to scattered rays.
float bounded_share(float distance, float cosine_here, float cosine_there) {
  float term = cosine_here * cosine_there / max(distance * distance, 1e-12);
  return ddgi.ddgi_geometry > 0.0 && term > ddgi.ddgi_geometry ? ddgi.ddgi_geometry / term : 1.0;
}

// A sample as a vertex sees it.
struct LitWay {
  vec3 direction;
  float reach;
  vec3 f;      // f cos, in the samples' measure, in the share that reservoirs have; zero: there is no way
  float bsdf;  // density of the vertex's own scattering, per solid angle
  float seen;  // density of a sample that is even on the triangle, per solid angle
};
LitWay way_to_sample(Vertex v, LitPlace p) {
  LitWay w;
  vec3 way = p.place - scatter_origin(v.scatter, v.position);
  w.reach = length(way);
  w.direction = way / max(w.reach, 1e-20);
  w.seen = triangle_pdf(p.triangle, w.reach, w.direction);
  w.f = scatter_eval(v.scatter, v.view, w.direction, w.bsdf);
  float cosine_there = abs(dot(normalize(cross(p.triangle.e1.xyz, p.triangle.e2.xyz)), w.direction));
  float share = bounded_share(w.reach, max(dot(v.scatter.normal, w.direction), 0.0), cosine_there);
  w.f = p.there && w.seen > 0.0 ? w.f * (share / w.seen) : vec3(0.0);
  if (FEATURE_MEDIUM) w.f *= transmittance(frame.medium.w, w.reach);
  return w;
}
float lit_target(LitWay w, uint sent) { return reservoir_number(dot(w.f * unpack_rgb9e5(sent), vec3(1.0))); }
// Of a sample at a vertex.
float target_at(Vertex v, LitSample s, bool former) {
  if (s.instance == kNoIndex) return 0.0;
  return lit_target(way_to_sample(v, place_of_sample(s, former)), s.sent);
}

uint element_of(uvec2 block) { return block.y * frame.light_width + block.x; }
uvec2 lit_blocks() { return uvec2(frame.light_width, (frame.height + frame.light_block - 1u) / frame.light_block); }

// Pixels that show one surface, in air and straight, have neighbours and a history.
bool may_reuse(uint at, GBufferTexel g) {
  if (!shows_two()) return true;
  if (FEATURE_WATER && (g.material_metalness & kTexelLiquid) != 0u) return false;
  WaterTexel w = water_at(at);
  return w.seen.albedo == vec3(0.0) && w.own_liquid == kNoIndex;
}

// The first vertex of a pixel's light; where water shows two surfaces, one of them.
Path begin_pixel(PathPixel p, GBufferTexel g, out Vertex v, out uint rng) {
  v = first_vertex(g, p.pixel);
  return start_path(p, g, 0u, v, rng);
}

// Reservoirs have light of places that a straight ray reaches past nothing translucent, whose emission they can ask for
// again.
bool ends_by_chance(Hit hit) {
  bool bends = FEATURE_WATER && (material_of(hit.instance, hit.triangle).flags & kMaterialDielectric) != 0u;
  return bends || (FEATURE_CANDIDATES && !is_opaque(hit));
}
bool is_reusable(Segment way) {
  return way.hit.instance != kNoIndex && !way.bent && way.certain && !ends_by_chance(way.hit);
}

// What a place sends along a way to its start (Eq. 6); of a sun's disc nothing.
vec3 sent_light(Vertex v, Segment way, inout uint rng) {
  bool sun = has_feature(kFeatureSuns) && !way.bent && is_sky(way.hit) && sun_pdf(way.direction) > 0.0;
  Surface s = load_surface(way.hit, way.direction, kFilterNearest, false, false);
  vec3 light = sun ? vec3(0.0) : s.emission;
  if (way.hit.instance == kNoIndex || s.sky) return light;
  Vertex y = end_of_segment(way, s);
  SurfaceLight known = light_of_surface(y, way.distance, ddgi.ddgi_view_bias != 0, true, true, true, 0.0, rng);
  return light + known.diffuse + known.glossy;
}
#endif
