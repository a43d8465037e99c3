// Stage 1: the state that each pixel samples from in this frame: its own of the former frame or one of a few pixels
// about it, each as often as its score is of all (Alg. 1), or that of its cell of the world (r_ssmm_world), which
// outlasts cuts and what is out of sight. Pixels without paths take part, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/ssmm/steps/states.glsl"
#include "estimators/ssmm/steps/world.glsl"

ChainState former_state(vec2 point) {
  bool inside = all(greaterThanEqual(point, vec2(0.0))) && all(lessThan(point, vec2(frame.width, frame.height)));
  uvec2 block = uvec2(inside ? point : vec2(0.0)) / max(frame.former_light_block, 1u);
  ChainState s = no_chain_state();
  if (inside) s = FB_LOAD_CHAIN(chain_states, block.y * frame.light_width + block.x);
  return s;
}

void main() {
  uvec2 block = invocation_pixel();
  if (any(greaterThanEqual(block, lit_blocks()))) return;
  uint at = block.y * frame.light_width + block.x;
  ChainState s = no_chain_state();
  float sum = 0.0;
  if (ssmm.known != 0u) {
    uvec2 pixel = light_pixel(block);
    bool within = pixel.x < frame.width && pixel.y < frame.height;
    vec2 motion = within ? uintBitsToFloat(gbuffer_quad(pixel.y * frame.width + pixel.x, 4u).xy) : vec2(0.0);
    vec2 point = vec2(pixel) + 0.5 + motion;
    s = former_state(point);
    float window = ssmm.ssmm_window * float(frame.height) / 1080.0;
    sum = chain_score(s);
    uint rng = rng_seed(at, frame.frame, 0x9e3779b1u, frame.seed);
    for (int i = 0; i < ssmm.ssmm_neighbors; ++i) {
      float x = spline_offset(rng_next(rng)), y = spline_offset(rng_next(rng));
      ChainState other = former_state(point + window * vec2(x, y));
      float score = chain_score(other);
      sum += score;
      if (score > 0.0 && (!is_valid_state(s) || rng_uniform(rng) * sum < score)) s = other;
    }
  }
  GridKey cell;
  if (ssmm.ssmm_world != 0 && world_cell(block, cell)) {
    uint rng = rng_seed(at, frame.frame, 0x85ebca6bu, frame.seed);
    ChainState other = state_of_cell(cell);
    float score = chain_score(other);
    if (score > 0.0 && (!is_valid_state(s) || rng_uniform(rng) * (sum + score) < score)) s = other;
    claim_cell(cell, claim_of(at, claim_order()));
  }
  FB_STORE_CHAIN(chain_lobes, at, s)
}
