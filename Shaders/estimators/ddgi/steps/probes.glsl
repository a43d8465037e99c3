// The block and the arrays of probes, and what eight of them say of the light at a point.
#ifndef FB_DDGI_PROBES
#define FB_DDGI_PROBES
#include "estimators/ddgi/ddgi.h"
#include "lib/frame_bindings.glsl"
#include "shared/bsdf.h"
#include "shared/denoise.h"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform DdgiBlock { DdgiConstants ddgi; };
FB_TECHNIQUE_ARRAY(kDdgiProbes, 16, , DdgiProbeArray, uvec4, ddgi_probes)
FB_TECHNIQUE_ARRAY(kDdgiLight, 4, , DdgiLightArray, uint, ddgi_light)
FB_TECHNIQUE_ARRAY(kDdgiDepth, 4, , DdgiDepthArray, uint, ddgi_depth)
FB_TECHNIQUE_ARRAY(kDdgiTurns, 4, , DdgiTurnArray, uint, ddgi_turns)
FB_TECHNIQUE_ARRAY(kDdgiRays, 16, , DdgiRayArray, uvec4, ddgi_rays)
FB_TECHNIQUE_ARRAY(kDdgiTable, 4, , DdgiTableArray, uint, ddgi_table)
layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kDdgiTable) uniform usamplerBuffer ddgi_table_texels;
layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kDdgiRays) uniform usamplerBuffer ddgi_ray_texels;

uint light_candidates() { return uint(ddgi.nee_candidates); }
uint remembered_candidates() { return uint(ddgi.nee_remembered); }
uint light_seen_stride() { return ddgi.seen_stride; }
bool knows_ways() { return ddgi.nee_visibility != 0; }
uint known_ways() { return ddgi.seen_ways; }

ivec3 ddgi_first() { return ivec3(ddgi.first_x, ddgi.first_y, ddgi.first_z); }
ivec3 ddgi_count() { return ivec3(ddgi.count_x, ddgi.count_y, ddgi.count_z); }
uint probe_of_cell(ivec3 cell) {
  ivec3 count = ddgi_count();
  ivec3 at = ivec3(ddgi_modulo(cell.x, count.x), ddgi_modulo(cell.y, count.y), ddgi_modulo(cell.z, count.z));
  return uint((at.z * count.y + at.y) * count.x + at.x);
}
ivec3 cell_of_probe(uint probe) {
  ivec3 count = ddgi_count(), first = ddgi_first();
  int row = int(probe) / count.x;
  ivec3 at = ivec3(int(probe) % count.x, row % count.y, row / count.y);
  return ivec3(ddgi_cell_of(at.x, first.x, count.x), ddgi_cell_of(at.y, first.y, count.y),
               ddgi_cell_of(at.z, first.z, count.z));
}
// In the grid, before it moved.
vec3 place_of_cell(ivec3 cell) { return ddgi.origin.xyz + (vec3(cell) + 0.5) * ddgi.spacing.xyz; }
vec3 place_of_probe(uint probe) {
  return place_of_cell(cell_of_probe(probe)) + uintBitsToFloat(ddgi_probes.at[2u * probe].xyz);
}

// --- Leafs of the map, and doors ---
bool stands_nowhere(uint probe) { return ddgi.stands != 0u && (ddgi_table.at[4u * probe + 3u] & kDdgiNowhere) != 0u; }
// The open leaf at a place within the volume; 0: it is not known, or in what is solid.
uint leaf_at(vec3 place) {
  if (ddgi.row_words == 0u) return 0u;
  ivec3 count = ddgi_count();
  ivec3 cube =
      clamp(ivec3(floor((place - ddgi.origin.xyz) / ddgi.spacing.xyz - vec3(ddgi_first()) + 0.5)), ivec3(0), count);
  uint at = uint((cube.z * (count.y + 1) + cube.y) * (count.x + 1) + cube.x);
  int node = int(ddgi_table.at[ddgi.table_starts + at]);
  uint steps = 0u;
  // All lanes take as many rounds, and who has arrived stays.
  do {
    bool there = node < 0;
    int element = int(ddgi.table_nodes) + 2 * max(node, 0);
    vec4 plane = uintBitsToFloat(texelFetch(ddgi_table_texels, element));
    uvec2 sides = texelFetch(ddgi_table_texels, element + 1).xy;
    node = there ? node : int(dot(plane.xyz, place) >= plane.w ? sides.x : sides.y);
  } while (++steps < ddgi.leaf_steps);
  return node < 0 ? uint(~node) : 0u;
}
bool may_ask(uint leaf, uint probe) {
  if (leaf == 0u) return true;
  uint word = ddgi_table.at[ddgi.table_rows + probe * ddgi.row_words + (leaf >> 5u)];
  return (word >> (leaf & 31u) & 1u) != 0u;
}
bool is_behind_door(uint door, vec3 from, vec3 to) {
  if (door == 0u) return false;
  int element = int(ddgi.table_doors + 2u * (door - 1u));
  return ddgi_is_shut(from, to, uintBitsToFloat(texelFetch(ddgi_table_texels, element).xyz),
                      uintBitsToFloat(texelFetch(ddgi_table_texels, element + 1).xyz));
}
bool is_shut_off(uint probe, vec3 from, vec3 to) {
  if (ddgi.doors == 0u) return false;
  uint doors = ddgi_table.at[4u * probe + 3u];
  return is_behind_door(doors & kDdgiDoor, from, to) || is_behind_door(doors >> 8u & kDdgiDoor, from, to);
}

bool is_known(uvec4 record) { return (record.x & kDdgiUpdates) != 0u && (record.x & kDdgiAsleep) == 0u; }

// Mean radiance about a direction, by the cosine.
vec3 light_of_probe(uint probe, vec3 direction) {
  DdgiTaps t = ddgi_taps(direction, kDdgiLightSide);
  uint first = probe * kDdgiLightTexels;
  return unpack_rgb9e5(ddgi_light.at[first + t.texel.x]) * t.weight.x +
         unpack_rgb9e5(ddgi_light.at[first + t.texel.y]) * t.weight.y +
         unpack_rgb9e5(ddgi_light.at[first + t.texel.z]) * t.weight.z +
         unpack_rgb9e5(ddgi_light.at[first + t.texel.w]) * t.weight.w;
}
// Mean distance about a direction and mean of its square, units.
vec2 depth_of_probe(uint probe, vec3 direction) {
  DdgiTaps t = ddgi_taps(direction, kDdgiDepthSide);
  uint first = probe * kDdgiDepthTexels;
  vec2 d = unpackUnorm2x16(ddgi_depth.at[first + t.texel.x]) * t.weight.x +
           unpackUnorm2x16(ddgi_depth.at[first + t.texel.y]) * t.weight.y +
           unpackUnorm2x16(ddgi_depth.at[first + t.texel.z]) * t.weight.z +
           unpackUnorm2x16(ddgi_depth.at[first + t.texel.w]) * t.weight.w;
  return d * vec2(ddgi.origin.w, ddgi.origin.w * ddgi.origin.w);
}

// What probes say of a point.
struct ProbeLight {
  bool known;
  vec3 about_normal;  // irradiance over pi
  vec3 about_other;   // the same about another direction: coarsely, the radiance from there
  uint drawn;         // one of the probes, by its weight; kDdgiNoProbe: none
};

// `point`: on a surface of this normal; `asked`: off it, where probes are asked whether they see it; `in_air`: off it,
// with no surface in between, which says its leaf. `other`: a direction, or zero: nothing is asked about it. `notes`:
// these probes are in sight. Not `asks`: nothing is known. `pick`, in [0, 1), draws one of the probes.
ProbeLight light_of_probes(vec3 point, vec3 asked, vec3 in_air, vec3 normal, vec3 other, bool asks, bool notes,
                           float pick) {
  ivec3 first = ddgi_first(), count = ddgi_count();
  vec3 at = (asked - ddgi.origin.xyz) / ddgi.spacing.xyz - vec3(first) - 0.5;
  bool within = asks && all(greaterThan(at, vec3(-1.0))) && all(lessThan(at, vec3(count)));
  ivec3 base = ivec3(floor(clamp(at, vec3(0.0), vec3(max(count - 2, ivec3(0))))));
  vec3 along = clamp(at - vec3(base), 0.0, 1.0);
  bool turned = dot(other, other) > 0.0;
  ProbeLight sum = ProbeLight(false, vec3(0.0), vec3(0.0), kDdgiNoProbe);
  float weights = 0.0;
  uint leaf = leaf_at(in_air);
  uint i = 0u, corners = within ? 8u : 0u;
  do {
    ivec3 corner = ivec3(i & 1u, (i >> 1u) & 1u, i >> 2u);
    ivec3 in_volume = min(base + corner, count - 1);
    uint probe = probe_of_cell(first + in_volume);
    uvec4 record = ddgi_probes.at[2u * probe + 1u];
    bool may = within && may_ask(leaf, probe);
    if (notes && may && record.z != ddgi.frame_number) ddgi_probes.at[2u * probe + 1u].z = ddgi.frame_number;
    vec3 place = place_of_cell(first + in_volume) + uintBitsToFloat(ddgi_probes.at[2u * probe].xyz);
    if (may && is_known(record) && !is_shut_off(probe, in_air, place)) {
      vec3 shares = mix(1.0 - along, along, vec3(corner));
      float weight = ddgi_facing(dot(normalize(place - point), normal));
      if (ddgi.ddgi_visibility != 0) {
        vec3 way = asked - place;
        float distance = length(way);
        vec2 depth = depth_of_probe(probe, way / max(distance, 1e-6));
        weight *= ddgi_visibility(distance, depth.x, depth.y);
      }
      weight = ddgi_crushed(max(weight, 1e-4)) * max(shares.x, 1e-3) * max(shares.y, 1e-3) * max(shares.z, 1e-3);
      sum.about_normal += light_of_probe(probe, normal) * weight;
      if (turned) sum.about_other += light_of_probe(probe, other) * weight;
      weights += weight;
      float share = weight / weights;
      bool takes = pick < share;
      pick = takes ? pick / share : (pick - share) / (1.0 - share);
      sum.drawn = takes ? probe : sum.drawn;
    }
  } while (++i < corners);
  sum.known = weights > kDdgiLeastKnown;
  float scale = sum.known ? 1.0 / weights : 0.0;
  sum.about_normal *= scale;
  sum.about_other *= scale * (ddgi.ddgi_form != 0 ? 0.5 : 1.0);
  return sum;
}

// Where probes are asked for a point that a ray of this length reached. Along the ray no surface is in between
// (Section 3.5).
vec3 asked_place(vec3 point, vec3 view, vec3 normal, float length_of_ray, bool along_view) {
  float off = ddgi.ddgi_bias * ddgi.spacing.w;
  if (along_view) return point + view * min(off, 0.9 * length_of_ray);
  return point + (normal * 0.2 + view * 0.8) * off;
}

// --- A surface's BSDF in two: what probes know of the light that it scatters evenly, and its coat ---
// Reflectance of the Lambert part under even light, towards a viewer at this cosine. The mean over the cosine of what
// Schlick's Fresnel term lets through is 20/21 (1 - F0).
vec3 diffuse_reflectance(Bsdf b, float cosine) {
  vec3 albedo = b.albedo * (1.0 - b.metalness);
  if (!bsdf_has_coat(b)) return albedo;
  float through = 1.0 - b.specular;
  return albedo * (through * (1.0 - schlick_weight(cosine)) * through * (20.0 / 21.0));
}
// The coat alone, as a metal of its reflectance.
Bsdf coat_of(Bsdf b) { return Bsdf(bsdf_f0(b), b.alpha, b.specular, 1.0); }
#endif
