// The way of light between two vertices of a path. In air it is a ray; a smooth interface of water or glass does not
// end it but bends it: at each the ray is reflected or refracted (Fresnel, Snell; shared/dielectric.h), by the normal
// of waves (shared/waves.h) where a liquid's surface is level, and what is behind absorbs on the way. Light that
// reaches a vertex along a bent segment no straight ray finds: interfaces are opaque to rays that look for light, so
// that met emission counts whole there and nowhere twice.
//
// Radiance is not scaled by the index squared: all of it is basic radiance, L / n^2, which an interface leaves alone,
// and what glows or reflects under water is taken to do so in these units.
#ifndef FB_LIB_SEGMENT
#define FB_LIB_SEGMENT
#include "lib/interaction.glsl"
#include "shared/dielectric.h"
#include "shared/waves.h"

const uint kMostInterfaces = 32u;  // of a segment; the next one ends it, as if it was opaque
const float kLeastFacing = 0.01;   // cosine to which a wave's normal is turned that faces away from the ray

struct Segment {
  Hit hit;         // what ends it
  vec3 origin;     // of its last piece
  vec3 direction;  // of its last piece
  vec3 left;       // share of the light at its end that it brings
  uint liquid;     // that its end is in (lib/interaction.glsl)
  bool bent;       // by an interface
  float mirrored;  // the share that the first one reflects, if it did; else 0
  float distance;  // along all pieces
  float seen;      // at which its end appears through a level surface, along the first direction
  bool certain;    // no chance let it pass what is translucent
};

// Which way an interface takes a ray.
const uint kTurnByChance = 0u;  // reflected or refracted as often as much is
const uint kTurnThrough =
    1u;  // the first one refracts a camera's ray, whose `left` has the share. Those after it by chance
const uint kTurnNowhere = 2u;  // interfaces end it
const uint kTurnBack = 3u;     // the first one reflects it, and `left` has the share. Those after it by chance

struct Interface {
  vec3 position;
  vec3 facing;  // geometric normal on the ray's side
  vec3 normal;  // with waves; faces the ray as well
  bool enters;  // the ray comes from outside
};

// What was hit bends light.
bool is_interface(Hit hit) {
  if (hit.instance == kNoIndex) return false;
  GpuInstance instance = instance_at(hit.instance);
  GpuAttribute a = attribute_at(instance.first_attribute + hit.triangle);
  return (a.flags & kTriangleDielectric) != 0u &&
         (material_at(instance.material_base + a.material).flags & kMaterialDielectric) != 0u;
}

Interface interface_at(Hit hit, GpuAttribute a, bool waves, vec3 direction) {
  GpuTriangle t = world_triangle(hit.instance, hit.triangle);
  Interface i;
  i.position = t.v0.xyz + t.e1.xyz * hit.bary.x + t.e2.xyz * hit.bary.y;
  vec3 front = normalize(cross(t.e1.xyz, t.e2.xyz));
  bool from_front = dot(front, direction) < 0.0;
  i.facing = from_front ? front : -front;
  i.enters = from_front == ((a.flags & kTriangleLiquidInFront) == 0u);
  vec3 n = i.facing;
  if (has_feature(kFeatureSmooth) && (a.flags & kTriangleSmooth) != 0u) {
    vec3 smooth_one = smooth_normal(hit.instance, a, hit.bary);
    if (dot(smooth_one, smooth_one) > 0.0) n = to_world_normal(hit.instance, smooth_one);
  }
  if (waves && abs(n.z) > 0.9) {
    vec2 slope = wave_state(Waves(frame.water_height, frame.water_size, frame.water_clock), i.position.xy).slope;
    n = normalize(vec3(n.xy / n.z - slope, 1.0));
  }
  if (dot(n, i.facing) < 0.0) n = -n;
  float cosine = -dot(n, direction);
  if (cosine < kLeastFacing) n = normalize(n - direction * (kLeastFacing - cosine));
  i.normal = n;
  return i;
}

// A direction on the side of the surface that `facing` is on, by mirroring it where a wave's normal sends it to the
// other.
vec3 kept_on_side(vec3 direction, vec3 facing) {
  float side = dot(direction, facing);
  return normalize(direction + facing * (side < 0.0 ? -2.0 * side : 0.0) + facing * (abs(side) < 1e-3 ? 2e-3 : 0.0));
}

Segment straight(vec3 origin, vec3 direction, uint liquid) {
  return Segment(Hit(0.0, vec2(0.0), kNoIndex, 0u), origin, direction, vec3(1.0), liquid, false, 0.0, 0.0, 0.0, true);
}

// What becomes of a camera's ray at the first interface that it meets.
struct Parting {
  Segment mirrored;   // starts there, to be followed on
  bool mirrors_most;  // a level surface reflects more than it lets through
  vec3 refracted;     // direction behind it
  uint beyond;        // what is there, as Vertex::liquid
  float through;      // share that is let through
  float distance;     // to it
  float within;       // from there to what is next behind it
  Segment skin;       // up to it,
  float opaque;       // of which this share ends there and sees it glow. The others' `left` is of the rest
};

// A piece of the way is behind. `nearer`: of what it looks like, through a level surface.
void pass_piece(inout Segment s, float piece, float nearer, bool of_camera) {
  if (s.liquid != kNoIndex || !of_camera) s.left *= light_left(s.liquid, piece);
  s.distance += piece;
  s.seen += piece * nearer;
}

// A piece of a way, and whether it passed nothing translucent.
Hit trace_piece(vec3 origin, vec3 direction, float reach, uint mask, inout bool certain, inout uint rng) {
  passed_at = kRayEnd;
  Hit hit = trace(origin, direction, 0.0, reach, mask, rng);
  certain = certain && !(passed_at < (hit.instance == kNoIndex ? kRayEnd : hit.t));
  return hit;
}

// Follows a segment on from where it is. `s.left` is without the fog before what a camera sees: the denoiser knows of
// that.
//
// The last piece is passed behind the loop: what lavapipe (Mesa 22 and 25) multiplies up before a `break` it multiplies
// again for lanes that have left, while others go on.
Segment follow(Segment s, float reach, uint mask, uint turn, bool of_camera, inout Parting parting, inout uint rng) {
  float nearer = 1.0;
  uint events = 0u;
  do {
    s.hit = trace_piece(s.origin, s.direction, reach, mask, s.certain, rng);
    if (s.hit.instance == kNoIndex || turn == kTurnNowhere || events == kMostInterfaces) break;
    GpuAttribute a = attribute_at(instance_at(s.hit.instance).first_attribute + s.hit.triangle);
    if ((a.flags & kTriangleDielectric) == 0u) break;

    uint material = instance_at(s.hit.instance).material_base + a.material;
    GpuMaterial m = material_at(material);
    if ((m.flags & kMaterialDielectric) == 0u) break;  // as r_water and r_glass say
    bool first_of_camera = turn == kTurnThrough && !s.bent;
    if (has_feature(kFeatureSkins) && m.opaque_share > 0.0 && !first_of_camera && rng_uniform(rng) < m.opaque_share)
      break;
    pass_piece(s, s.hit.t, nearer, of_camera);
    if (turn == kTurnThrough && events == 1u) parting.within = s.hit.t;
    Interface i = interface_at(s.hit, a, (m.flags & kMaterialLiquid) != 0u, s.direction);
    // Which side the ray is on the surface says, whatever is known of the way so far.
    uint outside = i.enters ? s.liquid : medium_around(s.liquid);
    uint inside = medium_within(outside, material);
    uint here = i.enters ? outside : inside, beyond = i.enters ? inside : outside;
    float eta = medium_index(beyond) / medium_index(here);
    float reflectance = dielectric_reflectance(min(-dot(s.direction, i.normal), 1.0), eta);
    bool back = rng_uniform(rng) < reflectance;
    vec3 reflected = kept_on_side(dielectric_reflect(-s.direction, i.normal), i.facing);
    if (first_of_camera) {
      parting.skin = s;
      parting.opaque = has_feature(kFeatureSkins) ? m.opaque_share : 0.0;
      s.left *= 1.0 - parting.opaque;
      parting.mirrored = Segment(s.hit, offset_origin(i.position, i.facing), reflected, s.left * reflectance, here,
                                 true, reflectance, s.distance, s.seen, s.certain);
      parting.mirrors_most = dielectric_reflectance(min(-dot(s.direction, i.facing), 1.0), eta) > 0.5;
      parting.through = (1.0 - reflectance) * (1.0 - parting.opaque);
      parting.distance = s.distance;
      parting.beyond = beyond;
      s.left *= 1.0 - reflectance;
      back = false;
    }
    if (turn == kTurnBack && !s.bent) {
      s.left *= reflectance;
      back = true;
    }
    if (!s.bent) s.mirrored = back ? reflectance : 0.0;
    vec3 side = back ? i.facing : -i.facing;
    s.direction = back ? reflected : kept_on_side(dielectric_refract(-s.direction, i.normal, eta), side);
    s.origin = offset_origin(i.position, side);
    s.liquid = back ? here : beyond;
    if (turn == kTurnThrough && !s.bent) parting.refracted = s.direction;
    s.bent = true;
    nearer = back ? nearer : nearer / eta;
    reach = kRayEnd;
  } while (events++ < kMostInterfaces);
  float piece = s.hit.instance == kNoIndex ? kRayEnd : s.hit.t;
  pass_piece(s, piece, nearer, of_camera);
  if (turn == kTurnThrough && events == 1u) parting.within = piece;
  return s;
}

// From a point, which need not be a vertex, in a liquid or not: a path's own direction, or where `turn` is kTurnNowhere
// one that looks for light.
Segment segment_of(vec3 origin, uint liquid, vec3 direction, float reach, uint turn, inout uint rng) {
  Parting unused;
  if (FEATURE_WATER) return follow(straight(origin, direction, liquid), reach, kMaskIndirect, turn, false, unused, rng);
  bool certain = true;
  Hit hit = trace_piece(origin, direction, reach, kMaskIndirect, certain, rng);
  return Segment(hit, origin, direction, light_left(kNoIndex, hit.instance == kNoIndex ? kRayEnd : hit.t), kNoIndex,
                 false, 0.0, hit.t, hit.t, certain);
}
Segment segment_from(Vertex v, vec3 direction, float reach, uint turn, inout uint rng) {
  return segment_of(scatter_origin(v.scatter, v.position), v.liquid, direction, reach, turn, rng);
}

// It leaves the scene where no sky is.
bool ends_in_darkness(Segment segment) { return segment.hit.instance == kNoIndex && frame.sky_beyond == 0u; }

// The vertex at a segment's end. A coat has next to no reflectance where it borders on water or glass.
Vertex end_of_segment(Segment segment, Surface s) {
  Vertex v = surface_vertex(s, -segment.direction);
  v.liquid = segment.liquid;
  if (FEATURE_WATER && segment.liquid != kNoIndex) v.scatter.bsdf.specular = 0.0;
  return v;
}
#endif
