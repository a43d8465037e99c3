// Step `begin` of paths that know probes. The includer says at which vertex probes come in (kPlus):
//
//   false  at the first: what falls straight on it is looked for, what is reflected to it probes know; its coat's
//          reflections are a path that goes on likewise (Eq. 2)
//   true   at the second (r_ddgi_vertex 1: the first): all that falls on it, but its coat's reflections while the
//          path's footprint is small (Eq. 5 to 8)
#ifndef FB_DDGI_BEGIN
#define FB_DDGI_BEGIN
#include "lib/interaction.glsl"

struct PathOwn {
  uint rng;         // of what probes are asked for
  uint kind;        // how the last vertex went on (steps/proposal.glsl)
  bool entered;     // there was one
  vec3 from;        // where it was, or the camera
  float pdf;        // of the direction that was taken there
  float width;      // root of the footprint so far (Eq. 7)
  float seen_area;  // that the camera sees of the first vertex (Eq. 8)
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  path.own.rng =
      rng_seed(block.y * frame.width + block.x, frame.frame, i, frame.seed ^ (IN_MEDIUM ? 0x27d4eb2fu : 0x165667b1u));
  path.own.kind = 0u;
  path.own.entered = false;
  path.own.from = frame.camera_position.xyz;
  path.own.pdf = path.own.width = path.own.seen_area = 0.0;
}
#endif
