// The pixels of ReSTIR's passes: where their reservoirs are, and which of them reuse.
#ifndef FB_RESTIR_PIXEL
#define FB_RESTIR_PIXEL
#include "estimators/restir/steps/all.glsl"
#include "lib/former.glsl"
#include "lib/pixel_start.glsl"

uvec2 lit_blocks() { return uvec2(frame.light_width, (frame.height + frame.light_block - 1u) / frame.light_block); }
bool is_block(PathPixel p) { return all(lessThan(p.block, lit_blocks())); }
uint element_of(uvec2 block) { return block.y * frame.light_width + block.x; }

// Pixels that show one surface, in air and straight. With suns that water mirrors, none.
bool may_reuse(GBufferTexel g, uint at) {
  if (!reflects_light(g)) return false;
  if (!FEATURE_WATER) return true;
  if ((g.material_metalness & kTexelLiquid) != 0u) return false;
  WaterTexel w = water_at(at);
  bool mirrors = has_feature(kFeatureSuns) && frame.mirrors != 0u && frame.sun_count > 0u;
  return w.seen.albedo == vec3(0.0) && w.own_liquid == kNoIndex && !mirrors;
}

// Whether a sample's light is seen from a vertex, as the scene is now.
bool arrives(Domain d, LightPoint p, inout uint rng) {
  Aim aim;
  d.former = false;
  bool asked = light_target(d, p, aim) > 0.0;
  Segment way = segment_from(d.v, aim.direction, asked ? aim.reach : 0.0, aim.turn, rng);
  return asked && is_found(aim, way);
}

uint pass_seed(PathPixel p, uint pass) { return rng_seed(p.at, frame.frame, 0u, frame.seed ^ pass); }
#endif
