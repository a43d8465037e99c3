// Water's surface: a sum of six sines over (x, y) and time, whose frequencies are those of waves on deep water, omega =
// sqrt(gravity k) (Lamb 1932), with the derivatives in closed form. Lengths are Quake's units, times seconds.
//
// The wave vectors are whole numbers of cycles over a tile of 64 `size` and the frequencies whole numbers of cycles
// over 4096 periods of the longest wave, off from deep water's by 1e-4. So the whole part of a phase is dropped in
// integers, which are exact: space by the cell of `size` and the place in it, time as a fraction of those 4096 periods
// in 32 bits (wave_clock). What is left to round is x / size: as if a point was moved by half a spacing of its
// coordinates, by the same for all waves. The surface repeats after 64 sizes and 4096 periods: 4096 units and 48
// minutes for 64. Lengths grow by 1.6 and directions turn by the golden angle, so that no two waves repeat together
// sooner.
#ifndef FB_SHARED_WAVES_H
#define FB_SHARED_WAVES_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST float kWavePi = 3.14159265358979323846f;
FB_CONST float kWaveGravity = 800.0f;     // units/s^2, sv_gravity's default
FB_CONST float kWaveMaxSlope = 13.465f;   // of |slope| size / height, were all waves steepest at one point
FB_CONST float kWaveMeanSlope = 3.9364f;  // its root mean square

struct Waves {
  float height;  // the surface is within +- height of its mean; units
  float size;    // about that of the longest wave, positive; the shortest is a tenth of it; units
  uint clock;    // wave_clock of the time, in 2^-32 of 4096 periods
};
struct WaveState {
  float height;  // over the mean, units
  vec2 slope;    // derivatives of the height by x and y
  float rate;    // derivative of the height by time, units/s
};

// Cycles a second of a wave of this length.
FB_FN float wave_frequency(float size) { return sqrt(kWaveGravity / (2.0f * kWavePi * size)); }

#ifdef __cplusplus
// The clock of a time in seconds; the host's, since it takes a double to hold a time to the last bit of a phase.
inline uint wave_clock(double seconds, float size) {
  const double turns =
      seconds *
      std::sqrt(static_cast<double>(kWaveGravity) / (2 * 3.14159265358979323846 * static_cast<double>(size))) / 4096;
  return static_cast<uint>(static_cast<std::uint64_t>((turns - std::floor(turns)) * 0x1p32));  // 2^32 itself becomes 0
}
#endif

// Adds one wave. m: cycles over the tile along x and y; n: cycles over 4096 periods; offset: its phase at the origin,
// cycles; amplitude: its share of the height. cell + rest is the point in sizes.
FB_FN void wave_add(FB_INOUT(WaveState, sum), Waves w, uvec2 cell, vec2 rest, ivec2 m, int n, float offset,
                    float amplitude) {
  uint whole = (uint(m.x) * cell.x + uint(m.y) * cell.y) & 63u;  // of 64ths of cycles; unsigned, as it may wrap
  vec2 k = vec2(float(m.x), float(m.y)) * (1.0f / 64.0f);        // cycles over a size
  float cycles = float(whole) * (1.0f / 64.0f) + (k.x * rest.x + k.y * rest.y) + offset;
  cycles -= float((uint(n) * w.clock) >> 8u) * (1.0f / 16777216.0f);
  float phase = (cycles - floor(cycles + 0.5f)) * (2.0f * kWavePi);
  float a = amplitude * w.height, derivative = a * cos(phase) * (2.0f * kWavePi);  // by cycles
  sum.height += a * sin(phase);
  sum.slope += k * (derivative / w.size);
  sum.rate -= derivative * float(n) * (1.0f / 4096.0f) * wave_frequency(w.size);
}

// The surface over a point of the world.
FB_FN WaveState wave_state(Waves w, vec2 point) {
  vec2 at = vec2(point.x / w.size, point.y / w.size), low = vec2(floor(at.x), floor(at.y)), rest = at - low;
  uvec2 cell = uvec2(uint(int(low.x)), uint(int(low.y)));
  WaveState sum;
  sum.height = 0.0f;
  sum.slope = vec2(0.0f);
  sum.rate = 0.0f;
  // Amplitudes fall with k^1.2; they sum to 1.
  wave_add(sum, w, cell, rest, ivec2(60, 22), 4093, 0.13f, 0.44678f);
  wave_add(sum, w, cell, rest, ivec2(-95, 39), 5189, 0.71f, 0.25286f);
  wave_add(sum, w, cell, rest, ivec2(69, -148), 6543, 0.37f, 0.14493f);
  wave_add(sum, w, cell, rest, ivec2(79, 250), 8290, 0.92f, 0.08211f);
  wave_add(sum, w, cell, rest, ivec2(-363, -210), 10485, 0.55f, 0.04673f);
  wave_add(sum, w, cell, rest, ivec2(655, -145), 13261, 0.28f, 0.02659f);
  return sum;
}

// The unit normal, upwards.
FB_FN vec3 wave_normal(WaveState s) { return normalize(vec3(-s.slope.x, -s.slope.y, 1.0f)); }

FB_NAMESPACE_END
#endif
