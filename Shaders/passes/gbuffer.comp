// G-buffer: what the camera sees through each pixel: position, normals, colour, emission, motion, ids. Where it sees an
// interface of water or glass the pass behind this one says what (gbuffer_water.comp): lavapipe would run its code at
// every pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/veil.glsl"
#include "lib/seen_texel.glsl"
#include "lib/water_tiles.glsl"
#include "lib/water_texel.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, rng = seen_rng(at);
  vec2 point = point_of(pixel);
  vec3 ray = camera_direction(point), direction = normalize(ray);
  stops_at_veils = has_feature(kFeatureVeils);
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);

  bool missed = hit.instance == kNoIndex;
  if (shows_two()) {
    if (is_interface(hit) || veil_lets_through(hit) > 0.0) add_water_tile(gl_WorkGroupID.xy);
    store_water(at, kNoWater, kNoPiece);
  }
  GBufferTexel texel = kNothingSeen;
  if (!missed || frame.sky_beyond != 0u) {
    Surface s = load_seen_surface(hit, direction, missed);
    texel.emission_specular = sky_seen(s);
    if (!missed) fill_texel(texel, s, hit, point, hit.t / length(ray));
  }
  store_gbuffer(at, texel);
}
