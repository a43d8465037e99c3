// Step `proposal`: a pixel's first vertex samples one lobe of its tile, or by its own scattering (Alg. 2), weighted by
// the density of all lobes that it might have had (Eq. 8 and 9). So f cos / pdf is unbiased whatever they hold: which
// of them it has is even over them and nothing that they hold decides it.
#ifndef FB_SSMM_PROPOSE
#define FB_SSMM_PROPOSE
#include "estimators/ssmm/steps/begin.glsl"

struct Guidance {
  bool mixes;  // a mixture of the tile's lobes, else the vertex's own scattering
  Tile tile;
  uint own;
};

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  g.mixes = !IN_MEDIUM && path.depth == 0u;
  g.own = kNoIndex;
  if (!g.mixes) return;
  g.own = path.own.element;
  g.tile = tile_at(path.pixel / frame.light_block, path.own.path);
}

VmfLobe lobe_at(Vertex v, ChainState s) {
  return chain_lobe(s, v.position, ssmm.ssmm_prior, ssmm.ssmm_prior_cosine, ssmm.ssmm_prior_size);
}

// Of all lobes that the pixel might have sampled, together with scattering of this density. A lane without a lobe
// scatters.
float mixture_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  bool temporal = ssmm.ssmm_temporal != 0;
  uint count = weighed_lanes(uint(frame.spp), g.tile.lanes, temporal), i = 0u;
  float lobes = 0.0, valid = 0.0;
  do {
    uint lane = weighed_lane(g.tile.lane, g.tile.draw, i, g.tile.lanes, temporal);
    ChainState s = lobe_of_element(element_of_lane(g.tile, lane));
    if (has_lobe(s, v.position)) {
      lobes += vmf_lobe_pdf(lobe_at(v, s), direction);
      valid += 1.0;
    }
  } while (++i < count);
  float guided = (1.0 - ssmm.ssmm_defence) / float(count);
  return guided * lobes + (1.0 - guided * valid) * scatter_pdf;
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  if (!g.mixes) return propose_scattered(v, rng);
  ChainState s = lobe_of_element(g.own);
  bool guided = rng_uniform(rng) >= ssmm.ssmm_defence && has_lobe(s, v.position);
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  vec3 direction;
  uint flags = 0u;
  if (guided) {
    VmfLobe lobe = lobe_at(v, s);
    direction = vmf_sample(lobe.mu, lobe.kappa, u.xy);
  } else {
    g.own = kNoIndex;
    ScatterSample sampled = scatter_sample(v.scatter, v.view, u);
    direction = sampled.direction;
    flags = sampled.flags;
  }
  float scatter_pdf;
  vec3 f = scatter_eval(v.scatter, v.view, direction, scatter_pdf);
  return proposed(direction, f, mixture_pdf(v, g, direction, scatter_pdf), flags);
}

float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  return g.mixes ? mixture_pdf(v, g, direction, scatter_pdf) : scatter_pdf;
}
#endif
