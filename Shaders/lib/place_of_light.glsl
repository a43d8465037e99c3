// Where the light that a ray met is, for lobes that aim at it.
#ifndef FB_LIB_PLACE_OF_LIGHT
#define FB_LIB_PLACE_OF_LIGHT
#include "lib/incident.glsl"

const float kFarthest = 32767.9375;  // of a map's coordinates

// Light of the sky is a direction, from wherever it is seen: its target is as far off as a map's coordinates reach.
// What is seen by way of an interface is where it appears to be: along the direction in which the ray left, as far as
// it went (Ruppert 2020, Eq. 35); or, not `apparent`, where the interface sent it.
vec3 place_of_light(Incident incident, vec3 direction, bool apparent) {
  vec3 origin = incident.origin;
  float reach = incident.way.hit.t;
  if (FEATURE_WATER && incident.way.bent) {
    origin = apparent ? origin : incident.way.origin;
    direction = apparent ? direction : incident.way.direction;
    reach = apparent ? incident.way.distance : reach;
  }
  vec3 away = (kFarthest - origin * sign(direction)) / max(abs(direction), 1e-6);
  float end = min(away.x, min(away.y, away.z));
  return origin + direction * (incident.sky ? max(end, 0.0) : reach);
}
#endif
