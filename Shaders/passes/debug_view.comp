// A buffer shown instead of the picture (r_debug). A pass of its own: lavapipe runs both sides of a branch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/exposure.glsl"
#include "lib/former.glsl"
#include "lib/pixel.glsl"
#include "lib/shown.glsl"
#include "shared/packing.h"
#include "shared/rng.h"
#include "shared/tone.h"

vec3 id_color(uint id) {
  uint h = hash_u32(id + 1u);
  return vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;
}

// Views of the denoiser; black where it is off.
vec3 denoiser_color(uint at, GBufferTexel g) {
  if (frame.denoise == 0u) return vec3(0.0);
  uvec4 past = history_quad(section(kSectionHistory + frame.history_parity) + at);
  vec2 moments = unpackHalf2x16(past.z);
  float frames = float((past.y >> 16u) & 0xffu);
  Reflector r = reflector(at, gbuffer_quad(at, 3u), camera_direction(vec2(invocation_pixel()) + 0.5));
  switch (frame.debug_view) {
    case kViewDeviation:
      return vec3(sqrt(max(moments.y * moments.y - moments.x * moments.x, 0.0)) / max(4.0 * moments.x, 1e-6));
    case kViewHistory:
      return vec3(log2(1.0 + frames) / 8.0);
    case kViewDisocclusion:
      return frames == 1.0  ? vec3(1.0, 0.0, 0.0)
             : frames < 4.0 ? vec3(1.0, 0.7, 0.0)
                            : vec3(0.2 * luminance(g.albedo_roughness.rgb) + 0.1);
    case kViewDenoised:
      return srgb_from_linear(filmic(demodulate(shown_radiance(at) - r.emission, r.factor) * 0.3 * exposure_now()));
    default:
      return srgb_from_linear(
          filmic(vec3(unpackHalf2x16(past.x), unpackHalf2x16(past.y & 0xffffu).x) * 0.3 * exposure_now()));
  }
}

// Pixels with samples that were not finite are red on this frame's picture in grey.
vec3 lost_color(uint at) {
  vec4 estimate = radiance.at[at];
  return estimate.w > 0.0 ? vec3(1.0, 0.0, 0.0)
                          : 0.5 * srgb_from_linear(filmic(vec3(luminance(estimate.rgb) * exposure_now())));
}

vec3 former_color(GBufferTexel g) {
  if (g.position_t.w == 0.0 || frame.previous_gbuffer == 0u) return vec3(0.0);
  FormerTexel former = former_texel(g, invocation_pixel());
  return former.known ? srgb_from_linear(former.texel.albedo_roughness.rgb) : vec3(1.0, 0.0, 0.0);
}

vec3 debug_color(uint at) {
  GBufferTexel g = gbuffer_at(at);
  switch (frame.debug_view) {
    case kViewNormal:
      return unpack_direction(g.normal) * 0.5 + 0.5;
    case kViewShadingNormal:
      return unpack_direction(g.shading_normal) * 0.5 + 0.5;
    case kViewAlbedo:
      return srgb_from_linear(g.albedo_roughness.rgb);
    case kViewEmission:
      return srgb_from_linear(filmic(g.emission_specular.rgb * exposure_now()));
    case kViewDepth:
      return vec3(exp2(-g.motion.z / 512.0));
    case kViewMotion:
      return vec3(g.motion.xy / 16.0 + 0.5, 0.5);
    case kViewInstance:
      return id_color(g.id);
    case kViewMaterial:
      return id_color(g.material_metalness & kTexelMaterial);
    case kViewGloss:
      return vec3(g.albedo_roughness.w, g.emission_specular.w, float(g.material_metalness >> 24u) / 255.0);
    case kViewRadiance:
      return srgb_from_linear(filmic(radiance.at[at].rgb * exposure_now()));
    case kViewDeviation:
    case kViewHistory:
    case kViewDisocclusion:
    case kViewDenoised:
    case kViewNoisy:
      return denoiser_color(at, g);
    case kViewFormer:
      return former_color(g);
    case kViewNotFinite:
      return lost_color(at);
    case kViewError: {
      float n = mean_radiance.at[at].w;
      float variance = n > 1.0 ? luminance(m2_radiance.at[at].rgb) / ((n - 1.0) * n) : 0.0;
      return vec3(sqrt(variance) / max(luminance(mean_radiance.at[at].rgb), 1e-6));
    }
    default:
      return vec3(0.0);  // a view of a technique that is not at work
  }
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  if (frame.technique_view != 0u) return;  // the technique's step `views` drew it
  ldr.at[at] = packUnorm4x8(vec4(debug_color(at), 1.0));
}
