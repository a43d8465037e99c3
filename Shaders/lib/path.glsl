// The path loop that every technique shares. Transport is here: distances, throughput, emission that is met, the tail. What a
// technique does of its own are its steps; it includes or defines each of them before this file (lib/steps/ has those of a
// technique that lacks one, which cost nothing):
//
//   begin     Path begin_path(uvec2 block, uint number, uint i)                  path i of the pixel that is lit in the block
//   field     struct Field                                                       what is known of the light about a point
//             const bool kHasField, kEndsInField                                 kEndsInField: biased, paths end in the field
//             Field field_at(Vertex v, inout Path path)
//             vec3 field_reflection(Field there, Field here, Vertex v)           light that `v` reflects, as far as it is known
//             bool field_suffices(Field there, Field here)                       known well enough to end a path
//   proposal  struct Guidance                                                    what is known at a vertex: lobes, reservoirs ...
//             void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g)
//             Proposal propose(Vertex v, inout Guidance g, inout uint rng)
//             float proposal_pdf(Guidance g, vec3 direction, float bsdf_pdf)     density of propose in any direction, from the BSDF's
//   direct    const bool kLooksForLight
//             Direct look_for_light(Vertex v, Guidance g, inout uint rng)        by a ray more
//             Direct last_light(Vertex v, inout uint rng)                        by a path's last ray, which looks for it in turns
//             bool point_of_light(inout uint rng, out vec3 place)                a point that may glow, for distances in a medium
//             float met_share(Vertex v, Segment way, Proposal p, vec3 emission)  of emission that is met before the last
//   learning  const bool kLearns
//             void learn_direct(Guidance g, Direct direct, Path path, inout uint rng)
//             void learn_last(Field here, Direct direct, Path path, inout uint rng)
//             void learn_waste(Guidance g, Path path)                            the direction was of no use
//             void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng)
#ifndef FB_LIB_PATH
#define FB_LIB_PATH
#include "lib/incident.glsl"

// Radiance that reaches the first vertex's viewer by reflection: paths of 1 to path_bounces() further vertices (r_bounces, or
// r_fog_bounces where the first is in a medium). Where light is looked for, the last of several vertices is apart: its one ray
// does for both, and what is known there guides neither.
vec3 trace_path(Vertex v, Path path, inout uint rng) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  Field here = field_at(v, path);
  bool goes_on = true;
  const bool last_apart = kLooksForLight && !SMALL && path_bounces() > 1u;
  uint bounces = path_bounces() - (last_apart ? 1u : 0u);
  uint bounce = 0u;
  do {
    bool end = ONE_BOUNCE || bounce + 1u == path_bounces();
    goes_on = false;
    path.last = end && !kEndsInField;
    path.vertex = first_vertex_of(path.number) + bounce;

    // Where the path goes on, and light that is looked for.
    Guidance guidance;
    prepare(v, here, path, rng, guidance);
    Proposal proposal = propose(v, guidance, rng);
    if (kLooksForLight) {
      Direct direct = look_for_light(v, guidance, rng);
      sum += throughput * direct.radiance;
      learn_direct(guidance, direct, path, rng);
    }
    if (proposal.weight == vec3(0.0)) {
      learn_waste(guidance, path);
      break;
    }

    // Light that is met: emitted there and, as far as it is known, reflected. A miss teaches, too.
    Incident incident;
    incident.origin = scatter_origin(v.scatter, v.position);
    incident.way = segment_from(v, proposal.direction, kRayEnd, kTurnByChance, rng);
    bool missed = incident.way.hit.instance == kNoIndex;
    bool dark = missed && frame.sky_beyond == 0u;
    if (dark && !kLearns) break;
    Surface s;
    s.emission = vec3(0.0);
    s.sky = true;
    if (!dark || !kLearns) s = load_surface(incident.way.hit, incident.way.direction, kFilterNearest, path.last);
    if (kLooksForLight) s.emission *= met_share(v, incident.way, proposal, s.emission);
    vec3 left = incident.way.left;
    incident.sky = s.sky;
    incident.emission = s.emission * left;
    incident.reflection = vec3(0.0);
    incident.field = here;
    Vertex next = end_of_segment(incident.way, s);
    if (kHasField && !missed && !path.last) {
      incident.field = field_at(next, path);
      incident.reflection = field_reflection(incident.field, here, next) * left;
    }
    if (kLearns) learn_hit(v, guidance, proposal, incident, path, rng);
    if (dark) break;
    throughput *= proposal.weight;
    sum += throughput * incident.emission;

    // The field stands for what is beyond.
    if (kEndsInField && !missed && (end || (!path.goes_on && field_suffices(incident.field, here)))) {
      sum += throughput * incident.reflection;
      break;
    }
    if (missed || end) break;
    throughput *= left;
    v = next;
    here = incident.field;
    goes_on = true;
  } while (!ONE_BOUNCE && ++bounce < bounces);
  if (kLooksForLight && !SMALL && !ONE_BOUNCE && goes_on) {
    Direct direct = last_light(v, rng);
    sum += throughput * direct.radiance;
    learn_last(here, direct, path, rng);
  }
  return sum;
}
#endif
