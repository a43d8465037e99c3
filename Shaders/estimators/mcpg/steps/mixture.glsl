// The mixture of lobes at a vertex: grid resampling (Alber 2025, Alg. 1) and the lobes' density (Alg. 2; the
// denominator of eq. 6).
#ifndef FB_MCPG_MIXTURE
#define FB_MCPG_MIXTURE
#include "estimators/mcpg/steps/states.glsl"

// One lobe of it, chosen by its weight.
struct GuideChoice {
  VmfLobe lobe;
  float part;  // its weight
  uint state;  // kNoIndex: there is none
};

// Where what a direction finds is stored: the slot of the home cell whose lobe explains the direction best, or else the
// one that is worth least.
struct GuideSlot {
  uint at, check;  // index of the state; for which cell
  bool matched;    // the lobe there explains the direction
  bool near;       // which is nearer to its mean than its mean cosine
  float part;      // weight in the mixture, if matched
  float worth;     // of the least one
};

// What is known at a vertex, and of the direction that is proposed there. (GLSL cannot assign arrays whose size is a
// specialisation constant: hence one struct, which functions fill.)
struct Guidance {
  VmfLobe lobes[kGuideLobes];
  vec2 weights[kGuideLobes];  // in the mixture; the state's score here
  GuideCell cells[GUIDE_ACCESSES];
  float total, all;  // sums of the weights
  bool moved;        // the last cell is of where the vertex was (the paper's method: all are)
  bool last;         // emission alone counts
  CacheCell cache;
  uint cache_frames;   // that it has been trained in
  float share;         // probability of sampling the lobes
  GuideChoice choice;  // what is sampled; state kNoIndex: the BSDF
  uint home;           // the cell that the result goes to, and where in it
  GuideSlot slot;
  float pdf, guided_pdf, bsdf_pdf;  // of the direction
  bool below;                       // it points into the surface
};

// Takes states from the cells about the vertex, and chooses one lobe. `last` and `moved` are set.
void load_mixture(Vertex v, inout Guidance g, inout uint group_rng, inout uint rng) {
  g.total = 0.0;
  g.all = 0.0;
  vec3 axis = scatter_axis(v.scatter);
  g.choice = GuideChoice(VmfLobe(axis, 0.0, 0.0), 0.0, kNoIndex);
  float stratum = rng_uniform(group_rng);
  [[unroll]] for (uint a = 0u; a < GUIDE_ACCESSES; ++a) {
    bool adaptive = guide.mc_paper != 0 ? rng_uniform(group_rng) < guide.mc_adaptive
                                        : float(a) + stratum < guide.mc_adaptive * float(GUIDE_ACCESSES);
    bool from_past = g.moved && (a + 1u == GUIDE_ACCESSES || guide.mc_paper != 0);
    GuideCell cell = guide_cell(from_past ? v.previous : v.position, v.scatter, adaptive, a, group_rng);
    g.cells[a] = cell;
    [[unroll]] for (uint j = 0u; j < GUIDE_BUCKET; ++j) {
      uint i = a * GUIDE_BUCKET + j;
      uvec4 words = guide_quad(cell.first + j);
      GuideState s = unpack_guide_state(words);
      if (guide_state_moves(words) && s.check == cell.check) s = add_guide_motion(s, load_guide_motion(cell.first + j));
      vec3 to_light = predicted_target(s) - v.position;
      float d2 = dot(to_light, to_light);
      bool valid = s.check == cell.check && s.weight > 0.0 && d2 > 1e-6;
      GuideView view = view_state(s, valid ? to_light : axis, v.scatter);
      bool scatters = scatters_to(v.scatter, view.direction), paper = guide.mc_paper != 0;
      float score =
          valid && (scatters || !paper) ? s.weight * view.scale : 0.0;  // Alber 2025, Section 4, Step 1: left out
      float part = scatters ? (g.last && !paper ? score * s.emissive : score) : 0.0;
      if (guide.mc_power != 1.0) part = part > 0.0 ? pow(part, guide.mc_power) : 0.0;
      g.lobes[i] = vmf_lobe(view.direction, vmf_kappa(view.spread));
      g.weights[i] = vec2(part, score);
      g.total += part;
      g.all += score;
      if (rng_uniform(rng) * g.total < part) g.choice = GuideChoice(g.lobes[i], part, cell.first + j);
    }
  }
}

const float kMatch = 0.02;  // a direction belongs to a lobe whose pdf there is at least this share of its peak

// Density of the lobes in a direction, each as often as it is chosen; per solid angle. Finds the slot on the way.
float mixture_pdf(Guidance g, vec3 direction, out GuideSlot slot) {
  float pdf = 0.0, best = 0.0, least = 3e38, best_part = 0.0;
  uint best_slot = 0u, least_slot = 0u;
  slot.near = false;
  [[unroll]] for (uint i = 0u; i < kGuideLobes; ++i) {
    VmfLobe lobe = g.lobes[i];
    vec2 weight = g.weights[i];
    float t = vmf_one_minus_cosine(lobe.mu, direction) * lobe.kappa;
    float e = exp(-t), p = e * lobe.scale * weight.x;
    pdf += p;
    bool here = i / GUIDE_BUCKET == g.home;
    float fit = e > kMatch ? max(p, e * 1e-30) : 0.0;
    if (here && weight.y > 0.0 && fit > best) {
      best = fit;
      best_slot = i;
      best_part = weight.x;
      slot.near = t < 1.0;
    }
    // Light that no lobe stands for is found by the BSDF alone: its second moment is what a slot is worth.
    float worth = weight.y * weight.y * lobe.scale;
    if (here && worth < least) {
      least = worth;
      least_slot = i;
    }
  }
  GuideCell cell = g.cells[0];
  [[unroll]] for (uint a = 1u; a < GUIDE_ACCESSES; ++a) {
    if (a == g.home) cell = g.cells[a];
  }
  slot.matched = GUIDE_BUCKET > 1u && best > 0.0;
  slot.at = cell.first + (slot.matched ? best_slot : least_slot) % GUIDE_BUCKET;
  slot.check = cell.check;
  slot.part = g.total > 0.0 ? best_part / g.total : 0.0;
  slot.worth = least;
  return g.total > 0.0 ? pdf / g.total : 0.0;
}
#endif
