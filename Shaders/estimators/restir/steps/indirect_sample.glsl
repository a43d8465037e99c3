// Samples of light of two reflections: a place on a triangle of the scene, the second vertex, and a sample of light
// that falls on it (light_sample.glsl). Both measures are uniform on triangles and in discs, so that shifts between
// pixels and frames, which keep both places (reconnection, Lin 2022), have Jacobian 1: geometry is in the target. The
// second vertex' own scattering is evaluated anew for each viewer. Or (r_restir_gi_radiance) a sample is the second
// vertex and the light that it sent once, the same for all viewers.
#ifndef FB_RESTIR_INDIRECT_SAMPLE
#define FB_RESTIR_INDIRECT_SAMPLE
#include "estimators/restir/steps/arrays.glsl"
#include "shared/denoise.h"

struct IndirectSample {
  uint instance;  // of this frame; kNoIndex: none
  uint triangle;
  uvec2 bary;  // pack_bary
  LightSample light;
};
bool keeps_radiance() { return restir.restir_gi_radiance != 0; }
// Where on the second vertex' triangle: two floats, since a place that is rounded may lie below a surface close by, and
// its light would be lost. Where samples keep the radiance that the vertex sends, that takes the second word.
uvec2 pack_bary(vec2 bary, vec3 radiance) {
  return keeps_radiance() ? uvec2(packUnorm2x16(bary), pack_rgb9e5(radiance, 0.5)) : floatBitsToUint(bary);
}
vec2 unpack_bary(uvec2 words) { return keeps_radiance() ? unpackUnorm2x16(words.x) : uintBitsToFloat(words); }
vec3 unpack_radiance(uvec2 words) { return keeps_radiance() ? unpack_rgb9e5(words.y) : vec3(0.0); }
struct IndirectReservoir {
  IndirectSample chosen;
  float weight;  // W
  float confidence;
  float age;
};
const IndirectSample kNoIndirect = IndirectSample(kNoIndex, 0u, uvec2(0u), kNoSample);
IndirectReservoir no_indirect() { return IndirectReservoir(kNoIndirect, 0.0, 0.0, 0.0); }
// Of a pixel that does not reuse.
IndirectReservoir no_indirect_reuse() {
  return IndirectReservoir(IndirectSample(kNoIndex, 0u, uvec2(0u), LightSample(kKindNothing, 0u)), 0.0, 0.0, 0.0);
}
bool reuses(IndirectReservoir r) { return r.chosen.light.name != kKindNothing; }

// In an array of two uvec4 an element.
#define FB_STORE_INDIRECT(array, element, r)                                                                    \
  array.at[2u * (element)] = uvec4(r.chosen.instance, r.chosen.triangle, r.chosen.bary.x, r.chosen.light.name); \
  array.at[2u * (element) + 1u] = uvec4(r.chosen.light.place, floatBitsToUint(reservoir_number(r.weight)),      \
                                        packHalf2x16(vec2(r.confidence, r.age)), r.chosen.bary.y);
#define FB_LOAD_INDIRECT(array, element) unpack_indirect(array.at[2u * (element)], array.at[2u * (element) + 1u])
IndirectReservoir unpack_indirect(uvec4 a, uvec4 b) {
  vec2 rest = unpackHalf2x16(b.z);
  return IndirectReservoir(IndirectSample(a.x, a.y, uvec2(a.z, b.w), LightSample(a.w, b.x)),
                           reservoir_number(uintBitsToFloat(b.y)), rest.x, rest.y);
}

// Where a sample is.
struct IndirectPoint {
  bool there;  // its second vertex is, and its light shines
  bool was;    // and both did in the former frame
  Hit second;
  GpuTriangle triangle;
  vec3 place, before;  // of the second vertex, in this frame and the former one
  LightPoint light;
  vec3 radiance;  // kept
};
IndirectPoint indirect_point(IndirectSample s) {
  IndirectPoint p;
  p.light = point_of(s.light);
  p.radiance = unpack_radiance(s.bary);
  p.there = s.instance != kNoIndex && (p.light.there || keeps_radiance());
  p.second = Hit(0.0, unpack_bary(s.bary), p.there ? s.instance : 0u, p.there ? s.triangle : 0u);
  uint flags = instance_at(p.second.instance).flags;
  p.was = p.there && (p.light.was || keeps_radiance()) && (flags & kInstanceIsNew) == 0u;
  p.triangle = world_triangle(p.second.instance, p.second.triangle);
  p.place = p.before = p.triangle.v0.xyz + p.triangle.e1.xyz * p.second.bary.x + p.triangle.e2.xyz * p.second.bary.y;
  if (p.was && (flags & kInstanceMoves) != 0u) p.before = previous_position(p.second);
  return p;
}

// A sample as a vertex sees it: what it reflects of the second vertex' light, which was even and met nothing on its
// ways, is the sum of the channels `target`, in the measure of samples.
struct IndirectWay {
  float target;
  vec3 direction;  // to the second vertex
  float reach;
  Vertex second;   // this and
  LightWay light;  // this, as the second vertex sees it: where samples do not keep its light
  vec3 f;          // of both vertices, over the densities of samples per solid angle
};
IndirectWay indirect_way(Domain d, IndirectPoint p) {
  IndirectWay w;
  vec3 at = d.former ? p.before : p.place, way = at - d.origin;
  w.reach = length(way);
  w.direction = way / max(w.reach, 1e-20);
  p.second.t = w.reach;
  float bsdf, seen = triangle_pdf(p.triangle, w.reach, w.direction);
  vec3 f = scatter_eval(d.v.scatter, d.v.view, w.direction, bsdf);
  bool known = p.there && (!d.former || p.was) && seen > 0.0;
  float emitted = 1.0;
  vec3 sent = p.radiance;
  if (!keeps_radiance()) {
    Surface s = load_surface(p.second, w.direction, kFilterNearest, false, false);
    s.position = at;
    w.second = surface_vertex(s, -w.direction);
    w.light = way_to_light(domain_of(w.second, d.former), p.light);
    known = known && w.light.seen > 0.0;
    emitted = w.light.even * w.light.seen;
    sent = w.light.f / w.light.seen;
  }
  w.f = known ? f * sent / seen : vec3(0.0);
  if (FEATURE_MEDIUM) w.f *= transmittance(frame.medium.w, w.reach);
  w.target = known ? dot(w.f, vec3(1.0)) * emitted : 0.0;
  return w;
}

// Whether a way that ends at the second vertex, in this frame, does so.
bool ends_there(IndirectPoint p, Segment way) {
  return !way.bent && way.certain && way.hit.instance == p.second.instance && way.hit.triangle == p.second.triangle;
}
#endif
