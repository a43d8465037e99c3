// Where the level surface of a liquid, with waves, shows a sun: refracted to what is within it, and mirrored to what is
// above. The densities that directions are drawn with to look for it there.
//
// A surface of slope s (small) takes a sun from along S to a direction t whose horizontal part is
//   S.xy / n - g s,  g = cos_t - cos_s / n   within a liquid of index n (Snell; cosines at the level surface),
//   S.xy + g s,      g = 2 S.z               above it, where light comes from below.
// So the sun's disc and waves together are a blot in the plane of horizontal parts, where this is drawn with the
// density
//   p = 1 / (pi a^2 (1 + q^2)^2),   q = |t.xy - middle| / a,
// whose tail is long enough for what small slopes leave out; over solid angles it is p |t.z|. Its inverse CDF is
// q^2 = u / (1 - u).
#ifndef FB_SHARED_BENT_SUN_H
#define FB_SHARED_BENT_SUN_H
#include "shared/dielectric.h"
#include "shared/waves.h"
FB_NAMESPACE_BEGIN

// a is this of g times the waves' slope (root mean square), and of the disc's radius over n: what the variance of a
// sample was least with, for waves of slope 0.02 to 0.2 and for none.
FB_CONST float kBentSunWaves = 1.3f;
FB_CONST float kBentSunDisc = 0.7f;
FB_CONST float kIndexOfWater = 1.33f;

struct BentSun {
  vec2 middle;   // horizontal part of the direction in which a level surface shows it
  float spread;  // a; 0: it is below the horizon, and nothing is drawn
  float side;    // sign of the directions' height
};
FB_FN BentSun sun_blot(vec2 middle, float height, float waves, float radius, float side) {
  BentSun b;
  b.middle = middle;
  b.spread = height > 0.0f ? sqrt(waves * waves + radius * radius) : 0.0f;
  b.side = side;
  return b;
}
// `sun`: unit, towards it; `disc`: 1 - cosine of its radius; `slope`: of the waves, root mean square.
FB_FN BentSun refracted_sun(vec3 sun, float disc, float index, float slope) {
  float g = dielectric_cosine_beyond(max(sun.z, 0.0f), index) - sun.z / index;
  return sun_blot(vec2(sun.x / index, sun.y / index), sun.z, kBentSunWaves * g * slope,
                  kBentSunDisc * sqrt(2.0f * disc) / index, 1.0f);
}
FB_FN BentSun mirrored_sun(vec3 sun, float disc, float slope) {
  return sun_blot(vec2(sun.x, sun.y), sun.z, kBentSunWaves * 2.0f * sun.z * slope, kBentSunDisc * sqrt(2.0f * disc),
                  -1.0f);
}

// A direction, unit, from u uniform in [0, 1)^2; zero where the tail has none.
FB_FN vec3 bent_sun_sample(BentSun b, vec2 u) {
  float q = sqrt(u.x / (1.0f - u.x)) * b.spread, phi = 2.0f * kWavePi * u.y;
  vec2 t = vec2(b.middle.x + q * cos(phi), b.middle.y + q * sin(phi));
  float z2 = 1.0f - t.x * t.x - t.y * t.y;
  return z2 > 0.0f && b.spread > 0.0f ? vec3(t.x, t.y, b.side * sqrt(z2)) : vec3(0.0f);
}

// Per steradian.
FB_FN float bent_sun_pdf(BentSun b, vec3 direction) {
  if (b.spread <= 0.0f) return 0.0f;
  float x = (direction.x - b.middle.x) / b.spread, y = (direction.y - b.middle.y) / b.spread;
  float k = 1.0f + x * x + y * y;
  return max(direction.z * b.side, 0.0f) / (kWavePi * b.spread * b.spread * k * k);
}

FB_NAMESPACE_END
#endif
