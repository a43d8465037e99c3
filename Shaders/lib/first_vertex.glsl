// The first vertex of a pixel's paths: what the camera sees there. The technique's step `learning` (kFollowsMotion)
// comes before.
#ifndef FB_LIB_FIRST_VERTEX
#define FB_LIB_FIRST_VERTEX
#include "lib/gbuffer_texel.glsl"
#include "lib/interaction.glsl"
#include "lib/pixel.glsl"

// Where what a texel shows was in the former frame, within rounding; its position itself where that frame's camera had
// it behind it.
vec3 former_world(GBufferTexel g, vec2 point) {
  if (g.motion.w <= 0.0) return g.position_t.xyz;
  vec2 s = (point + g.motion.xy) / vec2(frame.width, frame.height) * 2.0 - 1.0;
  vec3 ray = frame.prev_camera_forward.xyz + s.x * frame.prev_camera_right.xyz - s.y * frame.prev_camera_up.xyz;
  return frame.prev_camera_position.xyz + ray * g.motion.w;
}
// The same; its position itself unless it moved perceptibly.
vec3 previous_world(GBufferTexel g, vec2 point) {
  vec3 before = former_world(g, point);
  return distance(before, g.position_t.xyz) > 0.25 + 1e-3 * g.position_t.w ? before : g.position_t.xyz;
}

Vertex first_vertex(GBufferTexel g, uvec2 pixel) {
  Vertex v;
  v.position = g.position_t.xyz;
  v.previous = v.position;
  if (kFollowsMotion) v.previous = previous_world(g, vec2(pixel) + 0.5 + jitter_of(pixel));
  v.liquid = kNoIndex;
  v.glows = (g.material_metalness & kTexelGlows) != 0u;
  v.view = normalize(frame.camera_position.xyz - v.position);
  v.scatter.medium = false;
  v.scatter.phase = kNoPhase;
  v.scatter.normal = unpack_direction(g.normal);
  v.scatter.shading_normal = unpack_direction(g.shading_normal);
  v.scatter.bsdf = Bsdf(g.albedo_roughness.rgb, max(g.albedo_roughness.w * g.albedo_roughness.w, kMinAlpha),
                        g.emission_specular.w, float(g.material_metalness >> 24u) / 255.0);
  return v;
}
#endif
