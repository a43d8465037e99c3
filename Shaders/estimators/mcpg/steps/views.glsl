// Step `views`: what is known at the first vertex, as colours (shared/debug_views.h, kViewOfGuide).
#ifndef FB_MCPG_STEPS_VIEWS
#define FB_MCPG_STEPS_VIEWS
#include "lib/incident.glsl"
#include "lib/store_light.glsl"
#include "estimators/mcpg/steps/propose.glsl"
#include "shared/tone.h"

vec3 heat(float x) {
  return clamp(vec3(1.5 - abs(4.0 * x - 3.0), 1.5 - abs(4.0 * x - 2.0), 1.5 - abs(4.0 * x - 1.0)), 0.0, 1.0);
}
vec3 cell_color(uint h) {
  h = hash_u32(h);
  return vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;
}

// The state of most weight in a cell, that cell, and whether other cells' states lie in its slots.
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

// What a ray from a vertex meets: the light of it that guiding is for.
vec3 light_met(Vertex v, Field here, Proposal p, Path path, inout uint rng) {
  Segment way = segment_from(v, p.direction, kRayEnd, kTurnByChance, rng);
  Surface s = load_surface(way.hit, way.direction, kFilterNearest, false, false);
  if (kLooksForLight) s.emission *= met_share(v, way, p, s.emission, path);
  if (way.hit.instance == kNoIndex || most_reflections() <= 1u) return s.emission * way.left;
  Vertex next = end_of_segment(way, s);
  return (s.emission + field_reflection(field_at(next, path), here, next)) * way.left;
}

const bool kHasViews = true;

bool shows_directions() { return frame.debug_view == kViewGuideIncident; }
bool measures_moments() { return frame.debug_view == kViewGuideCover; }

// All directions above the surface in the picture's middle, twice, the surface's normal in the middle of a disc of
// equal areas: to the left the light that comes from there, to the right the density that it is sampled with,
// logarithmic.
vec3 view_of_directions(PathPixel pixel_of) {
  uvec2 pixel = pixel_of.pixel;
  GBufferTexel g = gbuffer_at((frame.height / 2u) * frame.width + frame.width / 2u);
  if (g.position_t.w == 0.0) return vec3(0.0);
  float half_width = 0.5 * float(frame.width), radius = 0.48 * min(half_width, float(frame.height));
  bool right = float(pixel.x) + 0.5 > half_width;
  vec2 at = (vec2(pixel) + 0.5 - vec2(right ? 1.5 * half_width : 0.5 * half_width, 0.5 * float(frame.height))) / radius;
  float r2 = dot(at, at);
  Vertex v = first_vertex(g, uvec2(frame.width / 2u, frame.height / 2u));
  float z = 1.0 - r2, spread = sqrt(max(2.0 - r2, 0.0));  // equal areas (Lambert's azimuthal projection)
  Path path = path_of(pixel_of, 0u);
  path.own.guided.group_rng = rng_seed(0u, frame.frame, 1u, frame.seed);  // the same cells for the whole picture
  path.last = most_reflections() <= 1u;
  uint rng = rng_seed(pixel.y * frame.width + pixel.x, frame.frame, 0u, frame.seed);
  Field here = field_at(v, path);
  Guidance g2;
  prepare(v, here, path, rng, g2);
  vec3 direction = frame_about(v.scatter.normal) * vec3(at.x * spread, -at.y * spread, z);
  float bsdf;
  vec3 f = scatter_eval(v.scatter, v.view, direction, bsdf);
  Proposal p = proposed(direction, f, proposal_pdf(v, g2, direction, bsdf), 0u);
  if (r2 > 1.0) return vec3(0.02);
  if (right) return heat(clamp(log2(max(p.pdf, 1e-6)) / 16.0 + 0.4, 0.0, 1.0));
  return srgb_from_linear(filmic(light_met(v, here, p, path, rng) * exposure_now()));
}

// Second moments of a sample at the first vertex, in the place of radiance: that of directions where the lobes have
// less than a tenth of the BSDF's density, that of all, and the estimate itself, so that means over frames say how much
// of the variance is of light that no lobe stands for.
vec3 view_of_moments(Vertex v, Path path, uint rng) {
  path.last = most_reflections() <= 1u;
  Field here = field_at(v, path);
  Guidance g;
  prepare(v, here, path, rng, g);
  Proposal p = propose(v, g, rng);
  if (p.weight == vec3(0.0)) return vec3(0.0);
  float light = luminance(p.weight * light_met(v, here, p, path, rng));
  return vec3(g.guided_pdf < 0.1 * g.bsdf_pdf ? light * light : 0.0, light * light, light);
}

vec3 view_color(Vertex v, Path path, uint rng) {
  vec3 axis = scatter_axis(v.scatter);
  bool adaptive = guide.mc_adaptive > 0.0;
  uint level = grid_level(distance(v.position, frame.camera_position.xyz), guide.adaptive_angle, 0.0);
  if (!adaptive) level = uint(log2(guide.mc_static_width) + 0.5);
  GridKey key = grid_vertex(v.position, adaptive ? exp2(float(level)) : guide.mc_static_width,
                            adaptive ? adaptive_tag(level, axis) : kStaticTag, vec3(0.5));
  GuideCell cell = GuideCell((key.hash & (guide.mc_states / GUIDE_BUCKET - 1u)) * GUIDE_BUCKET, key.check);
  bool collides;
  GuideState s = strongest_state(v, cell, collides);
  vec3 to_target = s.target - v.position;
  bool known = s.weight > 0.0 && dot(to_target, to_target) > 1e-6;
  GuideView view = view_state(s, known ? to_target : axis, v.scatter);
  CacheCell cached = find_cache_cell(v.position, axis, kCacheTag, path.own.guided.group_rng);
  bool has_cache = cached.entry != kNoIndex;
  switch (frame.debug_view) {
    case kViewGuideDirection:
      return known ? view.direction * 0.5 + 0.5 : vec3(0.0);
    case kViewGuideCosine:
      return known ? heat(clamp(-log2(max(view.spread, 1e-6)) / 16.0, 0.0, 1.0)) : vec3(0.0);
    case kViewGuideWeight:
      return known ? heat(clamp(log2(s.weight * view.scale * exposure_now()) / 16.0 + 0.7, 0.0, 1.0)) : vec3(0.0);
    case kViewGuideSamples:
      return known ? heat(float(s.count) / float(guide.mc_count)) : vec3(0.0);
    case kViewGuideLevel:
      return mix(heat(float(level) / 8.0), cell_color(key.hash), 0.3);
    case kViewGuideCollisions:
      return collides ? vec3(1.0, 0.2, 0.1) : known ? vec3(0.1, 0.4, 0.1) : vec3(0.0);
    case kViewGuideAge:
      return known ? heat(1.0 - float(min(guide_age(s), 64u)) / 64.0) : vec3(0.0);
    case kViewGuideCache: {
      vec3 x = has_cache ? cached_reflection(cached.entry) * (0.5 * exposure_now()) : vec3(0.0);
      return has_cache ? sqrt(x / (1.0 + x)) : vec3(0.5, 0.0, 0.5);
    }
    case kViewGuideCover:
    case kViewGuideSampler: {
      path.last = most_reflections() <= 1u;
      Guidance g;
      prepare(v, field_at(v, path), path, rng, g);
      propose(v, g, rng);
      return g.choice.state != kNoIndex ? vec3(0.1, 0.8, 0.2)
             : g.total > 0.0            ? vec3(0.2, 0.3, 0.9)
                                        : vec3(0.8, 0.2, 0.1);
    }
    default:
      return heat(learnt_share(cached, has_cache ? cache_frames(cached.entry) : 0u));
  }
}

void draw_view(PathPixel p, bool lit, Vertex v) {
  vec3 color = vec3(0.0);
  if (shows_directions()) {
    color = view_of_directions(p);
  } else if (lit) {
    Path path = path_of(p, 0u);
    path.own.guided.group_rng = rng_seed(p.at, frame.frame, 1u, frame.seed);  // each pixel looks for itself
    color = view_color(v, path, rng_seed(p.at, frame.frame, 0u, frame.seed));
  }
  ldr.at[p.at] = packUnorm4x8(vec4(color, 1.0));
  if (!measures_moments()) return;
  vec3 moments =
      lit ? view_of_moments(v, path_of(p, 0u), rng_seed(p.at, frame.frame, frame.spp, frame.seed)) : vec3(0.0);
  radiance.at[p.at].rgb = moments;
}
#endif
