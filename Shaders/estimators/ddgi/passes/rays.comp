// Rays of the probes that have a turn. A probe is a point from which light is asked all around, as a point of a medium
// that scatters evenly. Eq. 4: what is met sends light that is looked for from there, and what probes know. Eq. 5: it
// sends what it emits and what probes know, and some rays look for lights, since lamps are small; which of both finds a
// lamp the balance heuristic shares.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#define PATHS_BEGIN_IN_MEDIUM 1
#include "lib/steps/one_path.glsl"
#include "estimators/ddgi/steps/surface_light.glsl"
#include "lib/look_for_light.glsl"

layout(constant_id = kSpecDdgiPlus) const bool PLUS = false;
layout(local_size_x = 64) in;

const float kEven = 1.0 / (4.0 * kPiShared);

// The other side of a surface shows where nobody stands: the ray is in a wall.
bool is_back(Segment way) {
  if (way.hit.instance == kNoIndex) return false;
  GpuMaterial m = material_of(way.hit.instance, way.hit.triangle);
  if ((m.flags & (kMaterialLiquid | kMaterialDielectric | kMaterialAlphaTest)) != 0u) return false;
  GpuTriangle t = world_triangle(way.hit.instance, way.hit.triangle);
  return dot(cross(t.e1.xyz, t.e2.xyz), way.direction) > 0.0;
}

// Light of a lamp fades on the further way to the surfaces behind a probe (Section 3.3), as far as its cell reaches.
float further_fade(uint probe, vec3 direction, Segment way, bool sky) {
  if (sky || ddgi.ddgi_attenuation == 0.0) return 1.0;
  vec3 reach = 0.5 * ddgi.spacing.xyz / max(abs(direction), vec3(1e-6));
  float behind = min(depth_of_probe(probe, -direction).x, min(reach.x, min(reach.y, reach.z)));
  return ddgi_attenuation(way.distance, ddgi.ddgi_attenuation * behind);
}

vec3 reflected_light(Segment way, inout uint rng) {
  Surface s = load_surface(way.hit, way.direction, kFilterNearest, false, false);
  Vertex v = end_of_segment(way, s);
  SurfaceLight known = light_of_surface(v, way.hit.t, PLUS && ddgi.ddgi_view_bias != 0, PLUS, true, false, 0.0, rng);
  vec3 light = known.diffuse + known.glossy;
  if (PLUS) return light * way.left;
  v.scatter.bsdf =
      Bsdf(diffuse_reflectance(v.scatter.bsdf, max(dot(v.view, v.scatter.shading_normal), 0.0)), 1.0, 0.0, 0.0);
  return (light + light_in_turns(v, rng).radiance) * way.left;
}

void main() {
  uint turn = gl_GlobalInvocationID.x / ddgi.rays, i = gl_GlobalInvocationID.x % ddgi.rays;
  if (turn >= ddgi.turns) return;
  uint probe = ddgi_turns.at[turn];
  uint rng = rng_seed(probe, frame.frame, i, frame.seed ^ 0x5851f42du);
  uint shared_rng = rng_seed(probe, frame.frame, 0xffffu, frame.seed ^ 0x5851f42du);
  vec3 u = vec3(rng_uniform(shared_rng), rng_uniform(shared_rng), rng_uniform(shared_rng));
  uint looking = PLUS ? ddgi.looking : 0u;
  bool looks = i < looking;
  float looking_share = float(looking) / float(ddgi.rays);
  Turns turns = Turns(looking_share, 1.0 - looking_share);
  vec3 place = place_of_probe(probe);
  Vertex v = Vertex(place, place, vec3(0.0, 0.0, 1.0),
                    Scatter(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0), Bsdf(vec3(0.0), 1.0, 0.0, 0.0), true, kNoPhase),
                    kNoIndex, false);

  Aim aim = kNoAim;
  vec3 direction = ddgi_turned(ddgi_sphere_point(looks ? 0u : i - looking, ddgi.rays - looking), u);
  float reach = kRayEnd;
  if (PLUS && looking > 0u) aim = aim_at_light(v, turns, rng);
  if (looks) {
    direction = aim.direction;
    reach = aim.weight > 0.0 ? aim.reach : 0.0;
  }
  Segment way = segment_of(place, kNoIndex, direction, reach, looks ? aim.turn : kTurnByChance, rng);
  bool missed = way.hit.instance == kNoIndex, back = !looks && is_back(way);
  vec3 light = vec3(0.0);
  if (PLUS) {
    Surface s;
    vec3 emission = light_emission(way.hit, way.direction, looks && aim.turn == kTurnNowhere) * way.left;
    float weight = 0.0;
    if (looks) {
      weight = found(aim, way, rng) ? shared_weight(aim, way, kEven, turns) : 0.0;
      remember_lamp(aim.cell, aim.lamp, dot(emission, vec3(weight * kEven)), rng);
    } else if (!back) {
      weight = looking > 0u && emission != vec3(0.0)
                   ? 1.0 / density_of_all(looked_for_density(v, direction, way), kEven, turns)
                   : 1.0 / (turns.scattering * kEven);
    }
    bool sky = missed || is_sky(way.hit);
    light = weight > 0.0 ? emission * (weight * further_fade(probe, direction, way, sky)) : vec3(0.0);
  }
  vec3 sent = vec3(0.0);  // of it what is reflected
  if (!looks && !missed && !back) sent = reflected_light(way, rng) / (turns.scattering * kEven);
  light += sent;
  if (any(isnan(light)) || any(isinf(light))) {
    atomicAdd(counters.at[kCounterNan], 1u);
    light = sent = vec3(0.0);
  }
  float distance = missed ? ddgi.origin.w : clamp(way.distance, 1e-3, ddgi.origin.w);
  ddgi_rays.at[2u * gl_GlobalInvocationID.x] = floatBitsToUint(vec4(direction, back ? -distance : distance));
  ddgi_rays.at[2u * gl_GlobalInvocationID.x + 1u] = uvec4(floatBitsToUint(light), pack_rgb9e5(sent, 0.5));
}
