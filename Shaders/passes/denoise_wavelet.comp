// One level of the denoiser's edge-avoiding wavelet (Dammertz 2010, Schied 2017, Section 4.4). Departs from both in the
// kernel: a pixel and its four neighbours along a lattice that each level turns and stretches by 2 + i, so that after n
// levels 5^n pixels have been averaged without overlap, in 4 n fetches.
// LEVEL 0: the first; its result is also what the next frame finds as history. 2: the last; light meets the surface
// again, and what other layers have is added.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layers.glsl"

layout(push_constant) uniform Level {
  ivec2 lattice;  // this level's step, in pixels
  uint source, target;
}
level;

struct Tap {
  vec3 irradiance;
  float luminance, deviation, ahead, inverse_depth;
  bool known;  // its deviation
  vec3 normal, geometric;
  bool liquid;
};
Tap unpack_tap(uvec4 texel) {
  vec2 deviation_ahead = unpackHalf2x16(texel.y);
  Tap tap;
  tap.irradiance = unpack_rgb9e5(texel.x);
  tap.luminance = luminance_of(tap.irradiance);
  tap.deviation = deviation_ahead.x;
  tap.ahead = deviation_ahead.y;
  tap.inverse_depth = texel.z != 0u ? unpack_surface_inverse_depth(texel.z) : 0.0;
  tap.known = tap.deviation <= kMaxDeviation;
  tap.normal = unpack_surface_normal(texel.z);
  tap.geometric = unpack_coarse_normal(texel.w >> 16u);
  tap.liquid = (texel.w & kFilterLiquid) != 0u;
  return tap;
}

// How much two normals of each kind part two pixels. Surfaces that meet at an edge differ in both. A normal map alone
// parts at most so far that a pixel is never left to itself, least where one has no history; facets of a smooth mesh do
// not part.
const float kMapParts = 1.5, kMapPartsFresh = 0.3;
float parted(Tap a, Tap b) {
  vec3 turned = a.normal - b.normal, bent = a.geometric - b.geometric;
  float scale = 0.5 * frame.sigma_normal, shading = dot(turned, turned) * scale, edge = dot(bent, bent) * scale;
  return min(shading, edge) + min(max(shading - edge, 0.0), a.known && b.known ? kMapParts : kMapPartsFresh);
}

#if LEVEL == 2
// Light meets the surface again.
vec3 reflected_color(uint at, vec3 irradiance, vec3 ray) {
  uvec4 words = gbuffer_quad(at, 3u);
  Reflector r = reflector(at, words, ray);
  return r.emission + irradiance * r.factor;
}
#endif

const int kTaps = 4;

// About exp(-x), without the cost.
float falloff(float x) {
  float t = max(1.0 - 0.25 * x, 0.0), t2 = t * t;
  return t2 * t2;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  uint source = section(level.source);
  uvec4 texel = history_quad(source + at);
  Tap c = unpack_tap(texel);
  vec3 ray = camera_direction(vec2(pixel) + 0.5);
  vec2 slope = plane_slope(c.geometric, ray);  // a normal map tilts no plane
  ivec2 size = ivec2(frame.width, frame.height);
  // Distance from the plane is held against the distance along it.
  float pixel_size = 2.0 * length(frame.camera_right.xyz) / float(frame.width);
  float depth_scale =
      1.0 / (c.inverse_depth * frame.sigma_depth * length(vec2(level.lattice)) * (pixel_size + length(slope)) + 1e-12);

  Tap taps[kTaps];
  float shape[kTaps];
  float variance = c.deviation * c.deviation, pooled = c.known ? 1.0 : 1e-12;
  for (int i = 0; i < kTaps; ++i) {
    ivec2 offset = (i & 1) == 0 ? level.lattice : ivec2(-level.lattice.y, level.lattice.x);
    ivec2 p = clamp(ivec2(pixel) + (i < 2 ? offset : -offset), ivec2(0), size - 1);
    taps[i] = unpack_tap(history_quad(source + uint(p.y * size.x + p.x)));
    float expected = c.inverse_depth * (1.0 + dot(slope, vec2(p - ivec2(pixel))));
    shape[i] = abs(taps[i].inverse_depth - expected) * depth_scale + parted(taps[i], c);
    if (taps[i].inverse_depth == 0.0 || taps[i].liquid != c.liquid) shape[i] = 1e3;
    float weight = taps[i].known ? falloff(shape[i]) : 0.0;
    variance += weight * taps[i].deviation * taps[i].deviation;
    pooled += weight;
  }
  // A pixel's own variance is a poor estimate; what its neighbours on the surface have joins it, where it is known. A
  // pixel whose own is not takes whatever they have, and one that has been seen for few frames parts the less from
  // them: what its deviation has not met yet would stand alone.
  float frames = float(texel.w & 0xffu), settled = clamp((frames - 3.0) / frame.svgf_settle, 0.0, 1.0);
  float luminance_scale = c.known ? settled / (frame.sigma_luminance * sqrt(variance / pooled) + 1e-4) : 0.0;
  vec3 sum = c.irradiance;
  float weights = 1.0, squares = c.deviation * c.deviation, ahead = c.ahead;
  for (int i = 0; i < kTaps; ++i) {
    float weight = falloff(shape[i] + abs(taps[i].luminance - c.luminance) * luminance_scale);
    sum += weight * taps[i].irradiance;
    float deviation = taps[i].known ? taps[i].deviation : c.deviation;
    squares += weight * weight * deviation * deviation;
    ahead += weight * taps[i].ahead;
    weights += weight;
  }
  float deviation = c.known ? min(sqrt(squares) / weights, kMaxDeviation) : kUnknownDeviation;
  ahead /= weights;
  vec3 irradiance = c.inverse_depth == 0.0 ? vec3(0.0) : sum / weights;
#if LEVEL == 2
  vec3 color = reflected_color(at, irradiance, ray);
  if (WITH_MEDIUM) color += layer_color(medium_layer(), medium_there(at, ray), pixel, vec3(0.0));
  if (WITH_SECOND_SURFACES) color += layer_color(second_layer(), second_there(at, ray), pixel, irradiance);
  color = clamp(color, vec3(-kMaxHalf), vec3(kMaxHalf));
  uint kept = uint(255.0 * history_trust(luminance_of(irradiance), deviation, ahead) + 0.5);
  uint to = section(kSectionPicture) * 4u + 2u * at;
  history_words.at[to] = packHalf2x16(color.rg);
  history_words.at[to + 1u] = packHalf2x16(vec2(color.b, 0.0)) | (kept << 16u);
#else
  uint to = (section(level.target) + at) * 4u;
  history_words.at[to] = pack_rgb9e5(irradiance, 0.5);
  history_words.at[to + 1u] = packHalf2x16(vec2(deviation, ahead));
#if LEVEL == 0
  // While nothing moves the history is the plain mean, so that the picture converges.
  uint own = (section(kSectionHistory + frame.history_parity) + at) * 4u;
  vec3 kept = frame.still != 0u ? c.irradiance : irradiance;
  history_words.at[own] = packHalf2x16(kept.rg);
  history_words.at[own + 1u] = packHalf2x16(vec2(kept.b, 0.0)) | (texel.w << 16u);  // frames and id
#endif
#endif
}
