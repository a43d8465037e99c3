// G-buffer: what the camera sees through each pixel: position, normals, colour, emission, motion, ids.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/gbuffer_texel.glsl"
#include "lib/pixel.glsl"
#include "lib/segment.glsl"
#include "lib/water_texel.glsl"

const GBufferTexel kNothingSeen = GBufferTexel(vec4(0.0), vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), 0u, 0u, 0u, 0u, vec4(0.0));

// The sky is beyond the medium, however near the face that shows it.
float seen_through_medium(Surface s, float distance) {
  if (!FEATURE_MEDIUM) return 1.0;
  return s.sky ? frame.medium_phase.z : transmittance(frame.camera_fog, distance);
}

// Even light that the medium scatters on the way: as much from every point, so without noise.
vec3 scattered_even_light(float distance) {
  return FEATURE_MEDIUM ? frame.medium.rgb * frame.ambient.rgb * opacity(frame.camera_fog, distance) : vec3(0.0);
}

void fill_texel(inout GBufferTexel texel, Surface s, Hit hit, vec2 point, float depth) {
  vec3 before = previous_pixel(previous_position(hit));
  texel.position_t = vec4(s.position, hit.t);
  texel.albedo_roughness = vec4(s.bsdf.albedo, sqrt(s.bsdf.alpha));
  // Even light is reflected here and nowhere else: no path brings it, so that it is the same in every estimator.
  texel.emission_specular = vec4((s.emission + s.bsdf.albedo * frame.ambient.rgb) * seen_through_medium(s, hit.t) + scattered_even_light(hit.t),
                                s.bsdf.specular);
  texel.normal = pack_direction(s.normal);
  texel.shading_normal = pack_direction(s.shading_normal);
  texel.id = instance_at(hit.instance).id;
  bool liquid = has_feature(kFeatureWarp) && (material_at(s.material).flags & kMaterialLiquid) != 0u;
  texel.material_metalness = s.material | (liquid ? kTexelLiquid : 0u) | (uint(s.bsdf.metalness * 255.0 + 0.5) << 24u);
  texel.motion = vec4(before.xy - point, depth, before.z);
}

// A surface at the end of a camera ray's segment. By way of an interface it is seen as Lambertian, and moves as if the water was
// level.
GBufferTexel texel_of(Surface s, Segment way, vec3 direction, vec2 point, float depth) {
  GBufferTexel texel;
  fill_texel(texel, s, way.hit, point, depth);
  texel.albedo_roughness.rgb *= way.left;
  texel.emission_specular.rgb *= way.left;
  if (way.bent || way.liquid != kNoIndex) texel.emission_specular.w = 0.0;
  if (!way.bent) return texel;
  vec3 moved = previous_position(way.hit) - s.position;
  vec3 before = previous_pixel(frame.camera_position.xyz + direction * way.seen + moved);
  texel.motion = vec4(before.xy - point, depth, before.z);
  texel.material_metalness = (texel.material_metalness & 0x7fffffu) | kTexelLiquid;
  return texel;
}

// Of the way that a camera's ray has gone.
LiquidPiece scattering_piece(Segment way, vec3 direction, Parting parting) {
  if (frame.camera_liquid != kNoIndex)
    return LiquidPiece(direction, way.bent ? parting.distance : way.hit.instance == kNoIndex ? kRayEnd : way.hit.t, 0.0, 1.0,
                       frame.camera_liquid, 1.0);
  if (!way.bent || parting.beyond == kNoIndex || material_at(parting.beyond & kNoMaterial).scattering <= 0.0) return kNoPiece;
  return LiquidPiece(parting.refracted, parting.within, parting.distance, parting.through, parting.beyond,
                     1.0 / medium_index(parting.beyond));
}

// What the camera sees where there is water: through the first interface that its ray meets, and mirrored in it. The surface of
// which a level interface shows more is the texel's own.
GBufferTexel see_by_water(uint at, vec3 ray, vec2 point, uint rng) {
  vec3 direction = normalize(ray), emission = vec3(0.0);
  GBufferTexel texel = kNothingSeen;
  WaterTexel water = WaterTexel(vec3(0.0), kNoIndex, kNoSecond, kNoIndex, 0u, 0u, false);
  Segment way = straight(frame.camera_position.xyz, direction, frame.camera_liquid);
  Parting parting = Parting(way, false, direction, kNoIndex, 1.0, 0.0, 0.0, way, 0.0);
  LiquidPiece piece = kNoPiece;
  bool back = false;
  do {
    way = follow(way, kRayEnd, kMaskCamera, kTurnThrough, true, parting, rng);
    if (!back && frame.turbid != 0u) piece = scattering_piece(way, direction, parting);
    bool missed = way.hit.instance == kNoIndex;
    GBufferTexel other = kNothingSeen;
    if (!missed || frame.sky_beyond != 0u) {
      way.hit.t = way.seen;  // for footprints and fog
      Surface s = load_surface(way.hit, way.direction, uint(frame.texture_filter), missed);
      other.emission_specular = vec4(s.emission * way.left * seen_through_medium(s, kRayEnd), 0.0);
      if (!missed) other = texel_of(s, way, direction, point, way.seen / length(ray));
    }
    emission += other.emission_specular.rgb;
    if (!back) {
      texel = other;
      water.own_liquid = way.liquid;
      water.bent = way.bent;
    } else if (!missed) {
      bool swaps = parting.mirrors_most || texel.position_t.w == 0.0;
      GBufferTexel second = swaps ? texel : other;
      texel = swaps ? other : texel;
      water.liquid = swaps ? water.own_liquid : way.liquid;
      water.own_liquid = swaps ? way.liquid : water.own_liquid;
      water.position = second.position_t.xyz;
      water.seen = second.position_t.w > 0.0 ? SecondTexel(second.albedo_roughness.rgb, second.motion.z, second.motion.w > 0.0 ? second.motion.xy : vec2(60000.0)) : kNoSecond;
      water.normal = second.normal;
      water.shading_normal = second.shading_normal;
      texel.albedo_roughness.rgb += water.seen.albedo;
    }
    if (!way.bent || back) break;
    back = true;
    way = parting.mirrored;
  } while (true);
  while (parting.opaque > 0.0) {  // a loop, which lavapipe passes by where no lane has it
    parting.skin.hit.t = parting.skin.seen;
    Surface s = load_surface(parting.skin.hit, direction, uint(frame.texture_filter), false);
    emission += s.emission * parting.skin.left * parting.opaque * seen_through_medium(s, parting.skin.seen);
    parting.opaque = 0.0;
  }
  store_water(at, water, piece);
  texel.emission_specular.rgb = emission + scattered_by(piece) * frame.ambient.rgb;
  return texel;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  uint rng = rng_seed(at, frame.frame, 0xffffffffu, frame.seed);

  vec2 point = vec2(pixel) + 0.5 + vec2(frame.jitter_x, frame.jitter_y);
  vec3 ray = camera_direction(point);
  if (FEATURE_WATER) {
    store_gbuffer(at, see_by_water(at, ray, point, rng));
    return;
  }
  vec3 direction = normalize(ray);
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);

  bool missed = hit.instance == kNoIndex;
  GBufferTexel texel = kNothingSeen;
  if (!missed || frame.sky_beyond != 0u) {
    Surface s = load_surface(hit, direction, uint(frame.texture_filter), missed);
    texel.emission_specular = vec4(s.emission * seen_through_medium(s, kRayEnd) + scattered_even_light(kRayEnd), 0.0);
    if (!missed) fill_texel(texel, s, hit, point, hit.t / length(ray));
  }
  store_gbuffer(at, texel);
}
