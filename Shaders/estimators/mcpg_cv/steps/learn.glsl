// Step `learning`: what a path met trains what `mcpg` trains, and the control variate's cell. Reflected light is what
// mcpg's irradiance cache knows of it.
#ifndef FB_MCPG_CV_LEARN
#define FB_MCPG_CV_LEARN
#define learn_hit learn_hit_guided
#define learn_waste learn_waste_guided
#include "estimators/mcpg/steps/learn.glsl"
#undef learn_hit
#undef learn_waste
#include "estimators/pstf/steps/teach.glsl"

void learn_besides(Vertex v, Guidance g, Path path, inout uint rng) {}

// `straight`: of the light that was met, what came without a reflection between. A path's last reflection, of several,
// does not count: nothing that is reflected comes from there.
void teach_control(Path path, vec3 met, vec3 straight, vec3 direction) {
  uint bits = rng_seed(path.number, path.depth, frame.frame, frame.seed ^ (IN_MEDIUM ? 0x9b05688cu : 0x5be0cd19u));
  bool takes = control.drawn && !(path.last && path.most > 1u) &&
               takes_sample(control.place, control.crowd, control.taught, path.own.teaches_control, rng_next(bits));
  vec3 white = met * control.over;
  float y = ycocg_from_rgb(held(white)).x;
  bool known = control.luminance > 0.0;
  Lesson l;
  set_outgoing(l, white, straight * control.over, control.normal);
  set_incident(l, white, direction, known ? y / control.luminance - 1.0 : 0.0, known ? control.off : 0.0);
  place_cell(control.place.slot, region_about(control.position), control.taught, takes);
  teach(control.place.slot, l, takes, bits);
}

void learn_waste(Guidance g, Path path) {
  learn_waste_guided(g, path);
  teach_control(path, vec3(0.0), vec3(0.0), vec3(0.0));
}

void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng) {
  learn_hit_guided(v, g, p, incident, path, rng);
  teach_control(path, incident.emission + incident.reflection, incident.emission, p.direction);
}
#endif
