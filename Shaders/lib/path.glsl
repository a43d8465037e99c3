// The path loop that every technique shares. Transport is here: distances, throughput, emission that is met, the tail.
// What a technique does of its own are its steps; it includes or defines each of them before this file (lib/steps/ has
// those of a technique that lacks one, which cost nothing). In the order in which a vertex takes them:
//
// clang-format off
//   begin     struct PathOwn                                                      what its paths carry
//             void begin_path(inout Path path, uvec2 block, uint i)               path i of the block's lit pixel
//   field     struct Field                                                        what is known of light about a point
//             const bool kHasField, kEndsInField                                  kEndsInField: biased, paths end in it
//             Field field_at(Vertex v, inout Path path)
//             vec3 field_reflection(Field there, Field here, Vertex v)            light that `v` is known to reflect
//             bool field_suffices(Field there, Field here, Path path)             known well enough to end a path
//   proposal  struct Guidance                                                     what is known at a vertex: lobes ...
//             void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g)
//             Proposal propose(Vertex v, inout Guidance g, inout uint rng)
//             float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf)
//                 density of propose in any direction, from the density of the vertex's own scattering
//   direct    const bool kLooksForLight
//             Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng)
//                 by a ray more
//             float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path)
//                 of emission that is met before the last vertex
//             Direct last_light(Vertex v, inout Path path, inout uint rng)
//                 by a path's last ray, which looks for it in turns
//             bool point_of_light(inout uint rng, out vec3 place)
//                 a point that may glow, for distances in a medium
//   control   const bool kHasControl                                              a control variate h of reflection
//             vec3 control_mean(Vertex v, Guidance g, Field here)                 integral of h over directions, exact
//             vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction)   h; zero where propose never goes
//   learning  const bool kLearns, kFollowsMotion                                  kFollowsMotion: sets Vertex::previous
//             void learn_direct(Guidance g, Direct direct, Path path, inout uint rng)
//             void learn_waste(Guidance g, Path path)                             the direction was of no use
//             void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path,
//                            inout uint rng)                                      at misses, too
//             void learn_last(Field here, Direct direct, Path path, inout uint rng)
//   record    const bool kRecords                                                 what a path did, for who stores it
//             void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput)
//             void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput)
//                 at misses, too
//             void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput)
//                 of a last vertex that is apart
//             void record_path(Path path, vec3 sum, inout uint rng)               its end, whatever ended it
//             void record_none(uvec2 block, uvec2 pixel)                          a pixel of the picture without paths
//   views     const bool kHasViews
//             void draw_view(PathPixel p, bool lit, Vertex v)                     lib/steps/no_views.glsl
//
// The light of a path's rest as vertex i reflects it, for `record`, is r_i = direct_i + weight_i (incident_i.emission +
// incident_i.way.left r_(i+1)): no division by a throughput that may be zero.
// clang-format on
#ifndef FB_LIB_PATH
#define FB_LIB_PATH
#include "lib/incident.glsl"

// What a control variate adds to the estimate of what a vertex reflects: its integral less its own estimate by the
// direction that was drawn, of whatever use that is. Directions of smooth interfaces have no density that it could be
// weighed by.
vec3 control_variate(Vertex v, Guidance g, Field here, Proposal p) {
  bool drawn = p.pdf > 0.0 && (p.flags & kScatterDelta) == 0u;
  return control_mean(v, g, here) - (drawn ? control_at(v, g, here, p.direction) / p.pdf : vec3(0.0));
}

// Radiance that the first vertex reflects to its viewer, by at most path.most - path.depth further reflections. Where
// lights are looked for, the last of several vertices is treated apart (last_light): one ray serves there both to look
// for light and to be scattered, and it is not guided. Paths that end in the field have no such vertex: those that go
// on teach the field, which wants all light at their last vertex.
vec3 trace_path(Vertex v, inout Path path, inout uint rng) {
  const bool last_apart = kLooksForLight && !kEndsInField && !SMALL && !ONE_BOUNCE;
  uint end_depth = last_apart && path.most > 1u ? path.most - 1u : path.most;  // of the vertices that are alike
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  Field here = field_at(v, path);
  bool goes_on = true;  // to a further vertex
  do {
    bool end = ONE_BOUNCE || path.depth + 1u == path.most;
    goes_on = false;
    path.last = end && !kEndsInField;

    // Where the path goes on, and light that is looked for.
    Guidance guidance;
    prepare(v, here, path, rng, guidance);
    Proposal proposal = propose(v, guidance, rng);
    if (kLooksForLight) {
      Direct direct = look_for_light(v, guidance, path, rng);
      sum += throughput * direct.radiance;
      learn_direct(guidance, direct, path, rng);
      if (kRecords) record_direct(path, v, guidance, direct, throughput);
    }
    if (kHasControl) sum += throughput * control_variate(v, guidance, here, proposal);
    if (proposal.weight == vec3(0.0)) {
      learn_waste(guidance, path);
      break;
    }

    // Light that is met: emitted there and, as far as it is known, reflected. A miss teaches, too.
    Incident incident;
    incident.origin = scatter_origin(v.scatter, v.position);
    incident.way = segment_from(v, proposal.direction, kRayEnd, kTurnByChance, rng);
    bool missed = incident.way.hit.instance == kNoIndex;
    bool dark = ends_in_darkness(incident.way);
    if (dark && !kLearns && !kRecords) break;
    Surface s;
    s.emission = vec3(0.0);
    s.sky = true;
    if (!dark || !(kLearns || kRecords))
      s = load_surface(incident.way.hit, incident.way.direction, kFilterNearest, path.last, false);
    if (kLooksForLight) s.emission *= met_share(v, incident.way, proposal, s.emission, path);
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
    if (kRecords) record_hit(path, v, guidance, proposal, incident, throughput);
    if (dark) break;
    throughput *= proposal.weight;
    sum += throughput * incident.emission;

    // The field stands for what is beyond.
    if (kEndsInField && !missed && (end || field_suffices(incident.field, here, path))) {
      sum += throughput * incident.reflection;
      break;
    }
    if (missed || end) break;
    throughput *= left;
    v = next;
    here = incident.field;
    goes_on = true;
  } while (!ONE_BOUNCE && ++path.depth < end_depth);
  if (last_apart && goes_on) {
    Direct direct = last_light(v, path, rng);
    sum += throughput * direct.radiance;
    learn_last(here, direct, path, rng);
    if (kRecords) record_last(path, v, direct, throughput);
  }
  if (kRecords) record_path(path, sum, rng);
  return sum;
}
#endif
