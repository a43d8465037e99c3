// Sampling of what glows: triangles from the list of lights (power-proportional, uniform over a triangle), suns by their
// discs. All densities are per solid angle as seen from the origin of the ray.
#ifndef FB_LIB_LIGHTS
#define FB_LIB_LIGHTS
#include "lib/path_vertex.glsl"

layout(set = 0, binding = 13, std430) readonly buffer LightBlock { uvec2 lights[]; };

bool has_lights() { return frame.light_first < frame.light_end; }

// The first element whose interval ends above u.
uint light_at(uint u) {
  uint low = frame.light_first, high = frame.light_end - 1u;
  while (low < high) {
    uint middle = (low + high) >> 1u;
    if (lights[middle].x > u) high = middle;
    else low = middle + 1u;
  }
  return low;
}

float light_probability(uint element) {
  uint begin = element == frame.light_first ? 0u : lights[element - 1u].x;
  return float(lights[element].x - begin) / float(kLightRange);
}

// Density with which the list finds a point of a triangle at `distance`; 0: it is not in the list. `t`: in the mesh's space.
float light_pdf(uint element, uint instance, GpuTriangle t, float distance, vec3 direction) {
  vec3 area = 0.5 * cross(to_world_vector(instance, t.e1.xyz), to_world_vector(instance, t.e2.xyz));
  float facing = abs(dot(area, direction));  // area times cosine
  return facing > 0.0 ? light_probability(element) * distance * distance / facing : 0.0;
}

float hit_light_pdf(Hit hit, vec3 direction) {
  if (!has_lights() || hit.instance == kNoIndex || lights[hit.instance].x == kNoIndex) return 0.0;
  GpuTriangle t = triangles[instances[hit.instance].first_triangle + hit.triangle];
  return light_pdf(lights[hit.instance].x + hit.triangle, hit.instance, t, hit.t, direction);
}

bool is_sky(Hit hit) {
  if (hit.instance == kNoIndex) return frame.sky_beyond != 0u;
  uint record = instances[hit.instance].first_attribute + hit.triangle;
  uint material = instances[hit.instance].material_base + attributes[record].material;
  return materials[material].emission_kind == kEmissionSky && (instances[hit.instance].flags & kInstanceHasColor) == 0u;
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
  uint record = instances[instance].first_attribute + triangle;
  GpuMaterial m = materials[instances[instance].material_base + attributes[record].material];
  sky = m.emission_kind == kEmissionSky && (instances[instance].flags & kInstanceHasColor) == 0u;
  if (sky) return sky_radiance(direction) * m.emission.rgb;
  return shade_point(m, instance, hit_uv(record, bary), false).emission;
}

// A direction to look for light in.
struct Aim {
  vec3 direction;
  vec3 weight;  // factor on the emission that is met; zero: nothing to look for
  float reach;
  uint instance, triangle;  // what must be met
};

// f cos and the density of sample_vertex_bsdf.
vec3 vertex_bsdf(PathVertex v, vec3 direction, out float pdf) {
  mat3 to_world = frame_about(v.shading_normal);
  vec3 wo = v.view * to_world, wi = direction * to_world;
  pdf = bsdf_pdf(v.bsdf, wo, wi);
  return dot(direction, v.normal) > 0.0 ? bsdf_eval(v.bsdf, wo, wi) : vec3(0.0);
}

// One of frame.light_candidates points of lights, chosen by what each would bring if nothing stood between (resampled
// importance sampling, Talbot 2005). Its part of the light is what the balance heuristic gives to that many samples of
// the list beside one of the BSDF and one of the suns (Veach and Guibas 1995).
Aim aim_at_light(PathVertex v, vec3 origin, inout uint rng) {
  Aim aim = Aim(vec3(0.0), vec3(0.0), 0.0, kNoIndex, kNoIndex);
  float candidates = float(frame.light_candidates), sum = 0.0, target = 0.0;
  for (uint i = 0u; i < frame.light_candidates; ++i) {
    uint element = light_at(rng_next(rng) & (kLightRange - 1u));
    float root = sqrt(rng_uniform(rng)), along = rng_uniform(rng), pick = rng_uniform(rng);
    vec2 bary = vec2(root * (1.0 - along), root * along);
    uint instance = lights[element].y, triangle = element - lights[instance].x;
    GpuTriangle t = triangles[instances[instance].first_triangle + triangle];
    vec3 way = to_world_point(instance, t.v0.xyz + t.e1.xyz * bary.x + t.e2.xyz * bary.y) - origin;
    float reach = length(way);
    vec3 direction = way / max(reach, 1e-20);
    float bsdf_density, density = light_pdf(element, instance, t, reach, direction);
    vec3 f = vertex_bsdf(v, direction, bsdf_density);
    if (f == vec3(0.0) || !(density > 0.0)) continue;
    bool sky;
    vec3 emission = light_emission(instance, triangle, bary, direction, sky);
    float others = bsdf_density + (sky ? sun_pdf(direction) : 0.0);
    vec3 weight = f * (candidates / (candidates * density + others));
    float value = dot(weight * emission, vec3(1.0));
    if (!(value > 0.0)) continue;
    sum += value;
    if (pick * sum < value) {
      target = value;
      aim = Aim(direction, weight, reach, instance, triangle);
    }
  }
  aim.weight *= target > 0.0 ? sum / (candidates * target) : 0.0;
  return aim;
}

// Its weight is yet to be divided by the sum of all densities there, `density` of which is known.
Aim aim_at_sun(PathVertex v, inout uint rng, out float density) {
  Aim aim = Aim(sample_sun(rng), vec3(0.0), kRayEnd, kNoIndex, kNoIndex);
  aim.weight = vertex_bsdf(v, aim.direction, density);
  float sun = sun_pdf(aim.direction);  // zero on a rim that rounding left out, and the BSDF's samples miss as well
  if (sun == 0.0) aim.weight = vec3(0.0);
  density += sun;
  return aim;
}
#endif
