// Where a sun is seen from within a liquid with a level surface of waves: the density that directions are drawn with to
// look for it there.
//
// A surface of slope s (small) takes a sun from along S to the direction t within the liquid, whose horizontal part is
// S.xy / n - g s, with n the liquid's index and g = cos_t - cos_s / n for the level surface (Snell). So sun's disc and
// waves together are a blot about S.xy / n in the plane of horizontal parts, where this is drawn with the density
//   p = 1 / (pi a^2 (1 + q^2)^2),   q = |t.xy - S.xy / n| / a,
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

struct BentSun {
  vec2 middle;   // horizontal part of the direction in which a level surface shows it
  float spread;  // a; 0: it is below the horizon, and nothing is drawn
};
// `sun`: unit, towards it; `disc`: 1 - cosine of its radius; `slope`: of the waves, root mean square.
FB_FN BentSun bent_sun(vec3 sun, float disc, float index, float slope) {
  BentSun b;
  b.middle = vec2(sun.x / index, sun.y / index);
  float g = dielectric_cosine_beyond(max(sun.z, 0.0f), index) - sun.z / index;
  float waves = kBentSunWaves * g * slope, radius = kBentSunDisc * sqrt(2.0f * disc) / index;
  b.spread = sun.z > 0.0f ? sqrt(waves * waves + radius * radius) : 0.0f;
  return b;
}

// A direction upwards, unit, from u uniform in [0, 1)^2; zero where the tail has none.
FB_FN vec3 bent_sun_sample(BentSun b, vec2 u) {
  float q = sqrt(u.x / (1.0f - u.x)) * b.spread, phi = 2.0f * kWavePi * u.y;
  vec2 t = vec2(b.middle.x + q * cos(phi), b.middle.y + q * sin(phi));
  float z2 = 1.0f - t.x * t.x - t.y * t.y;
  return z2 > 0.0f && b.spread > 0.0f ? vec3(t.x, t.y, sqrt(z2)) : vec3(0.0f);
}

// Per steradian.
FB_FN float bent_sun_pdf(BentSun b, vec3 direction) {
  if (b.spread <= 0.0f) return 0.0f;
  float x = (direction.x - b.middle.x) / b.spread, y = (direction.y - b.middle.y) / b.spread;
  float k = 1.0f + x * x + y * y;
  return max(direction.z, 0.0f) / (kWavePi * b.spread * b.spread * k * k);
}

FB_NAMESPACE_END
#endif
