// Step `field`: the cell about a point.
#ifndef FB_PSTF_FIELD
#define FB_PSTF_FIELD
#include "estimators/pstf/steps/begin.glsl"

const bool kHasField = true;

struct Field {
  CellPlace place;
  vec3 normal;
};

// A cell is as wide as is seen under an angle from the camera, and no narrower than the footprint of light that was
// scattered towards it (Bekaert 2003), taken to be as of a diffuse surface: in proportion to the ray's length.
float cell_angle(Vertex v, Path path) {
  float seen = max(distance(v.position, frame.camera_position.xyz), 1.0);
  float footprint = path.own.scattered ? pstf.pstf_spread * distance(v.position, path.own.from) : 0.0;
  return max(pstf.cell_angle, footprint / seen);
}

const uint kDirectionKind = 8192u;  // beyond the tags of levels and faces

Field field_at(Vertex v, inout Path path) {
  Field f = Field(CellPlace(kNoIndex, kNoIndex, 0u), v.scatter.shading_normal);
  if (in_medium(v.scatter)) return f;
  bool by_direction = pstf.pstf_key != 0;
  vec3 axis = by_direction ? v.view : scatter_axis(v.scatter);
  uint kind = by_direction ? kDirectionKind * (1u + direction_part(v.view, pstf.pstf_directions)) : 0u;
  f.place = find_pstf_cell(v.position, axis, kind, cell_angle(v, path), uint(pstf.pstf_cells), kPstfStale,
                           path.own.group_rng);
  return f;
}

// What a surface reflects of light that is the same from everywhere, towards its viewer, about: outgoing light is kept
// over it.
vec3 reflectance_of(Scatter s, vec3 view) {
  if (!FEATURE_SPECULAR || !bsdf_has_coat(s.bsdf)) return s.bsdf.albedo;
  vec3 coat = bsdf_fresnel(s.bsdf, max(dot(view, s.shading_normal), 0.0));
  return s.bsdf.albedo * (1.0 - s.bsdf.metalness) * (vec3(1.0) - coat) + coat;
}

const float kEndsTaught = 16.0;  // samples of a cell in which paths may end

bool is_taught(Field f) {
  return f.place.slot != kNoIndex && uintBitsToFloat(pstf_texel(f.place.slot, 0u).w) >= kEndsTaught;
}

// A path that ends in the field must not lack light: a place of which nothing is known is thought to be lit like the
// one that sees it.
vec3 field_reflection(Field there, Field here, Vertex v) {
  uint slot = kEndsInField && !is_taught(there) ? here.place.slot : there.place.slot;
  return slot == kNoIndex ? vec3(0.0)
                          : reflectance_of(v.scatter, v.view) * outgoing_light(slot, v.scatter.shading_normal);
}

bool field_suffices(Field there, Field here, Path path) {
  return kEndsInField && !path.own.goes_on && is_taught(there);
}
#endif
