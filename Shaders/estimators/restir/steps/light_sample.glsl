// Samples of light that outlast a frame, and what reservoirs hold. A sample is a place on a triangle of a lamp, which
// has a name (shared/scene_gpu.h), or in a sun's disc. Its measure is uniform on the triangle and in the disc, for each
// of them of size one: so it is the same wherever a lamp has moved, and shifts between pixels and frames have
// Jacobian 1.
#ifndef FB_RESTIR_LIGHT_SAMPLE
#define FB_RESTIR_LIGHT_SAMPLE
#include "estimators/restir/places.h"
#include "estimators/restir/restir.h"
#include "lib/look_for_light.glsl"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform RestirBlock {
  layout(offset = kRestirConstantsAt) RestirConstants restir;
};

// A lamp: its name in 16 bits and, above these, how far behind its first light the triangle is. Else, by the highest
// two bits:
const uint kKindBits = 0xc0000000u;
const uint kKindSun = 0x40000000u;      // its number
const uint kKindUnnamed = 0x80000000u;  // a light of no lamp, by its place in this frame's list: not known in any other
const uint kKindNothing = 0xc0000000u;  // of a whole pixel: it does not reuse
struct LightSample {
  uint name;   // 0: none
  uint place;  // two halves, of 65536 each
};
const LightSample kNoSample = LightSample(0u, 0u);

struct LightReservoir {
  LightSample chosen;
  float weight;  // W
  float confidence;
  float age;
};
LightReservoir no_reservoir() { return LightReservoir(kNoSample, 0.0, 0.0, 0.0); }
LightReservoir no_reuse() { return LightReservoir(LightSample(kKindNothing, 0u), 0.0, 0.0, 0.0); }
bool reuses(LightReservoir r) { return r.chosen.name != kKindNothing; }

uvec4 pack_light(LightReservoir r) {
  return uvec4(r.chosen.name, r.chosen.place, floatBitsToUint(reservoir_number(r.weight)),
               packHalf2x16(vec2(r.confidence, r.age)));
}
LightReservoir unpack_light(uvec4 words) {
  vec2 rest = unpackHalf2x16(words.w);
  return LightReservoir(LightSample(words.x, words.y), reservoir_number(uintBitsToFloat(words.z)), rest.x, rest.y);
}

// Where a sample is.
struct LightPoint {
  bool there;  // it shines in this frame
  bool was;    // and did in the former one, by this name
  bool sun;
  GpuLight light;
  GpuTriangle triangle;
  vec3 place;   // in the world; of a sun a direction
  vec3 before;  // in the former frame
  uint number;  // of a sun
  uint packed_place;
};

LightPoint point_on(GpuLight light, uint place, bool was) {
  LightPoint p;
  p.there = light.probability > 0u;
  p.was = was;
  p.sun = false;
  p.number = 0u;
  p.packed_place = place;
  p.light = light;
  p.triangle = world_triangle(light.instance, light.triangle);
  vec2 bary = triangle_place(unit_place(place));
  p.place = p.before = p.triangle.v0.xyz + p.triangle.e1.xyz * bary.x + p.triangle.e2.xyz * bary.y;
  if (was && (instance_at(light.instance).flags & kInstanceMoves) != 0u) {
    Hit hit;
    hit.instance = light.instance;
    hit.triangle = light.triangle;
    hit.bary = bary;
    hit.t = 0.0;
    p.before = previous_position(hit);
  }
  return p;
}

LightPoint point_in_sun(uint number, uint place) {
  LightPoint p;
  p.there = p.sun = true;
  p.was = (restir.former_suns >> number & 1u) != 0u;
  p.number = number;
  p.packed_place = place;
  p.light = GpuLight(0u, 0u, 0u, 0u, 0u, kNoIndex, kNoIndex, 0u);
  p.triangle = GpuTriangle(vec4(0.0), vec4(0.0), vec4(0.0));
  p.place = p.before = in_disc(frame.sun_direction[number], unit_place(place));
  return p;
}

LightPoint nowhere() {
  LightPoint p = point_in_sun(0u, 0u);
  p.there = p.was = false;
  return p;
}

// Of a lamp that has gone out, or a sun that has: not there.
LightPoint point_of(LightSample s) {
  uint kind = s.name & kKindBits;
  if (s.name == 0u || kind == kKindNothing) return nowhere();
  if (kind == kKindSun) {
    uint number = s.name & 0xffu;
    if (!has_feature(kFeatureSuns) || number >= frame.sun_count) return nowhere();
    return point_in_sun(number, s.place);
  }
  if (!has_lights()) return nowhere();
  if (kind == kKindUnnamed) return point_on(light_at(min(s.name & ~kKindBits, frame.light_count - 1u)), s.place, false);
  uint name = s.name & 0xffffu;
  uvec2 words = lamp_words(name - 1u);
  if (words.y == 0u) return nowhere();
  GpuLight light = light_at(min((words.x & ~kLampIsNew) + (s.name >> 16u), frame.light_count - 1u));
  LightPoint p = point_on(light, s.place, (words.x & kLampIsNew) == 0u);
  p.there = p.there && (light.lamp & 0xffffu) == name;
  return p;
}

LightSample sample_of(GpuLight light, uint place) {
  uint name = light.lamp & 0xffffu, index = first_light_of(light.instance) + light.triangle;
  if (name == 0u) return LightSample(kKindUnnamed | index, place);
  return LightSample((index - lamp_at(name - 1u).first) << 16u | name, place);
}

// A vertex at which samples are weighed.
struct Domain {
  Vertex v;
  vec3 origin;
  bool former;  // lights are asked where they were in the former frame
};
Domain domain_of(Vertex v, bool former) { return Domain(v, scatter_origin(v.scatter, v.position), former); }

// How many of a frame's candidates would be this light if none was remembered. Nothing that a target hangs on may come
// of former frames' rays: what they found, reservoirs hold, and a sample that raised its own weight would count too
// much.
float plain_draws(GpuLight light) { return restir.restir_trust * float(light_candidates()) * light_probability(light); }

// A sample as a vertex sees it. Its light there, were the lamp even and were nothing in between, is f times `even`, in
// the measure of samples.
struct LightWay {
  vec3 direction;
  float reach;
  vec3 f;      // with its cosine
  float bsdf;  // density of the vertex's own scattering
  float seen;  // density of samples in this direction, per solid angle; 0: there is none
  float even;
  float draws;  // of the list, that bring it (plain_draws); of suns one over their number
};
LightWay way_to_light(Domain d, LightPoint p) {
  LightWay w = LightWay(vec3(0.0, 0.0, 1.0), kRayEnd, vec3(0.0), 0.0, 0.0, 0.0, 0.0);
  if (!p.there || (d.former && !p.was)) return w;
  w.direction = d.former ? p.before : p.place;
  if (p.sun) {
    w.draws = restir.restir_trust / float(frame.sun_count);
    w.seen = float(frame.sun_count) * sun_pdf(w.direction);
    w.even = frame.sun_radiance[p.number].w;
  } else {
    vec3 way = w.direction - d.origin;
    w.reach = length(way);
    w.direction = way / max(w.reach, 1e-20);
    w.draws = plain_draws(p.light);
    w.seen = triangle_pdf(p.triangle, w.reach, w.direction);
    float area = 0.5 * length(cross(p.triangle.e1.xyz, p.triangle.e2.xyz));
    w.even = frame.light_power * light_probability(p.light) / area;
    if (FEATURE_MEDIUM) w.even *= transmittance(frame.medium.w, w.reach);
  }
  w.f = scatter_eval(d.v.scatter, d.v.view, w.direction, w.bsdf);
  w.even = w.seen > 0.0 ? w.even / w.seen : 0.0;
  return w;
}

// Whether what scattered rays meet is a candidate. Then reservoirs have all light of the list and of suns that comes by
// a straight way past nothing translucent, and paths' own rays all else; without, the two share what both may find.
bool scatters_candidates() { return restir.restir_candidates != 0; }
// With which a path's own ray shares a sample's light.
float shared_density(float bsdf) { return scatters_candidates() ? 0.0 : bsdf; }

// The target of a sample at a vertex, in the measure of samples: that light, in the share that is left to looking for
// it (the balance heuristic's). So it is zero only where the sample's light is. `aim`: how it is looked for, its weight
// still without W.
float target_of_way(Domain d, LightPoint p, LightWay w) {
  float density = w.draws * w.seen;
  if (!(density > 0.0) || (!p.sun && is_within_light(d.v, w.reach))) return 0.0;
  return dot(w.f, vec3(1.0)) * w.even * (density / (density + shared_density(w.bsdf)));
}
float light_target(Domain d, LightPoint p, out Aim aim) {
  aim = kNoAim;
  LightWay w = way_to_light(d, p);
  float target = target_of_way(d, p, w), density = w.draws * w.seen;
  if (!(target > 0.0)) return 0.0;
  uint instance = p.sun ? kNoIndex : p.light.instance, triangle = p.sun ? kNoIndex : p.light.triangle;
  aim = Aim(w.direction, w.f, w.draws, p.sun ? kRayEnd : w.reach * 1.001 + 0.01, density, w.bsdf, instance, triangle,
            kTurnNowhere, 0u, p.light.lamp & 0xffffu, 0u);
  return target;
}
float light_target(Domain d, LightPoint p) {
  Aim unused;
  return light_target(d, p, unused);
}

// How much of a sample's light past rays let hope for at a vertex. Reservoirs choose by target times hope, while MIS
// weights hang on targets alone: a choice leaves the sum of what is chosen from right whatever decides it, also where
// the same samples taught the hope; MIS weights add up to 1 only if those of all samples are of one function.
struct Hope {
  Candidates lamps;
  uint here;
  float sun;
};
Hope hope_at(Domain d) {
  Hope h;
  uint cell = cell_of(d.v), seen = seen_cells.at[cell].x;
  h.lamps = candidates_of(cell);
  h.here = seen_place(d.origin, 0u);
  h.sun = mix(1.0, max(sqrt(seen_share(seen)), kLeastSeen), min(seen_rays(seen) / kEnoughRays, 1.0));
  return h;
}
float hope_for(Hope h, LightPoint p) {
  if (restir.restir_hope == 0 || !p.there) return 1.0;
  return p.sun ? h.sun : hope_of(h.lamps, p.light, seen_way(h.here, p.place));
}

// Density with which light is looked for where a way from a vertex ends, as light_target has it.
float plain_density(Vertex v, vec3 direction, Segment way) {
  if (way.bent) return 0.0;
  if (has_feature(kFeatureSuns) && is_sky(way.hit) && sun_pdf(direction) > 0.0)
    return restir.restir_trust * sun_pdf(direction);
  if (!has_lights() || way.hit.instance == kNoIndex || is_within_light(v, way.hit.t)) return 0.0;
  uint first = first_light_of(way.hit.instance);
  if (first == kNoIndex) return 0.0;
  return plain_draws(light_at(first + way.hit.triangle)) *
         triangle_pdf(world_triangle(way.hit.instance, way.hit.triangle), way.hit.t, direction);
}
#endif
