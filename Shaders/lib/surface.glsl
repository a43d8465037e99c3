// From a hit to a surface point: position, normals that face the ray, colour, emission, BSDF, and where the point was.
#ifndef FB_LIB_SURFACE
#define FB_LIB_SURFACE
#include "lib/candidate.glsl"
#include "shared/packing.h"

// False: no surface of the scene has a coat (plain Lambert throughout).
layout(constant_id = 1) const bool FEATURE_SPECULAR = true;

struct Surface {
  vec3 position;
  vec3 normal;          // geometric
  vec3 shading_normal;
  vec3 emission;
  Bsdf bsdf;
  uint material;
};

vec3 apply_rows_point(vec4 rows[3], vec3 p) {
  return vec3(dot(rows[0].xyz, p) + rows[0].w, dot(rows[1].xyz, p) + rows[1].w, dot(rows[2].xyz, p) + rows[2].w);
}
vec3 apply_rows_vector(vec4 rows[3], vec3 v) {
  return vec3(dot(rows[0].xyz, v), dot(rows[1].xyz, v), dot(rows[2].xyz, v));
}
// Normals go by the inverse transposed.
vec3 apply_rows_normal(vec4 inverse_rows[3], vec3 n) {
  return normalize(inverse_rows[0].xyz * n.x + inverse_rows[1].xyz * n.y + inverse_rows[2].xyz * n.z);
}

// Start of a ray that leaves a surface: off it by a little more than positions are rounded by.
vec3 offset_origin(vec3 position, vec3 normal) {
  vec3 a = abs(position);
  return position + normal * (2e-3 + 1e-6 * max(a.x, max(a.y, a.z)));
}

vec3 pose_vertex(uint at, vec3 scale, vec3 origin) {
  uint bytes = poses[at].x;
  return vec3(float(bytes & 0xffu), float((bytes >> 8u) & 0xffu), float((bytes >> 16u) & 0xffu)) * scale + origin;
}

// Where a point of the surface was in the previous frame, in the world.
vec3 previous_position(Hit hit) {
  GpuInstance instance = instances[hit.instance];
  vec3 p;
  if (instance.pose_a == kNoIndex) {
    GpuTriangle t = triangles[instance.first_triangle + hit.triangle];
    p = t.v0.xyz + t.e1.xyz * hit.bary.x + t.e2.xyz * hit.bary.y;
  } else {
    GpuAttribute a = attributes[instance.first_attribute + hit.triangle];
    uint vertices[3] = uint[3](a.vertex0, a.vertex1, a.vertex2);
    vec3 v[3];
    for (uint i = 0u; i < 3u; ++i) {
      vec3 from = pose_vertex(instance.prev_pose_a + vertices[i], instance.pose_scale.xyz, instance.pose_origin.xyz);
      vec3 to = pose_vertex(instance.prev_pose_b + vertices[i], instance.pose_scale.xyz, instance.pose_origin.xyz);
      v[i] = mix(from, to, instance.prev_pose_t);
    }
    p = v[0] + (v[1] - v[0]) * hit.bary.x + (v[2] - v[0]) * hit.bary.y;
  }
  return apply_rows_point(instance.prev_to_world, p);
}

vec3 pose_normal(uint vertex, uint pose_a, uint pose_b, float t) {
  return mix(unpack_direction(poses[pose_a + vertex].y), unpack_direction(poses[pose_b + vertex].y), t);
}

// Interpolated vertex normal in the mesh's space; zero where the mesh is flat.
vec3 smooth_normal(uint instance_index, GpuAttribute a, vec2 bary) {
  vec3 weights = vec3(1.0 - bary.x - bary.y, bary);
  uint pose_a = instances[instance_index].pose_a;
  if (pose_a != kNoIndex) {
    uint pose_b = instances[instance_index].pose_b;
    float t = instances[instance_index].pose_t;
    return weights.x * pose_normal(a.vertex0, pose_a, pose_b, t) + weights.y * pose_normal(a.vertex1, pose_a, pose_b, t) +
           weights.z * pose_normal(a.vertex2, pose_a, pose_b, t);
  }
  uint first = instances[instance_index].first_normal;
  if (first == kNoIndex) return vec3(0.0);
  return weights.x * unpack_direction(normals[first + a.vertex0]) + weights.y * unpack_direction(normals[first + a.vertex1]) +
         weights.z * unpack_direction(normals[first + a.vertex2]);
}

// Turns a normal map's texel about the surface; uv gives the tangent.
vec3 mapped_normal(GpuMaterial m, GpuAttribute a, GpuTriangle t, uint instance_index, vec3 n, vec2 uv) {
  vec2 d1 = a.uv1 - a.uv0, d2 = a.uv2 - a.uv0;
  float determinant = d1.x * d2.y - d1.y * d2.x;
  if (abs(determinant) < 1e-12) return n;
  vec3 tangent = apply_rows_vector(instances[instance_index].to_world, (t.e1.xyz * d2.y - t.e2.xyz * d1.y) / determinant);
  vec3 down = apply_rows_vector(instances[instance_index].to_world, (t.e2.xyz * d1.x - t.e1.xyz * d2.x) / determinant);
  tangent = normalize(tangent - n * dot(n, tangent));
  vec3 bitangent = cross(n, tangent);
  if (dot(bitangent, down) > 0.0) bitangent = -bitangent;  // green points up the image, v runs down it
  vec3 s = nearest_texel(m.normal, uv, (m.flags & kMaterialClampTexture) != 0u).color * 2.0 - 1.0;
  return normalize(tangent * s.x + bitangent * s.y + n * max(s.z, 0.01));
}

// Colour and radiance alone: all that the end of a path needs.
Shade load_shade(Hit hit, vec3 direction, bool smooth_texels) {
  uint record = instances[hit.instance].first_attribute + hit.triangle;
  GpuMaterial m = materials[instances[hit.instance].material_base + attributes[record].material];
  return shade_point(m, hit.instance, hit_uv(record, hit.bary), direction, smooth_texels);
}

Surface load_surface(Hit hit, vec3 direction, bool smooth_texels) {
  uint record = instances[hit.instance].first_attribute + hit.triangle;
  GpuAttribute a = attributes[record];
  GpuTriangle t = triangles[instances[hit.instance].first_triangle + hit.triangle];
  Surface s;
  s.material = instances[hit.instance].material_base + a.material;
  GpuMaterial m = materials[s.material];
  vec2 uv = hit_uv(record, hit.bary);
  Shade shade = shade_point(m, hit.instance, uv, direction, smooth_texels);
  s.emission = shade.emission;
  s.position = apply_rows_point(instances[hit.instance].to_world, t.v0.xyz + t.e1.xyz * hit.bary.x + t.e2.xyz * hit.bary.y);
  s.normal = apply_rows_normal(instances[hit.instance].to_object, cross(t.e1.xyz, t.e2.xyz));
  if (dot(s.normal, direction) > 0.0) s.normal = -s.normal;
  s.shading_normal = s.normal;
  if ((a.flags & kTriangleSmooth) != 0u) {
    vec3 n = smooth_normal(hit.instance, a, hit.bary);
    if (dot(n, n) > 0.0) {
      n = apply_rows_normal(instances[hit.instance].to_object, n);
      if (dot(n, s.normal) < 0.0) n = -n;
      s.shading_normal = n;
    }
  }
  if (m.normal != kNoIndex) s.shading_normal = mapped_normal(m, a, t, hit.instance, s.shading_normal, uv);
  // A shading normal that faces away from the ray is bent back until it does not.
  float facing = dot(s.shading_normal, direction);
  if (facing > -0.02) s.shading_normal = normalize(s.shading_normal - direction * (facing + 0.02));
  s.bsdf.albedo = shade.albedo;
  float roughness = m.roughness;
  if (FEATURE_SPECULAR && m.gloss != kNoIndex) {
    roughness = 1.0 - nearest_texel(m.gloss, uv, (m.flags & kMaterialClampTexture) != 0u).color.x;
  }
  s.bsdf.alpha = max(roughness * roughness, kMinAlpha);
  s.bsdf.specular = FEATURE_SPECULAR ? m.specular : 0.0;
  s.bsdf.metalness = FEATURE_SPECULAR ? m.metalness : 0.0;
  return s;
}
#endif
