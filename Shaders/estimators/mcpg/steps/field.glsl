// Step `field`: the irradiance cache. For training; where kEndsInField (mcpg_tail, biased) it also ends paths.
#ifndef FB_MCPG_FIELD
#define FB_MCPG_FIELD
#include "estimators/mcpg/steps/cache.glsl"
#include "lib/path_state.glsl"

const bool kHasField = true;
const uint kTailFrames = 4u;  // that must have trained a cell before a path may end in it

struct Field {
  CacheCell cell;
};

Field field_at(Vertex v, inout Path path) {
  if (!GUIDES) return Field(CacheCell(kNoIndex, kNoIndex, 0u));
  return Field(find_cache_cell(v.position, scatter_axis(v.scatter), in_medium(v.scatter) ? kMediumTag : kCacheTag,
                               path.own.guided.group_rng));
}

// A path that ends in the field must not lack light (nor must the cache, which learns from such paths): a place of
// which nothing is known is thought to be lit like the one that sees it.
vec3 field_reflection(Field there, Field here, Vertex v) {
  uint entry = there.cell.entry;
  if (kEndsInField && (entry == kNoIndex || cache_frames(entry) < kTailFrames)) entry = here.cell.entry;
  bool known = entry != kNoIndex && guide.mc_cache != 0;
  return known ? scatter_albedo(v.scatter) * cached_reflection(entry) : vec3(0.0);
}

bool field_suffices(Field there, Field here, Path path) {
  if (path.own.guided.goes_on) return false;
  uint a = there.cell.entry, b = here.cell.entry;
  return (a != kNoIndex && cache_frames(a) >= kTailFrames) || (b != kNoIndex && cache_frames(b) >= kTailFrames);
}
#endif
