// What the denoiser's passes share: where everything stands in the history buffer, how a texel of it is packed, and the
// factor that separates a surface's reflectance from the light that falls on it. After Schied 2017 (SVGF).
#ifndef FB_SHARED_DENOISE_H
#define FB_SHARED_DENOISE_H
#include "shared/bsdf.h"
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// The history buffer holds sections of four words a rendered pixel.
FB_CONST uint kSectionHistory =
    0u;  // and 1: HistoryTexel, this frame's and the last one's by FrameConstants::history_parity
FB_CONST uint kSectionFilter = 2u;   // and 3: FilterTexel, a wavelet's source and target in turns
FB_CONST uint kSectionLight = 4u;    // LightTexel[blocks], where light is not sampled at every pixel
FB_CONST uint kSectionPicture = 5u;  // half a section: PictureTexel[pixels]
// Behind it: two of uint[shown pixels], anti-aliased pictures by parity. First word of one of them.
FB_FN uint history_shown(uint pixels, uint shown, uint parity) {
  return 4u * (kSectionPicture * pixels + (pixels + 1u) / 2u) + parity * shown;
}
// Behind them, from a whole texel on, layers, one where there is a medium and one where there is water: each four times
// LayerTexel[blocks]. The first two are this frame's and the last one's by parity, the others a wavelet's source and
// target in turns. In texels.
FB_CONST uint kLayerSlots = 4u;
FB_FN uint first_layer(uint pixels, uint shown) { return (history_shown(pixels, shown, 2u) + 3u) / 4u; }

// Light may be below zero wherever it is stored. HistoryTexel: x: half2 irradiance r, g; y: half irradiance b, frames
// (8 bits), id (8 bits); z: half2 mean of luminance and root of its mean square; w: pack_surface of the geometric
// normal. FilterTexel: x: irradiance, pack_rgb9e5; y: half2 standard deviation of its luminance, what recent frames'
// mean luminance is above its; z: pack_surface of the shading normal, 0: nothing to filter; w: frames (8 bits), id (8
// bits), pack_coarse_normal of the geometric normal, kFilterLiquid. PictureTexel: x: half2 denoised radiance r, g; y:
// half b, above it how much of the history is to be kept, of 255. LightTexel: x, y as of HistoryTexel, without frames;
// z: pack_surface of the geometric normal, 0: no sample; w: 1 where the light is a guess. LayerTexel: x: half2 light r,
// g; y: half b, frames above it; z: pack_surface of where the light comes from; w: half2 mean of luminance and root of
// its mean square.

FB_CONST uint kFilterLiquid = 0x80000000u;  // in FilterTexel.w: the surface of a liquid
FB_CONST float kMaxIrradiance = 60000.0f;   // of a half, with room
FB_CONST float kMaxHalf = 65504.0f;
FB_CONST float kMaxDeviation = 30000.0f;
FB_CONST float kUnknownDeviation = 60000.0f;  // too few frames to tell
FB_CONST uint kMaxHistory = 255u;             // frames

// --- demodulation ---
// Radiance = emission + irradiance * factor. The factor is the albedo of the Lambert part plus the directional albedo
// of the coat, roughly: Schlick's reflectance at the viewer's angle, less where the coat is rough, whose masking
// swallows light. Any positive factor is exact as long as the same one multiplies again; a good one leaves little
// texture in the irradiance.
FB_CONST float kMinFactor = 1e-5f;  // below: the channel reflects nothing

FB_FN vec3 factor_or_nothing(vec3 x) {
  return vec3(x.x > kMinFactor ? x.x : 0.0f, x.y > kMinFactor ? x.y : 0.0f, x.z > kMinFactor ? x.z : 0.0f);
}
FB_FN vec3 demodulation_factor(vec3 albedo, float roughness, float specular, float metalness, float cos_view) {
  vec3 f0 = mix(vec3(specular), albedo, metalness);
  vec3 f = f0 + (vec3(1.0f) - f0) * (schlick_weight(cos_view) * (1.0f - 0.8f * roughness));
  float alpha = roughness * roughness;
  vec3 both = albedo * ((1.0f - metalness) * (1.0f - (f.x + f.y + f.z) / 3.0f)) + f * (1.0f - 0.8f * alpha * alpha);
  return factor_or_nothing(specular <= 0.0f && metalness <= 0.0f ? albedo : both);
}

// Where a channel reflects nothing its irradiance is unknown; the others' mean stands in, so that neighbours which do
// reflect it are not darkened. Remodulation multiplies it by the same nothing.
FB_FN vec3 demodulate(vec3 reflected, vec3 factor) {
  vec3 known = vec3(factor.x > 0.0f ? 1.0f : 0.0f, factor.y > 0.0f ? 1.0f : 0.0f, factor.z > 0.0f ? 1.0f : 0.0f);
  vec3 x = reflected * known / max(factor, vec3(kMinFactor));
  float count = known.x + known.y + known.z;
  float mean = (x.x + x.y + x.z) / max(count, 1.0f);
  return x + (vec3(1.0f) - known) * mean;
}

// --- samples and history ---
// What estimates with control variates find may be below zero; their mean is right only if nothing on its way cuts at
// zero. So bounds are on both sides, the same from the mean.

// Factor on a sample of luminance y, which brings it to its history's mean within so many standard deviations and a
// tenth of the mean. As a factor it keeps the sign: from zero up to the mean it is 1, and what is below zero where the
// mean is far above becomes zero.
FB_FN float firefly_cut(float y, float mean, float mean_square, float deviations) {
  float side = y < 0.0f ? -mean : mean;
  float limit = side + deviations * sqrt(max(mean_square - mean * mean, 0.0f)) + 0.1f * abs(mean);
  return clamp(limit / max(abs(y), 1e-12f), 0.0f, 1.0f);
}

// How much of the history is to be kept. Where recent frames are brighter or darker than what was gathered by more than
// their noise, the light has changed, and the next frames get more weight. `ahead`: by how much they are brighter; all
// three are means over the wavelet's footprint, so that a pixel's own noise does not decide.
FB_FN float history_trust(float luminance, float deviation, float ahead) {
  return clamp(2.0f - abs(ahead) / (4.0f * deviation + 0.1f * abs(luminance) + 1e-6f), 0.0f, 1.0f);
}

// --- packing ---
// Three numbers from -65,000 to 65,000 under one exponent: of 9 bits where none is below zero, else of 7 and a sign.
// `round` 0.5 rounds to nearest; a random number in [0, 1) rounds without bias, so that small steps add up.
//
// With signs a channel holds kSignedZero more than it has steps, which are four times as long. Such a word has no
// channel above kSignedMost and an exponent above the least, which a word without signs never has both: its largest
// channel is 255 at least, unless its exponent is the least. So signs need no bit, and words without them no change.
FB_CONST float kSignedZero = 127.0f, kSignedMost = 254.0f;
FB_FN uint pack_signed_rgb(vec3 c, float round) {
  float largest = max(max(abs(c.x), max(abs(c.y), abs(c.z))) * 1.008f, 0.0f);  // at most 127 steps
  uint biased = clamp(floatBitsToUint(largest) >> 23u, 112u, 142u);
  float scale = uintBitsToFloat((260u - biased) << 23u), zero = kSignedZero + round;
  uint r = uint(clamp(c.x * scale + zero, 0.0f, kSignedMost)), g = uint(clamp(c.y * scale + zero, 0.0f, kSignedMost));
  return r | (g << 9u) | (uint(clamp(c.z * scale + zero, 0.0f, kSignedMost)) << 18u) | ((biased - 111u) << 27u);
}
FB_FN uint pack_rgb9e5(vec3 c, float round) {
  if (min(c.x, min(c.y, c.z)) < 0.0f) return pack_signed_rgb(c, round);
  float largest = max(c.x, max(c.y, c.z)) * 1.002f;                                  // room for rounding up
  uint biased = clamp((floatBitsToUint(largest) & 0x7fffffffu) >> 23u, 111u, 142u);  // of -0 as of 0
  float scale = uintBitsToFloat((262u - biased) << 23u);                             // 2^(8 - exponent)
  uint r = uint(min(c.x * scale + round, 511.0f)), g = uint(min(c.y * scale + round, 511.0f));
  return r | (g << 9u) | (uint(min(c.z * scale + round, 511.0f)) << 18u) | ((biased - 111u) << 27u);
}
FB_FN vec3 unpack_rgb9e5(uint u) {
  // No channel has its ninth bit, not even with one step more.
  bool has_signs = ((u | (u + 0x00040201u)) & 0x04020100u) == 0u && u >= 0x08000000u;
  float scale = uintBitsToFloat(((u >> 27u) + (has_signs ? 105u : 103u)) << 23u), zero = has_signs ? kSignedZero : 0.0f;
  return vec3(float(u & 511u) - zero, float((u >> 9u) & 511u) - zero, float((u >> 18u) & 511u) - zero) * scale;
}

// 15 bits, not renormalised after unpacking: equal normals unpack equal.
FB_FN uint pack_coarse_normal(vec3 n) {
  uint x = uint(clamp(n.x, -1.0f, 1.0f) * 15.0f + 15.5f), y = uint(clamp(n.y, -1.0f, 1.0f) * 15.0f + 15.5f);
  uint z = uint(clamp(n.z, -1.0f, 1.0f) * 15.0f + 15.5f);
  return x | (y << 5u) | (z << 10u);
}
FB_FN vec3 unpack_coarse_normal(uint u) {
  return vec3(float(u & 31u), float((u >> 5u) & 31u), float((u >> 10u) & 31u)) * (1.0f / 15.0f) - vec3(1.0f);
}

// Where a surface is and how it stands: 15 bits of normal, and 16 of 1 / depth: five of exponent, from 2^-25 to 2^7,
// eleven of mantissa. Never 0.
FB_FN uint pack_surface(float inverse_depth, vec3 n) {
  uint bits = floatBitsToUint(clamp(inverse_depth, 3.0e-8f, 100.0f));
  uint depth = ((bits + 0x800u) - 0x33000000u) >> 12u;
  return (depth & 0xffffu) | (pack_coarse_normal(n) << 16u);
}
FB_FN float unpack_surface_inverse_depth(uint u) { return uintBitsToFloat(((u & 0xffffu) << 12u) + 0x33000000u); }
FB_FN vec3 unpack_surface_normal(uint u) { return unpack_coarse_normal(u >> 16u); }

FB_NAMESPACE_END
#endif
