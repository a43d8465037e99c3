// The mixture of lobes at a vertex: grid resampling (Alber 2025, Alg. 1) and the lobes' density (Alg. 2; the denominator of
// eq. 6).
#ifndef FB_MCPG_MIXTURE
#define FB_MCPG_MIXTURE
#include "estimators/mcpg/states.glsl"

// One lobe of it, chosen by its weight.
struct GuideChoice {
  VmfLobe lobe;
  float part;  // its weight
  uint state;  // kNoIndex: there is none
};

// What is known at a vertex, and of the direction that is proposed there. (GLSL cannot assign arrays whose size is a
// specialisation constant: hence one struct, which functions fill.)
struct Guidance {
  VmfLobe lobes[kGuideLobes];
  vec2 weights[kGuideLobes];  // in the mixture; the state's score here
  GuideCell cells[GUIDE_ACCESSES];
  float total, all;    // sums of the weights
  bool moved;          // the last cell is of where the vertex was
  bool last;           // emission alone counts
  CacheCell cache;
  uint cache_frames;   // that it has been trained in
  float share;         // probability of sampling the lobes
  GuideChoice choice;  // what is sampled; state kNoIndex: the BSDF
  uint home;           // the cell that the result goes to
  float pdf, guided_pdf, bsdf_pdf;  // of the direction
  bool below;                       // it points into the surface
};

// Takes states from the cells about the vertex, and chooses one lobe. `last` and `moved` are set.
void load_mixture(Vertex v, inout Guidance g, inout uint group_rng, inout uint rng) {
  g.total = 0.0;
  g.all = 0.0;
  g.choice = GuideChoice(VmfLobe(v.normal, 0.0, 0.0), 0.0, kNoIndex);
  float stratum = rng_uniform(group_rng);
  [[unroll]] for (uint a = 0u; a < GUIDE_ACCESSES; ++a) {
    bool adaptive = float(a) + stratum < frame.guide_grid.z * float(GUIDE_ACCESSES);
    bool from_past = g.moved && a + 1u == GUIDE_ACCESSES;
    GuideCell cell = guide_cell(from_past ? v.previous : v.position, v.normal, adaptive, group_rng);
    g.cells[a] = cell;
    [[unroll]] for (uint j = 0u; j < GUIDE_BUCKET; ++j) {
      uint i = a * GUIDE_BUCKET + j;
      uvec4 words = guide_states[cell.first + j];
      GuideState s = unpack_guide_state(words);
      if (guide_state_moves(words) && s.check == cell.check) s = add_guide_motion(s, load_guide_motion(cell.first + j));
      vec3 to_light = predicted_target(s) - v.position;
      float d2 = dot(to_light, to_light);
      bool valid = s.check == cell.check && s.weight > 0.0 && d2 > 1e-6;
      GuideView view = view_state(s, valid ? to_light : v.normal, v.normal);
      float score = valid ? s.weight * view.scale : 0.0;
      float part = dot(view.direction, v.normal) > 0.0 ? (g.last ? score * s.emissive : score) : 0.0;
      if (frame.guide_pick.x != 1.0) part = part > 0.0 ? pow(part, frame.guide_pick.x) : 0.0;
      g.lobes[i] = vmf_lobe(view.direction, vmf_kappa(view.spread));
      g.weights[i] = vec2(part, score);
      g.total += part;
      g.all += score;
      if (rng_uniform(rng) * g.total < part) g.choice = GuideChoice(g.lobes[i], part, cell.first + j);
    }
  }
}

// Density of the lobes, each as often as it is chosen; per solid angle.
float mixture_pdf(Guidance g, vec3 direction) {
  float pdf = 0.0;
  [[unroll]] for (uint i = 0u; i < kGuideLobes; ++i) {
    VmfLobe lobe = g.lobes[i];
    float t = vmf_one_minus_cosine(lobe.mu, direction) * lobe.kappa;
    float e = exp(-t), p = e * lobe.scale * g.weights[i].x;
    pdf += p;
  }
  return g.total > 0.0 ? pdf / g.total : 0.0;
}
#endif
