// From a hit to a surface point: position, normals that face the ray, colour, emission, BSDF, and where the point was.
#ifndef FB_LIB_SURFACE
#define FB_LIB_SURFACE
#include "lib/candidate.glsl"
#include "lib/sky.glsl"
#include "shared/packing.h"

// False: no surface of the scene has a coat (plain Lambert throughout).
layout(constant_id = kSpecSpecular) const bool FEATURE_SPECULAR = true;

struct Surface {
  vec3 position;
  vec3 normal;  // geometric
  vec3 shading_normal;
  vec3 emission;
  Bsdf bsdf;
  uint material;
  bool sky;  // it shows the sky, which is far behind it
};

vec3 rows_times_point(vec4 x, vec4 y, vec4 z, vec3 p) {
  return vec3(dot(x.xyz, p) + x.w, dot(y.xyz, p) + y.w, dot(z.xyz, p) + z.w);
}
vec3 to_world_point(uint i, vec3 p) {
  return rows_times_point(instance_at(i).to_world[0], instance_at(i).to_world[1], instance_at(i).to_world[2], p);
}
vec3 to_previous_world_point(uint i, vec3 p) {
  return rows_times_point(instance_at(i).prev_to_world[0], instance_at(i).prev_to_world[1],
                          instance_at(i).prev_to_world[2], p);
}
vec3 to_world_vector(uint i, vec3 v) {
  return vec3(dot(instance_at(i).to_world[0].xyz, v), dot(instance_at(i).to_world[1].xyz, v),
              dot(instance_at(i).to_world[2].xyz, v));
}
// Normals go by the inverse transposed.
vec3 to_world_normal(uint i, vec3 n) {
  return normalize(instance_at(i).to_object[0].xyz * n.x + instance_at(i).to_object[1].xyz * n.y +
                   instance_at(i).to_object[2].xyz * n.z);
}

// A triangle as it stands in the world. Our own trees hold it; ray queries have it in the mesh's space.
GpuTriangle world_triangle(uint instance, uint triangle) {
#if INTERSECTOR_QUERY
  GpuTriangle t = triangle_at(instance_at(instance).first_triangle + triangle);
  return GpuTriangle(vec4(to_world_point(instance, t.v0.xyz), 0.0), vec4(to_world_vector(instance, t.e1.xyz), 0.0),
                     vec4(to_world_vector(instance, t.e2.xyz), 0.0));
#else
  return triangle_at(instance_at(instance).world_triangle + triangle);
#endif
}

// Start of a ray that leaves a surface: off it by a little more than positions are rounded by.
vec3 offset_origin(vec3 position, vec3 normal) {
  vec3 a = abs(position);
  return position + normal * (2e-3 + 1e-6 * max(a.x, max(a.y, a.z)));
}

vec3 pose_vertex(uint at, vec3 scale, vec3 origin) { return unpack_pose_position(poses.at[at].x) * scale + origin; }

vec3 previous_vertex(uint i, uint vertex) {
  vec3 scale = instance_at(i).pose_scale.xyz, origin = instance_at(i).pose_origin.xyz;
  vec3 from = pose_vertex(instance_at(i).prev_pose_a + vertex, scale, origin);
  vec3 to = pose_vertex(instance_at(i).prev_pose_b + vertex, scale, origin);
  return mix(from, to, instance_at(i).prev_pose_t);
}

// Where a point of the surface was in the previous frame, in the world.
vec3 previous_position(Hit hit) {
  uint i = hit.instance;
  vec3 v0, e1, e2;
  if (instance_at(i).pose_a == kNoIndex) {
    GpuTriangle t = triangle_at(instance_at(i).first_triangle + hit.triangle);
    v0 = t.v0.xyz;
    e1 = t.e1.xyz;
    e2 = t.e2.xyz;
  } else {
    GpuAttribute a = attribute_at(instance_at(i).first_attribute + hit.triangle);
    v0 = previous_vertex(i, a.vertex0);
    e1 = previous_vertex(i, a.vertex1) - v0;
    e2 = previous_vertex(i, a.vertex2) - v0;
  }
  return to_previous_world_point(i, v0 + e1 * hit.bary.x + e2 * hit.bary.y);
}

vec3 pose_normal(uint vertex, uint pose_a, uint pose_b, float t) {
  return mix(unpack_direction(poses.at[pose_a + vertex].y), unpack_direction(poses.at[pose_b + vertex].y), t);
}

// Interpolated vertex normal in the mesh's space; zero where the mesh is flat.
vec3 smooth_normal(uint instance_index, GpuAttribute a, vec2 bary) {
  vec3 weights = vec3(1.0 - bary.x - bary.y, bary);
  uint pose_a = instance_at(instance_index).pose_a;
  if (pose_a != kNoIndex) {
    uint pose_b = instance_at(instance_index).pose_b;
    float t = instance_at(instance_index).pose_t;
    return weights.x * pose_normal(a.vertex0, pose_a, pose_b, t) +
           weights.y * pose_normal(a.vertex1, pose_a, pose_b, t) +
           weights.z * pose_normal(a.vertex2, pose_a, pose_b, t);
  }
  uint first = instance_at(instance_index).first_normal;
  if (first == kNoIndex) return vec3(0.0);
  return weights.x * unpack_direction(normals.at[first + a.vertex0]) +
         weights.y * unpack_direction(normals.at[first + a.vertex1]) +
         weights.z * unpack_direction(normals.at[first + a.vertex2]);
}

// Turns a normal map's texel, 0..1 each, about the surface; texture coordinates give the tangent.
vec3 mapped_normal(vec3 texel, GpuAttribute a, GpuTriangle t, vec3 n) {
  vec2 d1 = a.uv1 - a.uv0, d2 = a.uv2 - a.uv0;
  float determinant = d1.x * d2.y - d1.y * d2.x;
  if (abs(determinant) < 1e-12) return n;
  vec3 tangent = (t.e1.xyz * d2.y - t.e2.xyz * d1.y) / determinant;
  vec3 down = (t.e2.xyz * d1.x - t.e1.xyz * d2.x) / determinant;
  tangent = normalize(tangent - n * dot(n, tangent));
  vec3 bitangent = cross(n, tangent);
  if (dot(bitangent, down) > 0.0) bitangent = -bitangent;  // green points up the image, v runs down it
  vec3 s = texel * 2.0 - 1.0;
  return normalize(tangent * s.x + bitangent * s.y + n * max(s.z, 0.01));
}

// Normal map and gloss image, where there are any.
void apply_detail(inout Surface s, inout float roughness, GpuMaterial m, GpuAttribute a, GpuTriangle t, vec2 uv,
                  TextureFilter filtered) {
  uint first = m.normal != kNoIndex ? 0u : 1u, last = FEATURE_SPECULAR && m.gloss != kNoIndex ? 2u : 1u;
  bool clamped = (m.flags & kMaterialClampTexture) != 0u;
  for (uint i = first; i < last; ++i) {
    uint image = i == 0u ? m.normal : m.gloss;
    vec3 color = vec3(0.0);
    if (filtered.kind == kFilterFootprint) {
      for (uint tap = 0u; tap < 4u; ++tap)
        color += 0.25 * nearest_texel(image, uv + footprint_tap(filtered, vec2(tap & 1u, tap >> 1u)), clamped).color;
    } else {
      color = nearest_texel(image, uv, clamped).color;
    }
    if (i == 0u)
      s.shading_normal = mapped_normal(color, a, t, s.shading_normal);
    else
      roughness = 1.0 - color.x;
  }
}

// The pixel's footprint on a triangle that the camera's ray meets at this depth along the view, in texture coordinates
// (ray differentials, Igehy 1999).
mat2 uv_footprint(GpuTriangle t, GpuAttribute a, vec3 ray, float depth) {
  vec3 n = cross(t.e1.xyz, t.e2.xyz);
  float square = dot(n, n), facing = dot(n, ray);
  float least = 1e-3 * sqrt(square * dot(ray, ray));
  facing = abs(facing) > least ? facing : facing < 0.0 ? -least : least;
  vec3 steps[2] =
      vec3[](frame.camera_right.xyz * (2.0 / float(frame.width)), frame.camera_up.xyz * (-2.0 / float(frame.height)));
  mat2 footprint;
  for (int i = 0; i < 2; ++i) {
    vec3 moved = depth * (steps[i] - ray * (dot(n, steps[i]) / facing));
    vec2 bary = vec2(dot(cross(moved, t.e2.xyz), n), dot(cross(t.e1.xyz, moved), n)) / max(square, 1e-20);
    footprint[i] = (a.uv1 - a.uv0) * bary.x + (a.uv2 - a.uv0) * bary.y;
  }
  return footprint;
}

// The surface that a ray meets; where it meets none (hit.instance is kNoIndex), emission is the sky's and nothing else
// counts. `end_of_path`: emission is all that is wanted. `filter_kind`: of textures, kFilterFootprint for camera rays
// alone. `seen`: by the camera itself, to which it may glow otherwise than on what it lights.
Surface load_surface(Hit hit, vec3 direction, uint filter_kind, bool end_of_path, bool seen) {
  Surface s;
  s.emission = vec3(0.0);
  vec3 sky_factor = vec3(1.0);
  bool sky = hit.instance == kNoIndex;
  if (!sky) {
    uint record = instance_at(hit.instance).first_attribute + hit.triangle;
    GpuAttribute a = attribute_at(record);
    s.material = instance_at(hit.instance).material_base + a.material;
    GpuMaterial m = material_at(s.material);
    vec2 uv = hit_uv(record, hit.bary);
    TextureFilter filtered = TextureFilter(filter_kind, mat2(0.0));
    if (filter_kind == kFilterFootprint)
      filtered.footprint = uv_footprint(world_triangle(hit.instance, hit.triangle), a, direction,
                                        hit.t * dot(direction, frame.camera_forward.xyz));
    Shade shade = shade_point(m, hit.instance, uv, filtered);
    s.emission = shade.emission * (seen ? seen_emission(m) : vec3(emission_share(hit.instance, m, direction, hit.t)));
    sky = m.emission_kind == kEmissionSky && (instance_at(hit.instance).flags & kInstanceHasColor) == 0u;
    sky_factor = m.emission.rgb;
    if (!end_of_path) {
      GpuTriangle t = world_triangle(hit.instance, hit.triangle);
      s.position = t.v0.xyz + t.e1.xyz * hit.bary.x + t.e2.xyz * hit.bary.y;
      s.normal = normalize(cross(t.e1.xyz, t.e2.xyz));
      if (dot(s.normal, direction) > 0.0) s.normal = -s.normal;
      s.shading_normal = s.normal;
      if (has_feature(kFeatureSmooth) && (a.flags & kTriangleSmooth) != 0u) {
        vec3 n = smooth_normal(hit.instance, a, hit.bary);
        if (dot(n, n) > 0.0) {
          n = to_world_normal(hit.instance, n);
          s.shading_normal = dot(n, s.normal) < 0.0 ? -n : n;
        }
      }
      float roughness = m.roughness;
      if (has_feature(kFeatureDetail)) apply_detail(s, roughness, m, a, t, uv, filtered);
      // A shading normal that faces away from the ray is bent back until it does not.
      float facing = dot(s.shading_normal, direction);
      if (facing > -0.02) s.shading_normal = normalize(s.shading_normal - direction * (facing + 0.02));
      s.bsdf.albedo = shade.albedo;
      s.bsdf.alpha = max(roughness * roughness, kMinAlpha);
      s.bsdf.specular = FEATURE_SPECULAR ? m.specular : 0.0;
      s.bsdf.metalness = FEATURE_SPECULAR ? m.metalness : 0.0;
    }
  }
  if (sky) s.emission = sky_radiance(direction) * sky_factor;
  s.sky = sky;
  return s;
}
#endif
