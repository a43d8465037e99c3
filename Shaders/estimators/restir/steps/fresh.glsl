// What paths find of light of two reflections, as a sample for the indirect reservoir of their pixel. Reservoirs have
// all light that falls straight on a second vertex, from a lamp of the list or from within a sun's disc, where the way
// there is straight and where neither passes or ends at what is translucent, which is there by chance; all else stays
// the path's.
#ifndef FB_RESTIR_FRESH
#define FB_RESTIR_FRESH
#include "estimators/restir/steps/indirect_sample.glsl"

void empty_fresh(uint element) {
  if (!kReusesIndirect) return;
  fresh.at[2u * element] = uvec4(kNoIndex, 0u, 0u, 0u);
  fresh.at[2u * element + 1u] = uvec4(0u);
}

// Interfaces of water and glass are left out: a ray that asks whether one is in sight ends there always, a path's by
// chance.
bool ends_by_chance(Hit hit) {
  bool bends = FEATURE_WATER && (material_of(hit.instance, hit.triangle).flags & kMaterialDielectric) != 0u;
  return bends || (FEATURE_CANDIDATES && !is_opaque(hit));
}

// A path's first way.
void open_second(inout Path path, Segment way, Proposal p) {
  bool straight =
      way.hit.instance != kNoIndex && !way.bent && way.certain && p.pdf > 0.0 && (p.flags & kScatterDelta) == 0u;
  path.own.reused.open = straight && !ends_by_chance(way.hit);
  path.own.reused.second = way.hit;
  if (!path.own.reused.open) return;
  path.own.reused.seen =
      triangle_pdf(world_triangle(way.hit.instance, way.hit.triangle), way.hit.t, p.direction) / p.pdf;
  path.own.reused.through = p.weight * way.left;
}

// The sample where a way from a second vertex ends, and the density of samples there per solid angle; its name is 0:
// reservoirs do not have it.
LightSample sample_met(Segment way, inout uint rng, out float seen) {
  seen = 0.0;
  if (has_feature(kFeatureSuns) && is_sky(way.hit)) {
    seen = frame.sun_count > 0u ? float(frame.sun_count) * sun_pdf(way.direction) : 0.0;
    if (seen > 0.0) {
      // Where discs lie upon each other it may be of each.
      float left = rng_uniform(rng) * seen;
      uint number = 0u, i = 0u;
      do {
        vec4 sun = frame.sun_direction[i];
        bool within = within_sun(way.direction, sun.xyz, sun.w);
        if (within && left >= 0.0) number = i;
        left -= within ? 1.0 / sun_solid_angle(sun.w) : 0.0;
      } while (++i < frame.sun_count);
      return LightSample(kKindSun | number, packed_place(place_in_disc(frame.sun_direction[number], way.direction)));
    }
  }
  if (!has_lights() || way.hit.instance == kNoIndex || ends_by_chance(way.hit)) return kNoSample;
  uint first = first_light_of(way.hit.instance);
  if (first == kNoIndex) return kNoSample;
  GpuLight light = light_at(first + way.hit.triangle);
  if (light.probability == 0u) return kNoSample;
  seen = triangle_pdf(world_triangle(way.hit.instance, way.hit.triangle), way.hit.t, way.direction);
  return sample_of(light, packed_place(unit_of_triangle(way.hit.bary)));
}

// The same of a way from a vertex, if reservoirs of light may have it.
LightSample reusable_sample(Vertex v, Segment way, inout uint rng, out float seen) {
  seen = 0.0;
  if (way.bent || !way.certain) return kNoSample;
  LightSample s = sample_met(way, rng, seen);
  bool sun = (s.name & kKindBits) == kKindSun;
  if (!(seen > 0.0) || (!sun && is_within_light(v, way.hit.t))) return kNoSample;
  return s;
}

// Light that was found from a path's second vertex, which reflects `radiance` of it, by a way with one over this
// density. True: the reservoir has it. Of what several paths, or both ways to look, bring, one is kept, by what it
// brings.
bool hand_over(inout Path path, Segment way, float weight, vec3 radiance, inout uint rng) {
  if (!path.own.reused.open || path.depth != 1u || way.bent || !way.certain || radiance == vec3(0.0)) return false;
  float seen;
  LightSample light = sample_met(way, rng, seen);
  if (light.name == 0u) return false;
  float brought = reservoir_number(dot(path.own.reused.through * radiance, vec3(1.0)));
  float w = reservoir_number(path.own.reused.seen * (keeps_radiance() ? 1.0 : seen * weight));
  if (!(brought > 0.0) || !(w > 0.0)) return true;
  uint element = 2u * lit_index(path.pixel);
  float sum = uintBitsToFloat(fresh.at[element + 1u].z) + brought;
  if (rng_uniform(rng) * sum < brought) {
    uvec2 bary = pack_bary(path.own.reused.second.bary, radiance);
    fresh.at[element] = uvec4(path.own.reused.second.instance, path.own.reused.second.triangle, bary.x, light.name);
    fresh.at[element + 1u].xyw = uvec3(light.place, floatBitsToUint(reservoir_number(w / brought)), bary.y);
  }
  fresh.at[element + 1u].z = floatBitsToUint(sum);
  return true;
}

// One sample of a pixel's paths.
IndirectReservoir fresh_reservoir(uint element) {
  uvec4 a = fresh.at[2u * element], b = fresh.at[2u * element + 1u];
  float weight = reservoir_number(uintBitsToFloat(b.y) * uintBitsToFloat(b.z) / float(frame.spp));
  return IndirectReservoir(IndirectSample(a.x, a.y, uvec2(a.z, b.w), LightSample(a.w, b.x)), weight, 1.0, 0.0);
}
#endif
