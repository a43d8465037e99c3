// Steps `proposal` and `control`: directions of `mcpg`, and the control variate of `pstf_cv` under them, h = albedo /
// pi max(n w, 0) (a + b w), whose integral is known (estimators/pstf/pstf.h). The mixture has a share of the BSDF's
// directions, which go wherever h is above zero.
//
// Steps of `mcpg` are included under other names, and called.
#ifndef FB_MCPG_CV_PROPOSE
#define FB_MCPG_CV_PROPOSE
#define prepare prepare_guided
#define propose propose_guided
#include "estimators/mcpg/steps/propose.glsl"
#undef prepare
#undef propose

// What the control variate's cell knows of the vertex that the path is at. A variable of the path's invocation: a
// guided vertex (Guidance) is one struct of mcpg's, and steps hand on no other.
struct Control {
  CellPlace place;
  float crowd;   // samples of a frame that last taught the cell,
  float taught;  // and of all
  vec3 position, normal;
  vec3 albedo;  // of the Lambert surface that h is of
  vec3 mean;    // of incident light in the cell; zero: it is unknown
  float luminance;
  LinearLight light;  // by direction, over that mean
  float beta;
  float over;  // what a white Lambert surface reflects of light from the drawn direction, over its density
  float off;   // h / pdf less its integral, over the mean
  bool drawn;  // that direction has a density
};
Control control;

vec3 control_albedo(Scatter s, vec3 view) {
  if (!FEATURE_SPECULAR || !bsdf_has_coat(s.bsdf)) return s.bsdf.albedo;
  float f0 = s.bsdf.specular, seen = max(dot(view, s.shading_normal), 0.0);
  return s.bsdf.albedo * ((1.0 - s.bsdf.metalness) * (1.0 - f0) * (1.0 - f0 - (1.0 - f0) * schlick_weight(seen)));
}

float control_noise(uint slot, uint of) {
  return pstf.pstf_noise * (float(hash_combine(slot * 8u + of, frame.frame)) * (2.0 / 4294967296.0) - 1.0);
}

void prepare_control(Vertex v, inout Path path) {
  vec3 n = v.scatter.shading_normal;
  control = Control(CellPlace(kNoIndex, kNoIndex, 0u), 0.0, 0.0, v.position, n, vec3(0.0), vec3(0.0), 0.0,
                    LinearLight(1.0, vec3(0.0)), 0.0, 0.0, 0.0, false);
  // Of a surface seen from below its shading normal nothing is drawn.
  if (in_medium(v.scatter) || (FEATURE_SPECULAR && dot(v.view, n) <= 0.0)) return;
  control.place = find_pstf_cell(v.position, scatter_axis(v.scatter), 0u, pstf.cell_angle, uint(pstf.pstf_cells),
                                 kPstfStale, path.own.control_rng);
  uint slot = control.place.slot;
  if (slot == kNoIndex) return;
  vec2 counts = uintBitsToFloat(pstf_texel(slot, 0u).zw);
  control.crowd = counts.x;
  control.taught = counts.y;
  control.albedo = control_albedo(v.scatter, v.view);
  vec4 incident = uintBitsToFloat(pstf_texel(slot, 3u));
  vec2 color = uintBitsToFloat(pstf_texel(slot, 2u).zw);
  control.mean = max(rgb_from_ycocg(vec3(incident.x, color)), vec3(0.0));
  control.luminance = incident.x;
  control.light = fitted_light(incident.x, incident.yzw, n);
  if (pstf.pstf_noise > 0.0) {
    control.mean *= vec3(1.0) + vec3(control_noise(slot, 0u), control_noise(slot, 1u), control_noise(slot, 2u));
    control.light.b += vec3(control_noise(slot, 3u), control_noise(slot, 4u), control_noise(slot, 5u));
    control.light.a += control_noise(slot, 6u);
  }
  if (path.depth >= uint(pstf.pstf_vertices)) return;
  vec3 moments = uintBitsToFloat(pstf_texel(slot, 5u).xyz);
  float samples = uintBitsToFloat(pstf_texel(slot, 4u).w);
  control.beta = pstf.pstf_learn_beta != 0 ? learnt_beta(ControlMoments(moments.x, moments.y, moments.z, samples))
                                           : pstf.pstf_beta;
}

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  prepare_guided(v, here, path, rng, g);
  prepare_control(v, path);
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  Proposal p = propose_guided(v, g, rng);
  float pdf = (p.flags & kScatterDelta) == 0u ? p.pdf : 0.0;
  control.drawn = pdf > 0.0;
  control.over = pdf > 0.0 ? max(dot(p.direction, control.normal), 0.0) / (kPiShared * pdf) : 0.0;
  control.off = control.over * linear_at(control.light, p.direction) - linear_integral(control.light, control.normal);
  return p;
}

const bool kHasControl = true;

vec3 control_mean(Vertex v, Guidance g, Field here) {
  vec3 mean = (control.beta * linear_integral(control.light, control.normal)) * control.albedo * control.mean;
  // As Eq. 24 is printed, for tests: biased.
  if (pstf.pstf_form == 1) return g.pdf > 0.0 ? mean / g.pdf : vec3(0.0);
  return mean;
}
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {
  float cosine = max(dot(direction, control.normal), 0.0) / kPiShared;
  return (control.beta * linear_at(control.light, direction) * cosine) * control.albedo * control.mean;
}
#endif
