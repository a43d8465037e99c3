// Step `begin` of `mir`, with its block and arrays.
#ifndef FB_MIR_BEGIN
#define FB_MIR_BEGIN
#include "estimators/mir/mir.h"
#include "lib/frame_bindings.glsl"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform MirBlock { MirConstants mir; };
FB_TECHNIQUE_ARRAY(kMirPlaces, 16, , MirPlaceArray, vec4, mir_places)
FB_TECHNIQUE_ARRAY(kMirDirections, 16, , MirDirectionArray, vec4, mir_directions)
FB_TECHNIQUE_ARRAY(kMirLinks, 16, , MirLinkArray, vec4, mir_links)
FB_TECHNIQUE_ARRAY(kMirLights, 16, , MirLightArray, vec4, mir_lights)
FB_TECHNIQUE_ARRAY(kMirEnds, 16, , MirEndArray, uvec4, mir_ends)
FB_TECHNIQUE_ARRAY(kMirTotals, 16, , MirTotalArray, vec4, mir_totals)
FB_TECHNIQUE_ARRAY(kMirTree, 4, readonly, MirTreeArray, uint, mir_tree)
FB_TECHNIQUE_ARRAY(kMirNodes, 16, readonly, MirNodeArray, uvec4, mir_nodes)
FB_TECHNIQUE_ARRAY(kMirPicture, 16, readonly, MirPictureArray, vec4, mir_picture)

struct PathOwn {
  uint vertices;       // that were stored
  vec3 left;           // of light on the way to this vertex
  float met_density;   // with which what the ray met is looked for
  vec3 looked;         // direction in which light is looked for,
  float looked_pdf;    // density of it by the vertex's own scattering,
  float look_density;  // and of looking
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  path.own.vertices = 0u;
  path.own.left = vec3(1.0);
  path.own.met_density = path.own.looked_pdf = path.own.look_density = 0.0;
  path.own.looked = vec3(0.0);
}
#endif
