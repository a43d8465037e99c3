// The table of states: an ensemble of hash grids (Alber 2025, Section 4), whose cells hold GUIDE_BUCKET states each
// (the paper's: one).
#ifndef FB_MCPG_STATES
#define FB_MCPG_STATES
#include "estimators/mcpg/steps/cache.glsl"

layout(constant_id = kSpecResolve) const
    bool GUIDE_RESOLVE = false;  // store proposals, which a pass resolves in a fixed order
layout(constant_id = kSpecAccesses) const uint GUIDE_ACCESSES = 2u;  // cells that are looked at
layout(constant_id = kSpecBucket) const uint GUIDE_BUCKET = 4u;      // states in a cell
const uint kGuideLobes = GUIDE_ACCESSES * GUIDE_BUCKET;              // the paper's N_mc

struct GuideCell {
  uint first;  // index of its first state
  uint check;
};

// The orientation by which adaptive cells part a vertex from others at its place. In a medium the view stands for the
// normal, spread like a cosine lobe about it, so that directions share what they know (Alber 2025, Section 4).
vec3 cell_orientation(Scatter s, inout uint group_rng) {
  vec3 axis = scatter_axis(s);
  if (!in_medium(s)) return axis;
  float z = 1.0 - 2.0 * rng_uniform(group_rng), turn = 2.0 * kPiShared * rng_uniform(group_rng);
  return axis + vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(turn), sin(turn)), z);
}

// The cell that a point falls into, at random: of the adaptive grid (at a random level) or of the static one of access
// `a`.
GuideCell guide_cell(vec3 p, Scatter s, bool adaptive, uint a, inout uint group_rng) {
  vec3 u = vec3(rng_uniform(group_rng), rng_uniform(group_rng), rng_uniform(group_rng));
  float width = guide.mc_static_width * pow(guide.mc_wider, float(a));
  uint tag = kStaticTag + (guide.mc_wider > 1.0 ? a : 0u);
  if (adaptive) {
    uint level = grid_level(distance(p, frame.camera_position.xyz), guide.adaptive_angle, rng_uniform(group_rng));
    level = min(level + grid_coarsening(guide.mc_coarser, rng_uniform(group_rng)), kGridLevels - 1u);
    width = exp2(float(level));
    tag = adaptive_tag(level, cell_orientation(s, group_rng));
  }
  GridKey key = grid_vertex(p, width, tag, vec3(0.5) + guide.mc_jitter * (u - 0.5));
  uint buckets = guide.mc_states / GUIDE_BUCKET;
  return GuideCell((key.hash & (buckets - 1u)) * GUIDE_BUCKET, key.check);
}

layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kGuideStates) uniform usamplerBuffer state_texels;

uvec4 guide_quad(uint at) { return texelFetch(state_texels, int(at)); }
uvec2 load_guide_motion(uint at) {
  uvec4 two = guide_quad(guide.mc_states + (at >> 1u));
  return (at & 1u) == 0u ? two.xy : two.zw;
}
GuideState load_guide_state(uint at) {
  return add_guide_motion(unpack_guide_state(guide_quad(at)), load_guide_motion(at));
}

// `seen`: its light was there.
void store_guide_state(GuideState s, uint at, uint proposal, bool seen) {
  if (isnan(s.weight) || isinf(s.weight) || any(isnan(s.target)) || any(isinf(s.target))) {
    atomicAdd(counters.at[kCounterGuideNan], 1u);
    return;
  }
  uvec4 words = pack_guide_state(s);
  uvec2 motion = pack_guide_motion(s);
  if (GUIDE_RESOLVE) {
    guide_proposals.at[proposal * 2u] = words;
    guide_proposals.at[proposal * 2u + 1u] = uvec4(motion, at, seen ? 1u : 0u);
    atomicMax(guide_cache.at[guide_winner_at() + at], proposal_rank(proposal, seen));
  } else {
    guide_states.at[at] = words;
    store_guide_motion(at, motion);
  }
}

uint guide_age(GuideState s) { return (guide.frame_number - s.time) & 0xffffu; }

// Where its light should be now (Alber 2025, eq. 10), for the few frames that this can be trusted. The paper's method
// has no such limit: there it is the last frame whose time is known.
vec3 predicted_target(GuideState s) {
  uint age = guide_age(s), last = guide.mc_paper != 0 ? kPastFrames - 1u : kTrustedFrames;
  bool moves = guide.mc_predict != 0 && age <= last;
  return moves ? s.target + s.velocity * guide.elapsed[(age % kPastFrames) / 4u][age % 4u] : s.target;
}

GuideView view_state(GuideState s, vec3 to_target, Scatter at) {
  float cosine = scatter_cosine(at, to_target) * inversesqrt(dot(to_target, to_target));
  return view_guide_state(s, to_target, cosine, guide.prior_extent, guide.mc_in_world != 0);
}
#endif
