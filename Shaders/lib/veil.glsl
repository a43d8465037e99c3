// Where the camera's ray meets a translucent liquid without refraction. The passes that see it end the ray there: they
// include this first.
#ifndef FB_LIB_VEIL
#define FB_LIB_VEIL

bool stops_at_veils = false;
#define STOPS_AT_VEILS stops_at_veils

#include "lib/segment.glsl"

// The share of light that a hit lets through; 0 where it is no veil.
float veil_lets_through(Hit hit) {
  if (!has_feature(kFeatureVeils) || hit.instance == kNoIndex) return 0.0;
  GpuMaterial m = material_of(hit.instance, hit.triangle);
  bool liquid = (m.flags & kMaterialLiquid) != 0u && (m.flags & kMaterialDielectric) == 0u;
  return liquid ? max(1.0 - alpha_of(m, hit.instance), 0.0) : 0.0;
}

// The way on, behind the veil that ended it. `left` as it was before the veil.
Segment beyond_veil(Segment s, vec3 left, float lets_through) {
  GpuTriangle t = world_triangle(s.hit.instance, s.hit.triangle);
  vec3 at = t.v0.xyz + t.e1.xyz * s.hit.bary.x + t.e2.xyz * s.hit.bary.y;
  vec3 normal = normalize(cross(t.e1.xyz, t.e2.xyz));
  s.origin = offset_origin(at, dot(normal, s.direction) < 0.0 ? -normal : normal);
  s.left = left * lets_through;
  return s;
}
#endif
