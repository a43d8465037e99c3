// The G-buffer's texels by way of water and glass, in the tiles where some pixel shows an interface; everywhere if the
// camera is in a liquid.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/veil.glsl"
#include "lib/seen_texel.glsl"
#include "lib/water_tiles.glsl"
#include "lib/water_texel.glsl"

// A surface at the end of a camera ray's segment. By way of an interface it is seen as Lambertian, and moves as if the
// water was level.
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
  texel.material_metalness = (texel.material_metalness & (kTexelMaterial | kTexelGlows)) | kTexelLiquid;
  return texel;
}

// Of the way that a camera's ray has gone.
LiquidPiece scattering_piece(Segment way, vec3 direction, Parting parting) {
  if (frame.camera_liquid != kNoIndex)
    return LiquidPiece(direction,
                       way.bent                       ? parting.distance
                       : way.hit.instance == kNoIndex ? kRayEnd
                                                      : way.hit.t,
                       0.0, 1.0, frame.camera_liquid, 1.0);
  if (!way.bent || parting.beyond == kNoIndex || material_at(parting.beyond & kNoMaterial).scattering <= 0.0)
    return kNoPiece;
  return LiquidPiece(parting.refracted, parting.within, parting.distance, parting.through, parting.beyond,
                     1.0 / medium_index(parting.beyond));
}

// What the camera sees where there is water: through the first interface that its ray meets, and mirrored in it. The
// surface of which a level interface shows more is the texel's own. Of a veil, which has no interface about it, what is
// behind it stands in the place of what is mirrored, and the veil is the texel's own if it is glossy.
GBufferTexel see_by_water(uint at, vec3 ray, vec2 point, uint rng) {
  vec3 direction = normalize(ray), emission = vec3(0.0);
  GBufferTexel texel = kNothingSeen, other;
  WaterTexel water = kNoWater;
  Segment way = straight(frame.camera_position.xyz, direction, frame.camera_liquid);
  Parting parting = Parting(way, false, direction, kNoIndex, 1.0, 0.0, 0.0, way, 0.0);
  LiquidPiece piece = kNoPiece;
  bool back = false, veiled = false;
  float through = 0.0, own_share = 1.0;
  vec3 before = vec3(1.0);
  do {
    stops_at_veils = has_feature(kFeatureVeils) && !back;
    way = follow(way, kRayEnd, kMaskCamera, kTurnThrough, true, parting, rng);
    if (!back) {
      through = veil_lets_through(way.hit);
      veiled = through > 0.0;
      before = way.left;
      way.left *= 1.0 - through;
      own_share = 1.0 - through;
    }
    if (!back && frame.turbid != 0u) piece = scattering_piece(way, direction, parting);
    bool missed = way.hit.instance == kNoIndex;
    other = kNothingSeen;
    if (!missed || frame.sky_beyond != 0u) {
      way.hit.t = way.seen;  // for footprints and fog
      Surface s = load_seen_surface(way.hit, way.direction, missed);
      other.emission_specular = vec4(sky_seen(s).rgb * way.left, 0.0);
      if (!missed) other = texel_of(s, way, direction, point, way.seen / length(ray));
    }
    if (!back) {
      texel = other;
      emission = other.emission_specular.rgb;
      water.own_liquid = way.liquid;
      water.bent = way.bent || veiled;
    } else if (!missed) {
      bool glossy = texel.emission_specular.w > 0.0;
      bool most = veiled ? through > 0.5 && !glossy : parting.mirrors_most;
      bool swaps = most || texel.position_t.w == 0.0;
      GBufferTexel second = swaps ? texel : other;
      texel = swaps ? other : texel;
      water.liquid = swaps ? water.own_liquid : way.liquid;
      water.own_liquid = swaps ? way.liquid : water.own_liquid;
      water.position = second.position_t.xyz;
      water.seen = second.position_t.w > 0.0 ? SecondTexel(second.albedo_roughness.rgb, second.motion.z,
                                                           second.motion.w > 0.0 ? second.motion.xy : vec2(60000.0))
                                             : kNoSecond;
      water.normal = second.normal;
      water.shading_normal = second.shading_normal;
      texel.albedo_roughness.rgb += water.seen.albedo;
      if (swaps) own_share = through;
    }
    if (!(way.bent || veiled) || back) break;
    back = true;
    way = veiled ? beyond_veil(way, before, through) : parting.mirrored;
  } while (true);
  // Behind the loop: lavapipe adds again, for lanes that have left, what is added up before a `break`, unless an
  // optimizer went over the shader.
  if (back) emission += other.emission_specular.rgb;
  if (has_feature(kFeatureSkins) && parting.opaque > 0.0) {
    parting.skin.hit.t = parting.skin.seen;
    Surface s = load_seen_surface(parting.skin.hit, direction, false);
    emission += s.emission * parting.skin.left * parting.opaque * seen_through_medium(s, parting.skin.seen);
  }
  if (veiled) water.own_liquid = floatBitsToUint(own_share);
  store_water(at, water, piece);
  texel.emission_specular.rgb = emission + scattered_by(piece) * frame.ambient.rgb;
  return texel;
}

void main() {
  uvec2 pixel;
  if (!water_pixel(pixel) || pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  vec2 point = point_of(pixel);
  store_gbuffer(at, see_by_water(at, camera_direction(point), point, seen_rng(at)));
}
