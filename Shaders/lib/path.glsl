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
//             const float kLooks                                                 share of paths whose last ray looks for light
//             Aim aim_at_light(Vertex v, Guidance g, bool one, inout uint rng)   `one`: that ray is the path's own
//             Direct look_for_light(Vertex v, Aim aim, inout uint rng)           by a ray more
//             bool found(Aim aim, Hit hit, inout uint rng)                       whether a ray met what was looked for
//             Direct direct_light(Vertex v, Aim aim, vec3 emission)              if it did
//             float met_share(Vertex v, Hit hit, Proposal p, vec3 emission, bool one)   of emission that is met
//   learning  const bool kLearns
//             void learn_direct(Guidance g, Direct direct, Path path, inout uint rng)
//             void learn_waste(Guidance g, Path path)                            the direction was of no use
//             void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng)
#ifndef FB_LIB_PATH
#define FB_LIB_PATH
#include "lib/incident.glsl"

// Radiance that reaches the first vertex's viewer by reflection: paths of 1 to frame.bounces further vertices.
vec3 trace_path(Vertex v, Path path, inout uint rng) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  Field here = field_at(v, path);
  for (uint bounce = 0u; bounce < frame.bounces; ++bounce) {
    bool end = bounce + 1u == frame.bounces;
    path.last = end && !kEndsInField;
    path.vertex = path.number * frame.bounces + bounce;

    // Where the path goes on.
    Guidance guidance;
    prepare(v, here, path, rng, guidance);
    Proposal proposal = propose(v, guidance, rng);

    // Light that is looked for, by a ray of its own unless the path's own ray is the last: that one does for both, in turns.
    bool one = kLooksForLight && path.last && bounce > 0u, looks = false;
    Aim aim = kNoAim;
    if (kLooksForLight) {
      aim = aim_at_light(v, guidance, one, rng);
      if (!one) {
        Direct direct = look_for_light(v, aim, rng);
        sum += throughput * direct.radiance;
        learn_direct(guidance, direct, path, rng);
      }
      looks = one && rng_uniform(rng) < kLooks;
      if (looks && aim.weight == 0.0) break;
    }
    if (!looks && proposal.weight == vec3(0.0)) {
      learn_waste(guidance, path);
      break;
    }
    if (looks) proposal.direction = aim.direction;

    // Light that is met: emitted there and, as far as it is known, reflected. A miss teaches, too.
    Incident incident;
    incident.origin = scatter_origin(v.scatter, v.position);
    incident.hit = trace_from(v, proposal.direction, looks ? aim.reach : kRayEnd, rng);
    bool missed = incident.hit.instance == kNoIndex;
    bool dark = missed && frame.sky_beyond == 0u;
    if (dark && !kLearns && !looks) break;
    Surface s;
    s.emission = vec3(0.0);
    if (!dark || !kLearns) s = load_surface(incident.hit, proposal.direction, kFilterNearest, path.last);
    if (looks) {
      Direct direct = direct_light(v, aim, found(aim, incident.hit, rng) ? s.emission : vec3(0.0));
      sum += throughput * direct.radiance;
      learn_direct(guidance, direct, path, rng);
      break;
    }
    if (kLooksForLight) s.emission *= met_share(v, incident.hit, proposal, s.emission, one);
    incident.emission = s.emission;
    incident.reflection = vec3(0.0);
    incident.field = here;
    Vertex next = surface_vertex(s, -proposal.direction);
    if (kHasField && !missed && !path.last) {
      incident.field = field_at(next, path);
      incident.reflection = field_reflection(incident.field, here, next);
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
    v = next;
    here = incident.field;
  }
  return sum;
}
#endif
