// What a probe's rays say of where it stands (after Majercik 2021): one that sees backs of surfaces is in a wall and
// moves out through the nearest, one that is close to a surface moves off it; where that is of no use it sleeps, and
// likewise where nothing is near. It has nothing to say until it has had a turn where it stands. Whether its light has
// changed all of a sudden is found here, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/ddgi/steps/probes.glsl"
#include "shared/color.h"

layout(local_size_x = 64) in;

const float kMostBacks = 0.25;   // of rays, of a probe that is in no wall
const float kLeastRoom = 0.2;    // between a probe and a surface, of the least spacing
const float kMostOffset = 0.45;  // of the spacing
const uint kAskedLately = 64u;   // frames
const float kLeastTurns = 2.0, kPerhaps = 0.05;

struct Around {
  float rays, backs;
  float back, front;         // distances of the nearest back and front of a surface,
  vec3 back_way, front_way;  // and where they are
  bool near;                 // some surface is in a cell that asks this probe
  float light, square;       // mean luminance of rays, and of its square
};

Around around(uint turn) {
  Around a = Around(0.0, 0.0, 1e30, 1e30, vec3(0.0), vec3(0.0), false, 0.0, 0.0);
  uint i = 0u, first = 2u * turn * ddgi.rays;
  do {
    vec4 ray = uintBitsToFloat(texelFetch(ddgi_ray_texels, int(first + 2u * i)));
    float light =
        luminance(uintBitsToFloat(texelFetch(ddgi_ray_texels, int(first + 2u * i + 1u)).rgb)) / (4.0 * kPiShared);
    a.light += light;
    a.square += light * light;
    if (i >= ddgi.looking) {
      float distance = abs(ray.w);
      a.rays += 1.0;
      if (ray.w < 0.0) {
        a.backs += 1.0;
        if (distance < a.back) {
          a.back = distance;
          a.back_way = ray.xyz;
        }
      } else {
        if (distance < a.front) {
          a.front = distance;
          a.front_way = ray.xyz;
        }
        a.near =
            a.near || (distance < ddgi.origin.w && all(lessThanEqual(abs(ray.xyz) * distance, 1.5 * ddgi.spacing.xyz)));
      }
    }
  } while (++i < ddgi.rays);
  a.light /= float(ddgi.rays);
  a.square /= float(ddgi.rays);
  return a;
}

void main() {
  uint turn = gl_GlobalInvocationID.x;
  if (turn >= ddgi.turns) return;
  uint probe = ddgi_turns.at[turn];
  vec3 offset = uintBitsToFloat(ddgi_probes.at[2u * probe].xyz);
  uvec4 record = ddgi_probes.at[2u * probe + 1u];
  Around a = around(turn);
  bool in_wall = a.backs > kMostBacks * a.rays;

  bool moved = false;
  float room = kLeastRoom * ddgi.spacing.w;
  uint moves = (record.x & ~kDdgiAsleep) / kDdgiMoves;
  if (ddgi.ddgi_relocate != 0 && moves < kDdgiMostMoves) {
    vec3 to = offset;
    if (in_wall)
      to += a.back_way * (a.back + 0.5 * room);
    else if (a.front < 0.9 * room)
      to -= a.front_way * (room - a.front);
    moved = to != offset && all(lessThanEqual(abs(to), kMostOffset * ddgi.spacing.xyz));
    // Through no wall of the map.
    uint leaf = leaf_at(place_of_cell(cell_of_probe(probe)) + to);
    moved = moved && (ddgi.row_words == 0u || (leaf != 0u && may_ask(leaf, probe)));
    if (moved) ddgi_probes.at[2u * probe].xyz = floatBitsToUint(to);
  }

  float updates = float(record.x & kDdgiUpdates), known = uintBitsToFloat(record.w);
  float error = sqrt(max(a.square - a.light * a.light, 0.0) / float(ddgi.rays));
  bool changed = ddgi.ddgi_change > 0.0 && updates >= kLeastTurns &&
                 abs(a.light - known) > ddgi.ddgi_change * error + kPerhaps * known;
  updates = moved ? 0.0 : changed ? 1.0 : min(updates + 1.0, 1000.0);
  bool asked = record.z != 0u && ddgi.frame_number - record.z <= kAskedLately;
  bool asleep = ddgi.ddgi_sleep != 0 && !moved && (in_wall || (!a.near && !asked));
  float share = updates > 0.0 ? max(1.0 / updates, 1.0 - ddgi.ddgi_hysteresis) : 1.0;
  ddgi_probes.at[2u * probe + 1u] =
      uvec4(uint(updates) | (moves + (moved ? 1u : 0u)) * kDdgiMoves | (asleep ? kDdgiAsleep : 0u), ddgi.frame_number,
            record.z, floatBitsToUint(mix(known, a.light, share)));
}
