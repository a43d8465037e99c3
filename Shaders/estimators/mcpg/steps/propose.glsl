// Step `proposal`: a direction from the lobes or from the BSDF (Alber 2025, Alg. 2), weighted by the density of both
// together, given the states that were loaded: f cos / pdf is unbiased whatever they hold (eq. 6).
//
// Beyond the paper: how often the lobes are sampled is learnt (r_mc_learn_share 0: fixed, as there).
#ifndef FB_MCPG_PROPOSE
#define FB_MCPG_PROPOSE
#include "estimators/mcpg/steps/field.glsl"
#include "estimators/mcpg/steps/mixture.glsl"

const float kLeastUseful = 0.06;
const float kShareFrames = 16.0;  // after which a cell's own moments count as much as those of all

// The probability of guiding that second moments ask for: of several, which were all tried on the same samples, the
// ones whose moments are low (off-policy: f^2 / (p_k p) averages f^2 / p_k whatever p the samples are from).
float best_share(vec4 m) {
  // Moments are over the squared mean: less one they are variances, which the floor keeps from being trusted too far.
  vec4 variance = max(m - 1.0, vec4(0.0)) + 0.03;
  vec4 w = min(min(variance.x, variance.y), min(variance.z, variance.w)) / variance;
  w *= w;
  w *= w;
  return dot(w, guide_shares()) / dot(w, vec4(1.0));
}

bool known_moments(vec4 m) { return min(min(m.x, m.y), min(m.z, m.w)) > 0.0; }

// How often to guide at a point: as its cell has learnt or, while the cell knows little, as all cells have together.
float learnt_share(CacheCell cell, uint cell_frames) {
  if (guide.mc_learn_share == 0) return guide.mc_share;
  vec4 all = mean_moments();
  float share = known_moments(all) ? best_share(all) : guide.mc_share;
  if (cell.entry != kNoIndex) {
    vec4 m = cached_moments(cell.entry);
    float n = float(cell_frames);
    if (known_moments(m)) share = mix(share, best_share(m), n / (n + kShareFrames));
  }
  // A guided sample that finds nothing costs more than it brings where there is next to nothing to guide to.
  return clamp(share < kLeastUseful ? 0.0 : share, guide.mc_share_min, guide.mc_share_max);
}

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  g.cache = here.cell;
  g.cache_frames = g.cache.entry != kNoIndex ? cache_frames(g.cache.entry) : 0u;
  g.last = path.last;
  g.moved = guide.mc_previous != 0 && v.previous != v.position;
  g.share = g.total = g.all = 0.0;
  g.choice.state = kNoIndex;
  if (!GUIDES) return;
  load_mixture(v, g, path.own.guided.group_rng, rng);
  // A flame's own texels are lit by the flame, in whatever direction: the BSDF has no variance there, and their cell
  // knows nothing of it.
  bool guided = g.total > 0.0 && (!v.glows || guide.mc_paper != 0);
  g.share = guided ? learnt_share(g.cache, g.cache_frames) : 0.0;
}

float share_pdf(Guidance g, float guided_pdf, float bsdf_pdf) {
  return g.share * guided_pdf + (1.0 - g.share) * bsdf_pdf;
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  bool guided = rng_uniform(rng) < g.share;
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  vec3 direction;
  uint flags = 0u;
  if (guided) {
    direction = vmf_sample(g.choice.lobe.mu, g.choice.lobe.kappa, u.xy);
  } else {
    g.choice.state = kNoIndex;
    ScatterSample s = scatter_sample(v.scatter, v.view, u);
    direction = s.direction;
    flags = s.flags;
  }
  g.home = g.moved ? 0u : min(uint(rng_uniform(rng) * float(GUIDE_ACCESSES)), GUIDE_ACCESSES - 1u);
  g.guided_pdf = GUIDES ? mixture_pdf(g, direction, g.slot) : 0.0;
  vec3 f = scatter_eval(v.scatter, v.view, direction, g.bsdf_pdf);
  g.pdf = share_pdf(g, g.guided_pdf, g.bsdf_pdf);
  g.below = !scatters_to(v.scatter, direction);
  return proposed(direction, f, g.pdf, flags);
}

float proposal_pdf(Vertex v, Guidance g, vec3 direction, float bsdf_pdf) {
  if (!GUIDES) return bsdf_pdf;
  GuideSlot slot;
  return g.share > 0.0 ? share_pdf(g, mixture_pdf(g, direction, slot), bsdf_pdf) : bsdf_pdf;
}
#endif
