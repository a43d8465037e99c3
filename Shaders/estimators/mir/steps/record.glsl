// Step `record` of `mir` and `mir_nee`: vertices of paths that begin at surfaces, for the host.
#include "estimators/mir/steps/propose.glsl"
#include "lib/gbuffer_texel.glsl"
#include "lib/incident.glsl"

const bool kRecords = true;
const uint kMirStride = kLooksForLight ? kMirLightsLooked : kMirLightsOfOne;

uint mir_path(uvec2 pixel) { return pixel.y * frame.width + pixel.x; }
bool mir_stores(uint path) { return mir.stored != 0u && !IN_MEDIUM && path < mir.paths; }

// A vertex that looked for light. That its path goes on is for record_hit to say.
void record_looked(inout Path path, Vertex v, Direct direct, vec3 direction, float looked_pdf, float density,
                   bool guided) {
  uint of = mir_path(path.pixel);
  if (!mir_stores(of) || path.depth >= mir.stored) return;
  uint at = of * mir.stored + path.depth;
  mir_places.at[at] = vec4(v.position, 0.0);
  mir_directions.at[at] = vec4(0.0);
  mir_links.at[at] = vec4(0.0, 0.0, 0.0, guided ? 1.0 : 0.0);
  mir_lights.at[kMirStride * at] = vec4(0.0);
  mir_lights.at[kMirStride * at + 1u] = vec4(direct.radiance * path.own.left, density);
  mir_lights.at[kMirStride * at + 2u] = vec4(direction, looked_pdf);
  path.own.vertices = path.depth + 1u;
}

void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput) {
  record_looked(path, v, direct, path.own.looked, path.own.looked_pdf, path.own.look_density, !v.glows);
}

void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput) {
  uint of = mir_path(path.pixel);
  if (!mir_stores(of) || path.depth >= mir.stored) return;
  uint at = of * mir.stored + path.depth;
  mir_places.at[at] = vec4(v.position, g.scatter_pdf);
  mir_directions.at[at] = vec4(p.direction, p.pdf);
  mir_links.at[at] = vec4(p.weight * path.own.left, v.glows ? 0.0 : 1.0);
  mir_lights.at[kMirStride * at] = vec4(incident.emission, path.own.met_density);
  path.own.left = incident.way.left;
  path.own.vertices = path.depth + 1u;
}

void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput) {
  record_looked(path, v, direct, vec3(0.0, 0.0, 1.0), 0.0, 0.0, false);
}

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
