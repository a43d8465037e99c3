// What is known at a vertex, of its cell. The includer has the step `trees` before, steps/trees.glsl or
// steps/no_trees.glsl.
#ifndef FB_PSTF_GUIDANCE
#define FB_PSTF_GUIDANCE
#include "estimators/pstf/steps/field.glsl"

// Of Eq. 28, of a vertex whose light the field says: (1 - gamma) of that, and gamma of the unbiased estimate.
// Directions are drawn for teaching alone where gamma is 0: what they bring counts as next to nothing.
struct Prediction {
  vec3 light;          // of the field
  float scale;         // on what the path's direction brings
  float direct_scale;  // on light that is looked for, and
  vec3 found;          // this without it
};
const float kTeachingScale = 1.0 / 1048576.0;

struct Guidance {
  CellPlace place;
  float crowd;   // samples of a frame that last taught the cell,
  float taught;  // and of all
  vec3 normal;
  vec3 reflectance;  // of all light, of outgoing light's field
  vec3 albedo;       // of the Lambert surface that h is of
  vec3 mean;         // of incident light in the cell; zero: it is unknown
  float luminance;
  LinearLight light;  // by direction, over that mean
  ControlMoments moments;
  float beta;
  vec3 outgoing;  // of the field: where that is taken for the integral
  float pdf;      // of the direction that was drawn, and
  float over;     // what a white Lambert surface reflects of light from there, over pdf
  float off;      // h / pdf less its integral, over the mean
  CellTree tree;  // of directions
  Prediction prediction;
  vec3 integral;  // of h, by directions without rays, where it is not known; zero: it is
  vec3 estimate;  // h / pdf of the direction that was drawn, there
  vec3 weight;    // f cos / pdf of the direction that was drawn
};

vec3 lambert_albedo(Scatter s, vec3 view) {
  if (!FEATURE_SPECULAR || !bsdf_has_coat(s.bsdf)) return s.bsdf.albedo;
  float f0 = s.bsdf.specular, seen = max(dot(view, s.shading_normal), 0.0);
  return s.bsdf.albedo * ((1.0 - s.bsdf.metalness) * (1.0 - f0) * (1.0 - f0 - (1.0 - f0) * schlick_weight(seen)));
}

// Of the control variate: as learnt, or as set; 0 beyond the vertices that have one.
float beta_at(Path path, float learnt) {
  if (path.depth >= uint(pstf.pstf_vertices)) return 0.0;
  return pstf.pstf_learn_beta != 0 ? learnt : pstf.pstf_beta;
}

float noise_at(uint slot, uint of) {
  return pstf.pstf_noise * (float(hash_combine(slot * 8u + of, frame.frame)) * (2.0 / 4294967296.0) - 1.0);
}

void predict(inout Path path, inout Guidance g) {
  if (pstf.pstf_vertex == 1 && g.taught >= kEndsTaught) {
    float gamma = pstf.pstf_gamma;
    g.prediction.light = (1.0 - gamma) * g.reflectance * outgoing_light(g.place.slot, g.normal);
    g.prediction.direct_scale = gamma;
    g.prediction.scale = gamma > 0.0 ? gamma : path.own.teaches ? kTeachingScale : 0.0;
  }
  path.own.first.crowd = g.crowd;
  path.own.first.scale = g.prediction.scale;
}

// What the cell knows, for all steps `proposal` of these techniques.
void prepare_cell(Vertex v, Field here, inout Path path, out Guidance g) {
  path.own.from = v.position;
  path.own.scattered = true;
  path.own.looked_for = vec3(0.0);
  g.place = here.place;
  g.normal = v.scatter.shading_normal;
  g.reflectance = in_medium(v.scatter) ? vec3(0.0) : reflectance_of(v.scatter, v.view);
  g.albedo = lambert_albedo(v.scatter, v.view);
  g.crowd = g.taught = g.luminance = g.beta = 0.0;
  g.mean = g.outgoing = g.integral = g.estimate = vec3(0.0);
  g.prediction = Prediction(vec3(0.0), 1.0, 1.0, vec3(0.0));
  g.light = LinearLight(1.0, vec3(0.0));
  g.moments = ControlMoments(0.0, 0.0, 0.0, 0.0);
  if (kPredicts && path.depth == 0u)
    path.own.first = FirstVertex(g.place, 0.0, g.normal, g.reflectance, 1.0, vec3(0.0), region_about(v.position));
  // Of a surface seen from below its shading normal nothing is drawn.
  if (here.place.slot == kNoIndex || (FEATURE_SPECULAR && dot(v.view, g.normal) <= 0.0)) return;
  uint slot = here.place.slot;
  uvec2 counts = pstf_texel(slot, 0u).zw;
  g.crowd = uintBitsToFloat(counts.x);
  g.taught = uintBitsToFloat(counts.y);
  vec4 incident = uintBitsToFloat(pstf_texel(slot, 3u));
  g.mean = max(rgb_from_ycocg(vec3(incident.x, uintBitsToFloat(pstf_texel(slot, 2u).zw))), vec3(0.0));
  g.luminance = incident.x;
  g.light = fitted_light(incident.x, incident.yzw, g.normal);
  if (pstf.pstf_noise > 0.0) {
    g.mean *= vec3(1.0 + noise_at(slot, 0u), 1.0 + noise_at(slot, 1u), 1.0 + noise_at(slot, 2u));
    g.light.b += vec3(noise_at(slot, 3u), noise_at(slot, 4u), noise_at(slot, 5u));
    g.light.a += noise_at(slot, 6u);
  }
  vec3 moments = uintBitsToFloat(pstf_texel(slot, 5u).xyz);
  g.moments = ControlMoments(moments.x, moments.y, moments.z, uintBitsToFloat(pstf_texel(slot, 4u).w));
  if (kPredicts && path.depth == 0u) predict(path, g);
  if (pstf.pstf_form == 2) g.outgoing = outgoing_light(slot, g.normal);
}
#endif
