// Light that a medium scatters to the camera before the surface that a pixel shows, fog or a liquid: paths whose first
// vertex is in it, at a distance that is sampled by transmittance, about a point that may glow (equi-angular, Kulla and
// Fajardo 2012) or, by techniques that learn, about where light came from in past frames. That point is drawn before
// and apart from all else, so that each path's density is of it alone.
#ifndef FB_LIB_MEDIUM_PATH
#define FB_LIB_MEDIUM_PATH
#include "lib/medium_distances.glsl"
#include "lib/path.glsl"
#include "lib/store_light.glsl"
#include "shared/color.h"

// Where the ray of a pixel ends: at its surface.
float medium_reach(GBufferTexel g) { return g.position_t.w > 0.0 ? g.position_t.w : kRayEnd; }

// A straight piece of the way on which light is scattered to the camera.
struct MediumPiece {
  vec3 origin, direction;
  float start, reach;
  uint liquid;
  vec3 extinction;
  float least;     // of the channels
  float square;    // of fog (Haze): positive, in place of extinction
  vec3 scattered;  // of what interacts, and the camera's share of it
};

// What a piece scatters at a distance, per unit, and what is left of it on the way to the camera.
vec3 scattered_at(MediumPiece p, float distance) {
  if (p.square > 0.0) {
    Haze haze = Haze(0.0, p.square);
    return p.scattered * (haze_density(haze, distance) * haze_left(haze, distance));
  }
  return p.scattered * transmittance(p.extinction, distance);
}

// What counts of the fog's light before what a pixel shows: less before the sky where the map or the player wants that.
float before_surface(GBufferTexel g) {
  if (frame.ambient.w >= 1.0) return 1.0;
  bool sky = g.position_t.w <= 0.0 || material_at(g.material_metalness & kTexelMaterial).emission_kind == kEmissionSky;
  return sky ? frame.ambient.w : 1.0;
}

MediumPiece fog_piece(vec3 direction, GBufferTexel g, float reach) {
  Haze haze = camera_haze();
  return MediumPiece(frame.camera_position.xyz, direction, 0.0, reach, kNoIndex, vec3(haze.linear), haze.linear,
                     haze.square, frame.medium.rgb * ((haze.square > 0.0 ? 1.0 : haze.linear) * before_surface(g)));
}

MediumPiece piece_of(LiquidPiece p, vec3 ray) {
  GpuMaterial m = material_at(p.liquid & kNoMaterial);
  vec3 extinction = extinction_of(m);
  return MediumPiece(frame.camera_position.xyz + ray * p.start, p.direction, p.start, p.reach, p.liquid, extinction,
                     min(extinction.r, min(extinction.g, extinction.b)), 0.0,
                     vec3(m.scattering * p.through * haze_left(camera_haze(), p.start)));
}

// Into the second section of `radiance`.
void light_in_medium(PathPixel p) {
  uint at = p.at;
  uvec2 pixel = p.pixel;
  vec3 ray = normalize(camera_direction(vec2(pixel) + 0.5 + jitter_of(pixel)));
  GBufferTexel g = gbuffer_at(at);
  float reach = medium_reach(g);
  MediumPiece fog = fog_piece(ray, g, reach), within = fog;
  float of_liquid = 0.0;  // probability of a path in it
  if (FEATURE_WATER) {
    LiquidPiece liquid = liquid_piece_at(at, ray);
    float there = luminance(scattered_by(liquid));
    if (there > 0.0) {
      within = piece_of(liquid, ray);
      of_liquid = there / (there + luminance(frame.medium.rgb) * haze_opacity(camera_haze(), reach));
    }
  }
  radiance.at[frame.width * frame.height + at] = vec4(0.0);
  bool guides = kLearns && frame.fog_guided > 0.0;
  if (of_liquid == 0.0 && fog.least + fog.square == 0.0) {
    if (guides) learn_distances(p.block, Distances(0.0, 0.0, 0.0, 0.0), vec3(0.0));
    return;
  }
  Distances known = Distances(0.0, 0.0, 0.0, 0.0);
  if (guides) {
    float mean =
        of_liquid > 0.0 ? within.start + mean_interaction(within.least, within.reach) : haze_mean(camera_haze(), reach);
    vec3 before = previous_pixel(frame.camera_position.xyz + ray * mean);
    known = former_distances(before.z > 0.0 ? before.xy : vec2(pixel) + 0.5);
  }
  vec3 sum = vec3(0.0), met = vec3(0.0);
  uint i = 0u;
  do {
    uint rng = rng_seed(at, frame.frame, uint(frame.spp) + i, frame.seed);
    MediumPiece piece = fog;
    float chance = 1.0;
    if (FEATURE_WATER) {
      bool in_liquid = rng_uniform(rng) < of_liquid;
      if (in_liquid) piece = within;
      chance = in_liquid ? of_liquid : 1.0 - of_liquid;
    }
    vec3 place;
    bool about = point_of_light(rng, place);
    DistanceMix distances =
        distance_mix(piece.least, piece.reach, about ? frame.fog_about : 0.0, place - piece.origin, piece.direction);
    distances.square = piece.square;
    if (guides) distances = guided_by(known, distances, piece.start);
    float distance = sample_distance(distances, rng_uniform(rng));
    Vertex v = medium_vertex(piece.origin + piece.direction * distance, -piece.direction, piece.liquid);
    Path path = path_of(p, i);
    path.factor = scattered_at(piece, distance) / max(pdf_distance(distances, distance) * chance, 1e-30);
    vec3 estimate = trace_path(v, path, rng);
    take_finite(estimate);
    estimate *= path.factor;
    sum += estimate;
    float far = piece.start + distance;
    met += luminance(estimate) * vec3(1.0, far, far * far);
  } while (++i < frame.spp);
  radiance.at[frame.width * frame.height + at] = vec4(sum / float(frame.spp), 0.0);
  if (guides) learn_distances(p.block, known, met / float(frame.spp));
}
#endif
