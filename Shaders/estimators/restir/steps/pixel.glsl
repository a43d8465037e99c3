// The pixels of ReSTIR's passes: where their reservoirs are, which of them reuse, and whose history and neighbours they
// take up.
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
  if (!shows_two()) return true;
  if (FEATURE_WATER && (g.material_metalness & kTexelLiquid) != 0u) return false;
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

// The former frame's vertex at a texel, as that frame saw it.
Vertex former_vertex(FormerTexel f) {
  Vertex v = first_vertex(f.texel, f.pixel);
  v.view = normalize(frame.prev_camera_position.xyz - v.position);
  v.previous = v.position;
  return v;
}

// Where a block takes its history from: blocks change places in pairs, with others each frame, so that each history
// goes to one.
ivec2 permuted(uvec2 block) {
  uint h = hash_combine(frame.frame, frame.seed ^ 0x68e31da4u);
  uvec2 by = uvec2((h >> 8u) & 3u, (h >> 16u) & 3u), moved = block + by;
  return ivec2((moved ^ uvec2(h & 1u, (h >> 1u) & 1u)) - by) - ivec2(block);
}

FormerTexel history_of(GBufferTexel g, PathPixel p) {
  return former_lit_texel(g, p.pixel, restir.restir_permute != 0 ? permuted(p.block) : ivec2(0));
}

// How far off the pixels are whose samples are shared, in blocks; evenly about one.
vec2 near_by(inout uint rng) {
  float radius = max(restir.restir_radius * float(frame.height) / (1080.0 * float(frame.light_block)), 1.5);
  float far = radius * sqrt(rng_uniform(rng)), turn = 2.0 * kPiShared * rng_uniform(rng);
  return far * vec2(cos(turn), sin(turn));
}

// Of pixels about a former one, so many are asked whether they hold the same sample (after the duplication maps of Lin
// 2026).
const uint kNearFormer = 8u;

uint near_former(FormerTexel f, inout uint rng) {
  vec2 block = vec2(f.element % frame.light_width, f.element / frame.light_width);
  ivec2 near = ivec2(floor(block + 0.5 + near_by(rng)));
  return element_of(uvec2(clamp(near, ivec2(0), ivec2(lit_blocks()) - 1)));
}
float confidence_among(float history, uint alike) {
  return max(history * (1.0 - float(alike) / float(kNearFormer)), min(history, 1.0));
}

const float kLikeNormal = 0.8, kLikeDepth = 0.1;

struct Neighbor {
  bool there;
  uvec2 block, pixel;
};

Neighbor neighbor_of(PathPixel p, GBufferTexel g, inout uint rng) {
  ivec2 block = ivec2(floor(vec2(p.block) + 0.5 + near_by(rng)));
  Neighbor n;
  n.there =
      all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, ivec2(lit_blocks()))) && block != ivec2(p.block);
  n.block = n.there ? uvec2(block) : p.block;
  n.pixel = light_pixel(n.block);
  n.there = n.there && n.pixel.x < frame.width && n.pixel.y < frame.height;
  n.pixel = n.there ? n.pixel : p.pixel;
  uint at = n.pixel.y * frame.width + n.pixel.x;
  uvec4 words = gbuffer_quad(at, 3u);
  float depth = uintBitsToFloat(gbuffer_quad(at, 4u).z);
  n.there = n.there && dot(unpack_direction(words.x), unpack_direction(g.normal)) > kLikeNormal &&
            abs(depth - g.motion.z) < kLikeDepth * g.motion.z;
  return n;
}
#endif
