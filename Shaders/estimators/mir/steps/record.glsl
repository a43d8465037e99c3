// Step `record` of `mir`: vertices of paths that begin at surfaces, for the host.
#include "estimators/mir/steps/propose.glsl"
#include "lib/gbuffer_texel.glsl"
#include "lib/incident.glsl"

const bool kRecords = true;

uint mir_path(uvec2 pixel) { return pixel.y * frame.width + pixel.x; }
bool mir_stores(uint path) { return mir.stored != 0u && !IN_MEDIUM && path < mir.paths; }

void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput) {}

void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput) {
  uint of = mir_path(path.pixel);
  if (!mir_stores(of) || path.depth >= mir.stored) return;
  uint at = of * mir.stored + path.depth;
  mir_places.at[at] = vec4(v.position, g.scatter_pdf);
  mir_directions.at[at] = vec4(p.direction, p.pdf);
  mir_links.at[at] = vec4(p.weight * path.own.left, v.glows ? 0.0 : 1.0);
  mir_lights.at[at] = vec4(incident.emission, 0.0);
  path.own.left = incident.way.left;
  path.own.vertices = path.depth + 1u;
}

void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput) {}

void record_path(Path path, vec3 sum, inout uint rng) {
  uint at = mir_path(path.pixel);
  if (!mir_stores(at)) return;
  bool lost = any(isnan(sum)) || any(isinf(sum));
  float factor = path.factor.x;
  if (FEATURE_MEDIUM) factor *= haze_left(camera_haze(), gbuffer_at(at).position_t.w);
  mir_ends.at[at] = uvec4(lost ? 0u : path.own.vertices, floatBitsToUint(factor), 0u, 0u);
}

void record_none(uvec2 block, uvec2 pixel) {
  if (mir_stores(mir_path(pixel))) mir_ends.at[mir_path(pixel)] = uvec4(0u);
}
