// Step `views`: what is known at the first vertex, as colours (shared/debug_views.h, kViewOfGuide).
#ifndef FB_MCPG_VIEWS
#define FB_MCPG_VIEWS
#include "lib/steps/mcpg/propose.glsl"

vec3 heat(float x) { return clamp(vec3(1.5 - abs(4.0 * x - 3.0), 1.5 - abs(4.0 * x - 2.0), 1.5 - abs(4.0 * x - 1.0)), 0.0, 1.0); }
vec3 cell_color(uint h) {
  h = hash_u32(h);
  return vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;
}

// The state of most weight in the finest cell about a vertex, that cell, and whether other cells' states lie in its slots.
GuideState strongest_state(Vertex v, GuideCell cell, out bool collides) {
  GuideState best = empty_guide_state();
  collides = false;
  for (uint j = 0u; j < GUIDE_BUCKET; ++j) {
    GuideState s = load_guide_state(cell.first + j);
    if (s.check == cell.check && s.weight > best.weight) best = s;
    collides = collides || (s.check != 0u && s.check != cell.check);
  }
  return best;
}

vec3 view_color(Vertex v, Path path, uint rng) {
  uint level = grid_level(distance(v.position, frame.camera_position.xyz), guide.adaptive_angle, 0.0);
  vec3 axis = scatter_axis(v.scatter);
  GridKey key = grid_vertex(v.position, exp2(float(level)), adaptive_tag(level, axis), vec3(0.5));
  GuideCell cell = GuideCell((key.hash & (guide.mc_states / GUIDE_BUCKET - 1u)) * GUIDE_BUCKET, key.check);
  bool collides;
  GuideState s = strongest_state(v, cell, collides);
  vec3 to_target = s.target - v.position;
  bool known = s.weight > 0.0 && dot(to_target, to_target) > 1e-6;
  GuideView view = view_state(s, known ? to_target : axis, v.scatter);
  CacheCell cached = find_cache_cell(v.position, axis, path.group_rng);
  bool has_cache = cached.entry != kNoIndex;
  switch (frame.debug_view) {
    case kViewGuideDirection: return known ? view.direction * 0.5 + 0.5 : vec3(0.0);
    case kViewGuideCosine: return known ? heat(clamp(-log2(max(view.spread, 1e-6)) / 16.0, 0.0, 1.0)) : vec3(0.0);
    case kViewGuideWeight: return known ? heat(clamp(log2(s.weight * view.scale * exposure_now()) / 16.0 + 0.7, 0.0, 1.0)) : vec3(0.0);
    case kViewGuideSamples: return known ? heat(float(s.count) / float(guide.mc_count)) : vec3(0.0);
    case kViewGuideLevel: return mix(heat(float(level) / 8.0), cell_color(key.hash), 0.3);
    case kViewGuideCollisions: return collides ? vec3(1.0, 0.2, 0.1) : known ? vec3(0.1, 0.4, 0.1) : vec3(0.0);
    case kViewGuideAge: return known ? heat(1.0 - float(min(guide_age(s), 64u)) / 64.0) : vec3(0.0);
    case kViewGuideCache: {
      vec3 x = has_cache ? cached_reflection(cached.entry) * (0.5 * exposure_now()) : vec3(0.0);
      return has_cache ? sqrt(x / (1.0 + x)) : vec3(0.5, 0.0, 0.5);
    }
    case kViewGuideSampler: {
      path.last = frame.bounces <= 1u;
      Guidance g;
      prepare(v, field_at(v, path), path, rng, g);
      propose(v, g, rng);
      return g.choice.state != kNoIndex ? vec3(0.1, 0.8, 0.2) : g.total > 0.0 ? vec3(0.2, 0.3, 0.9) : vec3(0.8, 0.2, 0.1);
    }
    default:
      return heat(learnt_share(cached, has_cache ? cache_frames(cached.entry) : 0u));
  }
}
#endif
