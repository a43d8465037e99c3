// Step `direct` by a list of lights and suns. Sampling of what glows: triangles from the list of lights (power-proportional, uniform over a triangle), suns by their
// discs. All densities are per solid angle as seen from the origin of the ray.
#ifndef FB_LIB_STEPS_DIRECT_LIST
#define FB_LIB_STEPS_DIRECT_LIST
#include "lib/path_state.glsl"

const bool kLooksForLight = true;

// Light samples that a vertex draws to choose one of (r_nee_candidates). The technique defines it, from its constants.
uint light_candidates();

bool has_lights() { return frame.light_first < frame.light_end; }

// An element of the list, by the alias table.
uint sample_light(inout uint rng) {
  uint place, unused;
  umulExtended(rng_next(rng), frame.light_end - frame.light_first, place, unused);
  uvec2 alias = light_at(frame.light_end + place);
  return frame.light_first + ((rng_next(rng) & (kLightRange - 1u)) < alias.x ? place : alias.y);
}

float light_probability(uint element) { return float(light_at(element).x) / float(kLightRange); }

// Density with which the list finds a point of a triangle of the world at `distance`; 0: it is not in the list.
float light_pdf(uint element, GpuTriangle t, float distance, vec3 direction) {
  vec3 area = 0.5 * cross(t.e1.xyz, t.e2.xyz);
  float facing = abs(dot(area, direction));  // area times cosine
  return facing > 0.0 ? light_probability(element) * distance * distance / facing : 0.0;
}

float hit_light_pdf(Hit hit, vec3 direction) {
  if (!has_lights() || hit.instance == kNoIndex || light_at(hit.instance).x == kNoIndex) return 0.0;
  return light_pdf(light_at(hit.instance).x + hit.triangle, world_triangle(hit.instance, hit.triangle), hit.t, direction);
}

bool shows_sky(GpuMaterial m, uint instance) {
  return m.emission_kind == kEmissionSky && (instance_at(instance).flags & kInstanceHasColor) == 0u;
}
GpuMaterial material_of(uint instance, uint triangle) {
  uint record = instance_at(instance).first_attribute + triangle;
  return material_at(instance_at(instance).material_base + attribute_at(record).material);
}
bool is_sky(Hit hit) {
  if (hit.instance == kNoIndex) return frame.sky_beyond != 0u;
  return shows_sky(material_of(hit.instance, hit.triangle), hit.instance);
}

// One sun of all, each as often; 1 - cos of a small disc is exact.
float sun_pdf(vec3 direction) {
  float p = 0.0;
  for (uint i = 0u; i < frame.sun_count; ++i) {
    vec4 sun = frame.sun_direction[i];
    if (dot(direction, sun.xyz) >= sun.w) p += 1.0 / (2.0 * kPiShared * (1.0 - sun.w));
  }
  return p / float(max(frame.sun_count, 1u));
}

vec3 sample_sun(inout uint rng) {
  vec4 sun = frame.sun_direction[rng_next(rng) % frame.sun_count];
  float k = rng_uniform(rng) * (1.0 - sun.w), phi = 2.0 * kPiShared * rng_uniform(rng);  // k: 1 - cos
  float r = sqrt(k * (2.0 - k));
  return frame_about(sun.xyz) * vec3(r * cos(phi), r * sin(phi), 1.0 - k);
}

// Emission towards `direction`'s origin of a point of the scene, as load_surface has it.
vec3 light_emission(uint instance, uint triangle, vec2 bary, vec3 direction, out bool sky) {
  GpuMaterial m = material_of(instance, triangle);
  sky = shows_sky(m, instance);
  if (sky) return sky_radiance(direction) * m.emission.rgb;
  return shade_point(m, instance, hit_uv(instance_at(instance).first_attribute + triangle, bary), kNearest).emission;
}

// The emission that a direction meets is shared by the balance heuristic (Veach and Guibas 1995): light_candidates()
// samples of the list, one of the suns, one of the BSDF. It stands for whatever else samples directions, too: shares need
// only add up to one.
float density_of_all(float list, float sun, float bsdf) { return float(light_candidates()) * list + sun + bsdf; }

// The share of emission that was met by a direction of the path's own.
float met_share(Vertex v, Hit hit, Proposal p, vec3 emission) {
  if (emission == vec3(0.0) || (p.flags & kScatterDelta) != 0u) return 1.0;
  float bsdf;
  scatter_eval(v.scatter, v.view, p.direction, bsdf);
  float all = density_of_all(hit_light_pdf(hit, p.direction), is_sky(hit) ? sun_pdf(p.direction) : 0.0, bsdf);
  return all > 0.0 ? bsdf / all : 1.0;
}

// A direction to look for light in.
struct Aim {
  vec3 direction;
  vec3 f;        // f cos; zero: nothing to look for
  float weight;  // f cos times this is the factor on the emission that is met
  float reach;
  uint instance, triangle;  // what must be met
  vec3 emission;            // of it
};
const Aim kNoAim = Aim(vec3(0.0), vec3(0.0), 0.0, 0.0, kNoIndex, kNoIndex, vec3(0.0));

// One of light_candidates() points of lights, chosen by what each would bring if nothing stood between (resampled
// importance sampling, Talbot 2005) and if each gave its light evenly: a candidate's density over areas is its mean emission
// then, but for a factor. So emission, with its textures, is read of the chosen one alone.
Aim aim_at_light(Vertex v, inout uint rng) {
  Aim aim = kNoAim;
  vec3 origin = scatter_origin(v.scatter, v.position);
  float sum = 0.0, target = 0.0, list = 0.0, scattered = 0.0;
  vec2 bary = vec2(0.0);
  for (uint i = 0u; i < light_candidates(); ++i) {
    uint element = sample_light(rng);
    float root = sqrt(rng_uniform(rng)), along = rng_uniform(rng), pick = rng_uniform(rng);
    vec2 at = vec2(root * (1.0 - along), root * along);
    uint instance = light_at(element).y, triangle = element - light_at(instance).x;
    GpuTriangle t = world_triangle(instance, triangle);
    vec3 way = t.v0.xyz + t.e1.xyz * at.x + t.e2.xyz * at.y - origin;
    float reach = length(way);
    vec3 direction = way / max(reach, 1e-20);
    float bsdf, density = light_pdf(element, t, reach, direction);
    vec3 f = scatter_eval(v.scatter, v.view, direction, bsdf);
    if (f == vec3(0.0) || !(density > 0.0)) continue;
    float area = 0.5 * length(cross(t.e1.xyz, t.e2.xyz));
    float value = dot(f, vec3(1.0)) * light_probability(element) / (area * density_of_all(density, 0.0, bsdf));
    if (!(value > 0.0)) continue;
    sum += value;
    if (pick * sum < value) {
      target = value;
      list = density;
      scattered = bsdf;
      bary = at;
      aim = Aim(direction, f, 0.0, reach, instance, triangle, vec3(0.0));
    }
  }
  if (!(target > 0.0)) return kNoAim;
  bool sky;
  aim.emission = light_emission(aim.instance, aim.triangle, bary, aim.direction, sky);
  aim.weight = sum / (target * density_of_all(list, sky ? sun_pdf(aim.direction) : 0.0, scattered));
  if (aim.emission == vec3(0.0)) aim.f = vec3(0.0);
  return aim;
}

// Its weight and emission are left to what is met.
Aim aim_at_sun(Vertex v, inout uint rng, out float bsdf) {
  Aim aim = kNoAim;
  aim.direction = sample_sun(rng);
  aim.reach = kRayEnd;
  aim.f = scatter_eval(v.scatter, v.view, aim.direction, bsdf);
  return aim;
}

const uint kToLight = 0u, kToSun = 1u;

// From a light of the list and from a sun: a ray to each, since one for both, chosen by what each would bring unoccluded, goes
// to a sun behind walls again and again. Without suns their ray is not compiled: lavapipe skips nothing.
Direct look_for_light(Vertex v, inout uint rng) {
  Direct direct = Direct(vec3(0.0), vec3(0.0));
  uint ways = has_feature(kFeatureSuns) ? 2u : 1u;
  for (uint way = 0u; way < ways; ++way) {
    if (way == kToLight ? !has_lights() : frame.sun_count == 0u) continue;
    Aim aim;
    float bsdf = 0.0;
    if (way == kToLight) aim = aim_at_light(v, rng);
    else aim = aim_at_sun(v, rng, bsdf);
    if (aim.f == vec3(0.0)) continue;
    Hit hit = trace_from(v, aim.direction, aim.reach * 1.001 + 0.01, rng);
    if (way == kToLight) {
      if (hit.instance != aim.instance || hit.triangle != aim.triangle) continue;
    } else {
      float sun = sun_pdf(aim.direction);  // zero on a rim that rounding left out: directions of the BSDF miss it as well
      if (!is_sky(hit) || sun == 0.0) continue;
      aim.weight = 1.0 / density_of_all(hit_light_pdf(hit, aim.direction), sun, bsdf);
      aim.emission = sky_radiance(aim.direction) * (hit.instance != kNoIndex ? material_of(hit.instance, hit.triangle).emission.rgb : vec3(1.0));
    }
    vec3 light = aim.emission * aim.weight;
    direct.radiance += aim.f * light;
    direct.irradiance += light * (max(scatter_cosine(v.scatter, aim.direction), 0.0) / kPiShared);
  }
  return direct;
}
#endif
