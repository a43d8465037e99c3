// Everything that shared/phase.h, medium.h, dielectric.h and waves.h compute, for one query: called on the host and,
// through Shaders/tests/media.comp, on the device.
#ifndef FB_SHARED_TEST_MEDIA_PROBE_H
#define FB_SHARED_TEST_MEDIA_PROBE_H
#include "shared/dielectric.h"
#include "shared/medium.h"
#include "shared/phase.h"
#include "shared/waves.h"
FB_NAMESPACE_BEGIN

struct MediaQuery {
  vec4 axis_g;         // unit direction; g
  vec4 w_alpha;        // unit direction; alpha
  vec4 light_sigma;    // a light from the segment's start, along axis; extinction
  vec4 reach_share_u;  // reach; share about the light; two random numbers
  vec4 cosine_eta_x;   // of the interface; argument of one_minus_exp; a distance
  vec4 point_height;   // of the waves: x, y, height, size
  uvec4 clock;         // of the waves; unused
};
struct MediaAnswer {
  vec4 phase;      // phase_eval, phase_eval_about, phase_mean_cosine, phase_sample_cosine
  vec4 scattered;  // phase_sample; its phase_eval_about
  vec4 medium;     // one_minus_exp, transmittance, transmittance_integral, pdf_distance of the distance
  vec4 colours;    // transmittance by colour; angle of the segment
  vec4 drawn;      // by transmittance, about the light, by both; pdf_distance of the last
  vec4 surface;    // reflectance, cosine beyond; both pdfs of the distance
  vec4 refracted;  // w refracted about axis (w turned to its side); x of axis reflected about w
  vec4 wave;       // wave_state
};

FB_FN MediaAnswer media_probe(MediaQuery query) {
  vec3 axis = vec3(query.axis_g.x, query.axis_g.y, query.axis_g.z);
  vec3 w = vec3(query.w_alpha.x, query.w_alpha.y, query.w_alpha.z);
  vec3 light = vec3(query.light_sigma.x, query.light_sigma.y, query.light_sigma.z);
  float sigma = query.light_sigma.w, reach = query.reach_share_u.x, distance = query.cosine_eta_x.w;
  vec2 u = vec2(query.reach_share_u.z, query.reach_share_u.w);
  PhaseFunction p = phase_function(query.axis_g.w, query.w_alpha.w);
  MediaAnswer answer;
  answer.phase = vec4(phase_eval(p, dot(axis, w)), phase_eval_about(p, axis, w), phase_mean_cosine(p),
                      phase_sample_cosine(p, u.x));
  vec3 scattered = phase_sample(p, axis, u);
  answer.scattered = vec4(scattered, phase_eval_about(p, axis, scattered));
  DistanceMix m = distance_mix(sigma, reach, query.reach_share_u.y, light, axis);
  answer.medium = vec4(one_minus_exp(query.cosine_eta_x.z), transmittance(sigma, distance),
                       transmittance_integral(sigma, reach), pdf_distance(m, distance));
  answer.colours = vec4(transmittance(vec3(sigma, 2.0f * sigma, 0.5f * sigma), distance), m.light.angle);
  float drawn = sample_distance(m, u.x);
  answer.drawn =
      vec4(sample_transmittance(sigma, reach, u.x), sample_equi_angular(m.light, u.x), drawn, pdf_distance(m, drawn));
  float cosine = query.cosine_eta_x.x, eta = query.cosine_eta_x.y;
  answer.surface = vec4(dielectric_reflectance(cosine, eta), dielectric_cosine_beyond(cosine, eta),
                        pdf_transmittance(sigma, reach, distance), pdf_equi_angular(m.light, distance));
  vec3 above = dot(axis, w) < 0.0f ? -w : w;
  answer.refracted = vec4(dielectric_refract(above, axis, eta), dielectric_reflect(axis, w).x);
  Waves waves;
  waves.height = query.point_height.z;
  waves.size = query.point_height.w;
  waves.clock = query.clock.x;
  WaveState s = wave_state(waves, vec2(query.point_height.x, query.point_height.y));
  answer.wave = vec4(s.height, s.slope.x, s.slope.y, s.rate);
  return answer;
}

FB_NAMESPACE_END
#endif
