// A vertex of a path: an interaction of light with the scene. Where it is, whence it is seen, and how light scatters
// there.
#ifndef FB_LIB_INTERACTION
#define FB_LIB_INTERACTION
#include "lib/scatter.glsl"
#include "shared/veils.h"

const float kRayEnd = 1e6;  // beyond any map: coordinates end at 32768

layout(constant_id = kSpecWater) const bool FEATURE_WATER = false;  // some surface is an interface of water or glass

// A pixel may show two surfaces.
bool shows_two() { return FEATURE_WATER || has_feature(kFeatureVeils); }

struct Vertex {
  vec3 position;
  vec3 previous;  // where the point was in the former frame; only known of what the camera sees
  vec3 view;      // towards the previous vertex
  Scatter scatter;
  uint liquid;  // that it is in: a liquid or glass, below
  bool glows;   // itself, at this very point; false where that is not known
};

// What a point is in: the material in the low half, the one around that in the high half, kNoMaterial for air. So
// kNoIndex is air, and glass in water knows what is behind it; what is around both is taken for air.
const uint kNoMaterial = 0xffffu;
uint medium_within(uint around, uint material) { return around << 16u | material; }
uint medium_around(uint liquid) { return kNoMaterial << 16u | liquid >> 16u; }
float medium_index(uint liquid) { return liquid == kNoIndex ? 1.0 : material_at(liquid & kNoMaterial).emission.w; }

Vertex surface_vertex(Surface s, vec3 view) {
  return Vertex(s.position, s.position, view, Scatter(s.normal, s.shading_normal, s.bsdf, false, kNoPhase), kNoIndex,
                s.emission != vec3(0.0));
}

// A point of the medium between surfaces, or of a liquid.
Vertex medium_vertex(vec3 position, vec3 view, uint liquid) {
  bool fog = !FEATURE_WATER || liquid == kNoIndex;
  PhaseFunction phase =
      PhaseFunction(fog ? frame.medium_phase.x : frame.medium_phase.w, fog ? frame.medium_phase.y : 0.0);
  return Vertex(position, position, view, Scatter(view, view, Bsdf(vec3(0.0), 1.0, 0.0, 0.0), true, phase), liquid,
                false);
}

vec3 extinction_of(GpuMaterial m) { return vec3(m.extinction_r, m.extinction_g, m.extinction_b); }

// The share of its light that a ray brings through the medium, or through a liquid.
vec3 light_left(uint liquid, float distance) {
  vec3 left = vec3(FEATURE_MEDIUM ? transmittance(frame.medium.w, distance) : 1.0);
  if (!FEATURE_WATER || liquid == kNoIndex) return left;
  return transmittance(extinction_of(material_at(liquid & kNoMaterial)), distance);
}

#endif
