// Step `record`: the pixel's chain takes up what the first ray of a path met (Alg. 3). A state that was accepted is
// updated before it is kept, not after, as Algorithm 3 is printed: a lobe that was just reset would be kept empty. What
// is refused updates nothing.
#ifndef FB_SSMM_RECORD
#define FB_SSMM_RECORD
#include "lib/place_of_light.glsl"
#include "shared/color.h"

const bool kRecords = true;

void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput) {
  if (path.depth == 0u) path.own.looked_for = direct.radiance;
}

void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput) {
  if (!g.mixes) return;
  path.own.scattered = g.own == kNoIndex;
  path.own.origin = v.position;
  path.own.hit = place_of_light(incident, p.direction, ssmm.ssmm_apparent != 0);
  bool product = ssmm.ssmm_product != 0 || !(p.pdf > 0.0);
  path.own.score = luminance(product ? p.weight * incident.emission : incident.emission / p.pdf);
}

void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput) {}

// A pixel's first path begins its chain with the state that it sampled (ssmm_keep 0: with none, so that a state which
// found no light is gone). What its own lobe finds, also nothing, always updates that; its score is another's once that
// is accepted.
void record_path(Path path, vec3 sum, inout uint rng) {
  if (IN_MEDIUM) return;
  uint at = lit_index(path.pixel);
  bool first = path.own.path == 0u;
  ChainState kept = no_chain_state();
  if (!first)
    kept = FB_LOAD_CHAIN(chain_states, at);
  else if (ssmm.ssmm_keep != 0)
    kept = lobe_of_element(path.own.element);
  float score = usable_score(ssmm.ssmm_indirect != 0 ? luminance(sum - path.own.looked_for) : path.own.score);
  bool accepted = score > 0.0 && path.own.origin != path.own.hit &&
                  (!is_valid_state(kept) || rng_uniform(rng) * kept.score < score);
  if (accepted) {
    ChainState s = no_chain_state();
    if (!path.own.scattered) s = lobe_of_element(path.own.element);
    kept = updated_state(s, path.own.origin, path.own.hit, score, ssmm.ssmm_alpha, float(ssmm.ssmm_count));
    kept.score = score;
  } else if (first && !path.own.scattered && is_valid_state(kept)) {
    kept = updated_state(kept, path.own.origin, path.own.hit, score, ssmm.ssmm_alpha, float(ssmm.ssmm_count));
    kept.score = min(kept.score, kept.weight);
  }
  if (accepted || first) {
    FB_STORE_CHAIN(chain_states, at, kept)
  }
}

// Its pixel keeps its place in the tile, and passes states on.
void record_none(uvec2 block, uvec2 pixel) {
  if (IN_MEDIUM) return;
  Tile t = tile_at(block, 0u);
  ChainState s = lobe_of_element(element_of_lane(t, sampled_lane(t, 0u)));
  uint at = lit_index(pixel);
  FB_STORE_CHAIN(chain_states, at, s)
}
#endif
