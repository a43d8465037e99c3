// Looking for what glows: triangles from the list of lights (power-proportional, uniform over a triangle), suns by
// their discs. All densities are per solid angle as seen from the origin of the ray.
#ifndef FB_LIB_LOOK_FOR_LIGHT
#define FB_LIB_LOOK_FOR_LIGHT
#include "lib/light_candidates.glsl"
#include "lib/path_state.glsl"
#include "lib/suns.glsl"

uint light_seen_stride();  // of this many rays one is remembered; the technique defines it

bool shows_sky(GpuMaterial m, uint instance) {
  return m.emission_kind == kEmissionSky && (instance_at(instance).flags & kInstanceHasColor) == 0u;
}
bool is_sky(Hit hit) {
  if (hit.instance == kNoIndex) return frame.sky_beyond != 0u;
  return shows_sky(material_of(hit.instance, hit.triangle), hit.instance);
}

// A direction to look for light in.
struct Aim {
  vec3 direction;
  vec3 f;        // f cos
  float weight;  // f cos times this is the factor on the emission that is met; zero: nothing to look for
  float reach;
  float density, bsdf_pdf;  // with which the direction is looked for, and of the BSDF
  uint instance, triangle;  // what must be met; kNoIndex: a sun
  uint turn;                // on the way to it
  uint cell;                // of the grid of what such rays reach
  uint lamp;                // its name (shared/seen_grid.h); 0: none
  uint way;                 // of the list's: to where (seen_way)
};
const Aim kNoAim =
    Aim(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, kNoIndex, kNoIndex, kTurnNowhere, 0u, 0u, 0u);

// Emission towards its origin of what a ray meets, as load_surface has it. Where interfaces end the ray (`stopped`)
// that of an opaque part of theirs counts as often as chance would end it there.
vec3 light_emission(Hit hit, vec3 direction, bool stopped) {
  if (hit.instance == kNoIndex) return frame.sky_beyond != 0u ? sky_radiance(direction) : vec3(0.0);
  GpuMaterial m = material_of(hit.instance, hit.triangle);
  if (shows_sky(m, hit.instance)) return sky_radiance(direction) * m.emission.rgb;
  float seen = FEATURE_WATER && stopped && (m.flags & kMaterialDielectric) != 0u ? m.opaque_share : 1.0;
  seen *= emission_share(hit.instance, m, direction, hit.t);
  return seen * shade_point(m, hit.instance, hit_uv(instance_at(hit.instance).first_attribute + hit.triangle, hit.bary),
                            kNearest)
                    .emission;
}

// The emission that a direction meets is shared by the balance heuristic (Veach and Guibas 1995): light_candidates()
// samples of the list or, inside of a sun's disc, one of the suns; and one of whatever the path's own directions come
// from. Turns: how often each of the two is tried. Where one ray does for both it mostly looks for light; at a point
// that glows, as a flame's, light is all about, which scattered rays meet and few points of the list are near enough
// for.
const float kLooks = 0.75, kLooksWithinLight = 0.25;

struct Turns {
  float looking, scattering;
};
const Turns kBoth = Turns(1.0, 1.0);
Turns turns_of_one(Vertex v) {
  float looking = v.glows ? kLooksWithinLight : kLooks;
  return Turns(looking, 1.0 - looking);
}

float density_of_all(float looked_for, float proposed, Turns turns) {
  return turns.looking * looked_for + turns.scattering * proposed;
}

uint cell_of(Vertex v) { return seen_cell(v.position, scatter_axis(v.scatter)); }

// A flame's own light is all about its points: scattered rays have next to no variance there, and a point of the list
// has that of the balance, up to half of the square of what comes (Veach and Guibas 1995). So points that glow look for
// no light that is as near as the other side of a torch's flame, in units.
const float kWithinLight = 24.0;
bool is_within_light(Vertex v, float distance) { return v.glows && distance < kWithinLight; }

// Of light that is looked for, where a way from the vertex in a direction ends, of the ways with its turns that
// directions find.
float looked_for_density(Vertex v, vec3 direction, Segment way) {
  if (has_feature(kFeatureSuns) && is_sky(way.hit) && sun_pdf(way.direction) > 0.0) {
    if (bends_suns(v)) return refracted_density(v, direction);
    if (!way.bent) return sun_pdf(direction);
    return mirrors_suns(v) && way.mirrored > 0.0 ? mirrored_density(direction) / way.mirrored : 0.0;
  }
  return way.bent || is_within_light(v, way.hit.t) ? 0.0 : hit_light_pdf(cell_of(v), way.hit, direction);
}

// The share of emission that was met by a direction of the path's own.
float met_share_of(Vertex v, Segment way, Proposal p, vec3 emission, Turns turns) {
  if (emission == vec3(0.0) || (p.flags & kScatterDelta) != 0u) return 1.0 / turns.scattering;
  float all = density_of_all(looked_for_density(v, p.direction, way), p.pdf, turns);
  return all > 0.0 ? p.pdf / all : 1.0;
}

// For this share of the rays what is known chooses the kind of light, for the others each kind has half: neither has
// less than a tenth of the rays. A cell that is new has half and half, too: a sun outshines all lights, also where
// walls hide it.
const float kLearnt = 0.8;
const float kEnoughRays = 8.0;  // a cell that sent fewer is new

// In the place of an aim, now and then, at a sun that level liquids mirror: by what it would bring times the share of
// such rays that arrived, against `hoped` of all others. Cells of their own remember these rays.
const float kMostMirrored = 0.5, kLeastMirrored = 0.02;  // of the rays
const float kMirroredCell = 4096.0;                      // of the grid, off the others' place

void aim_at_mirrored_sun(Vertex v, float hoped, inout Aim aim, inout uint rng) {
  float radiance, bsdf;
  vec3 direction = sample_mirrored_sun(rng, radiance);
  vec3 f = scatter_eval(v.scatter, v.view, direction, bsdf);
  float density = mirrored_density(direction);
  float value = density > 0.0 ? dot(f, vec3(1.0)) * radiance / density : 0.0;
  if (!(value > 0.0)) return;
  uint cell = seen_cell(v.position + vec3(0.0, 0.0, kMirroredCell), scatter_axis(v.scatter)),
       seen = seen_cells.at[cell].x;
  float known = min(seen_rays(seen) / kEnoughRays, 1.0), arrive = mix(1.0, seen_share(seen), known);
  float reached = arrive * value, chance = clamp(reached / max(reached + hoped, 1e-30), kLeastMirrored, kMostMirrored);
  if (rng_uniform(rng) < chance)
    aim = Aim(direction, f, 1.0 / chance, kRayEnd, density, bsdf, kNoIndex, kNoIndex, kTurnBack, cell, 0u, 0u);
  else
    aim.weight /= 1.0 - chance;
}

// One of light_candidates() points of lights and a direction to a sun, chosen by what each would bring (resampled
// importance sampling, Talbot 2005) if each light were even and if as many rays to its kind arrived as did before from
// hereabouts. Emission, with its textures, is read of what is met.
Aim aim_at_light(Vertex v, Turns turns, inout uint rng) {
  Aim aim = kNoAim;
  vec3 origin = scatter_origin(v.scatter, v.position);
  aim.cell = cell_of(v);
  uint here = seen_place(origin, 0u);
  uvec4 seen = seen_cells.at[aim.cell];
  float sum = 0.0, target = 0.0, hoped = 0.0;
  uint listed = has_lights() ? light_candidates() : 0u, i = 0u;
  Candidates candidates = candidates_of(aim.cell);
  if (listed > 0u) do {
      GpuLight light;
      bool there = draw_candidate(candidates, i, rng, light);
      vec2 at = sample_triangle(rng);
      float pick = rng_uniform(rng);
      GpuTriangle t = world_triangle(light.instance, light.triangle);
      vec3 way = t.v0.xyz + t.e1.xyz * at.x + t.e2.xyz * at.y - origin;
      float reach = length(way);
      vec3 direction = way / max(reach, 1e-20);
      float bsdf, density = draws_of(candidates, light) * triangle_pdf(t, reach, direction);
      vec3 f = scatter_eval(v.scatter, v.view, direction, bsdf);
      float area = 0.5 * length(cross(t.e1.xyz, t.e2.xyz));
      float all = density_of_all(density, bsdf, turns);
      float value = there && density > 0.0 && !is_within_light(v, reach)
                        ? dot(f, vec3(1.0)) * frame.light_power * light_probability(light) / (area * all)
                        : 0.0;
      if (FEATURE_MEDIUM) value *= transmittance(frame.medium.w, reach);
      uint to = seen_way(here, origin + way);
      value *= hope_of(candidates, light, to);
      sum += value;
      if (pick * sum < value) {
        target = value;
        aim = Aim(direction, f, 1.0, reach * 1.001 + 0.01, density, bsdf, light.instance, light.triangle, kTurnNowhere,
                  aim.cell, light.lamp & 0xffffu, to);
      }
    } while (++i < listed);
  if (has_feature(kFeatureSuns) && frame.sun_count > 0u) {
    float radiance, bsdf;
    bool bends = bends_suns(v);
    vec3 direction = sample_sun(v, bends, rng, radiance);
    vec3 f = scatter_eval(v.scatter, v.view, direction, bsdf);
    // Zero on a rim that rounding left out: directions of the BSDF miss it as well.
    float sun = bends ? refracted_density(v, direction) : sun_pdf(direction);
    float all = density_of_all(sun, bsdf, turns);
    float value = sun > 0.0 ? dot(f, vec3(1.0)) * radiance / all : 0.0;
    float even = 1e-6 * (value + sum) + 1e-20;  // where neither was ever reached
    float reached = seen_share(seen.x) * value + even, both = reached + seen_share(seen.y) * sum + even;
    float known = min(seen_rays(seen.x) + seen_rays(seen.y), kEnoughRays) / kEnoughRays;
    float chance = mix(0.5, reached / both, kLearnt * known);
    chance = value > 0.0 ? sum > 0.0 ? chance : 1.0 : 0.0;
    bool to_sun = rng_uniform(rng) < chance;
    if (to_sun) {
      sum = target = value;
      aim = Aim(direction, f, 1.0, kRayEnd, sun, bsdf, kNoIndex, kNoIndex, bends ? kTurnByChance : kTurnNowhere,
                aim.cell, 0u, 0u);
    }
    aim.weight /= to_sun ? chance : 1.0 - chance;
    hoped = both;
  }
  aim.weight *= target > 0.0 ? sum / target : 0.0;
  if (mirrors_suns(v)) aim_at_mirrored_sun(v, hoped, aim, rng);
  return aim;
}

// What chose a direction shares it with the BSDF, which is cheap to ask; what it brings, with all that paths propose
// there, as often as they take the way's turns.
float shared_weight(Aim aim, Segment way, float proposed, Turns turns) {
  if (aim.weight <= 0.0) return 0.0;
  return aim.weight / density_of_all(aim.density, aim.turn == kTurnBack ? proposed * way.mirrored : proposed, turns);
}

// Whether a way met what it was to look for. A point of the list inside of a sun's disc is the sun's.
bool is_found(Aim aim, Segment way) {
  bool sun = aim.instance == kNoIndex;
  if (!sun && (way.hit.instance != aim.instance || way.hit.triangle != aim.triangle)) return false;
  if (!has_feature(kFeatureSuns)) return true;
  bool in_sun = is_sky(way.hit) && sun_pdf(way.direction) > 0.0;
  return sun == in_sun && (aim.turn != kTurnBack || way.mirrored > 0.0);
}

// Whether it did, remembered.
bool found(Aim aim, Segment way, inout uint rng) {
  bool met = is_found(aim, way);
  if (aim.weight > 0.0 && aim.instance != kNoIndex) count_way(aim.way, met);
  if (aim.weight > 0.0 && (rng_next(rng) & (light_seen_stride() - 1u)) == 0u)
    atomicAdd(seen_words.at[aim.cell * 4u + (aim.instance == kNoIndex ? 2u : 3u)], kSeenRay + (met ? kSeenMet : 0u));
  return met;
}

Direct direct_light(Vertex v, vec3 direction, vec3 f, vec3 light) {
  return Direct(f * light, light * (max(scatter_cosine(v.scatter, direction), 0.0) / kPiShared));
}

// What a ray found.
struct FoundLight {
  Direct direct;
  Segment way;   // from there
  float weight;  // one over the density of all that finds light in this direction; 0: none was found
};

// Light that an aim's ray finds, shared with paths' own directions, which have the density `proposed` there.
FoundLight find_by_aim(Vertex v, Aim aim, float proposed, inout uint rng) {
  FoundLight f;
  f.way = segment_from(v, aim.direction, aim.weight > 0.0 ? aim.reach : 0.0, aim.turn, rng);
  f.weight = found(aim, f.way, rng) ? shared_weight(aim, f.way, proposed, kBoth) : 0.0;
  vec3 emission =
      f.weight > 0.0 ? light_emission(f.way.hit, f.way.direction, aim.turn == kTurnNowhere) * f.way.left : vec3(0.0);
  remember_lamp(aim.cell, aim.lamp, dot(aim.f * emission, vec3(f.weight)), rng);
  f.direct = direct_light(v, aim.direction, aim.f, emission * f.weight);
  return f;
}
Direct light_of_aim(Vertex v, Aim aim, float proposed, inout uint rng) {
  return find_by_aim(v, aim, proposed, rng).direct;
}

// By one ray, which looks for light or scatters by the vertex's own density, in turns.
FoundLight find_in_turns(Vertex v, inout uint rng) {
  Proposal p = propose_scattered(v, rng);
  Turns turns = turns_of_one(v);
  Aim aim = aim_at_light(v, turns, rng);
  bool looks = rng_uniform(rng) < turns.looking;
  vec3 direction = looks ? aim.direction : p.direction;
  float reach = looks ? aim.weight > 0.0 ? aim.reach : 0.0 : p.weight != vec3(0.0) ? kRayEnd : 0.0;
  Segment way = segment_from(v, direction, reach, looks ? aim.turn : kTurnByChance, rng);
  bool stopped = looks && aim.turn == kTurnNowhere;
  vec3 emission = reach > 0.0 ? light_emission(way.hit, way.direction, stopped) * way.left : vec3(0.0);
  if (looks) {
    float weight = found(aim, way, rng) ? shared_weight(aim, way, aim.bsdf_pdf, turns) : 0.0;
    remember_lamp(aim.cell, aim.lamp, dot(aim.f * emission, vec3(weight)), rng);
    return FoundLight(direct_light(v, direction, aim.f, emission * weight), way, weight);
  }
  float share = met_share_of(v, way, p, emission, turns);
  vec3 light = emission * share;
  Direct direct = direct_light(v, direction, p.weight * p.pdf, p.pdf > 0.0 ? light / p.pdf : vec3(0.0));
  return FoundLight(direct, way, p.pdf > 0.0 ? share / p.pdf : 0.0);
}
Direct light_in_turns(Vertex v, inout uint rng) { return find_in_turns(v, rng).direct; }
#endif
