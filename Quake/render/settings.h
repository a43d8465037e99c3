// The renderer's settings: one row defines a setting: type, field, cvar, default, lowest, highest, help. The console's
// cvars (register_render_cvars) and the laboratory's --set both come from this table.
#pragma once

#include <string>

#include "console/console.h"
#include "render/gpu_scene.h"

// clang-format off
#define FB_RENDER_SETTINGS(X)                                                                                          \
  X(int, spp, "r_spp", 1, 1, 4096, "paths per pixel and frame")                                                        \
  X(int, bounces, "r_bounces", 2, 0, 64, "reflections a path may have; 0 shows what glows and nothing else")           \
  X(int, seed, "r_seed", 0, 0, 2147483647, "seed of the random numbers; the same seed gives the same picture")          \
  X(int, accumulate, "r_accumulate", 1, 0, 1, "average the frames of a view in which nothing changes")                 \
  X(int, jitter, "r_jitter", -1, -1, 1, "move the camera's rays within their pixel: -1 while accumulating and for r_taa, 0 never, 1 always") \
  X(float, scale, "r_scale", 1, 0.1f, 1, "rendered size over shown size")                                              \
  X(int, texture_filter, "r_texture_filter", 0, 0, 1, "texels seen by the camera: 0 nearest, 1 bilinear")              \
  X(int, auto_exposure, "r_autoexposure", 1, 0, 1, "follow the picture's brightness")                                  \
  X(float, exposure, "r_exposure", 1, 0.0001f, 10000, "factor on the exposure; all of it if r_autoexposure is 0")      \
  X(float, exposure_target, "r_exposure_target", 0.16f, 0.001f, 10, "what automatic exposure brings the mean luminance to") \
  X(float, exposure_time, "r_exposure_time", 0.7f, 0, 60, "seconds that automatic exposure takes to follow")           \
  X(int, tone_map, "r_tonemap", 1, 0, 1, "0 cuts at white, 1 a filmic curve")                                          \
  X(int, fxaa, "r_fxaa", 1, 0, 1, "smooth edges of the finished picture")                                              \
  X(int, denoise, "r_denoise", -1, -1, 1, "denoise the picture: -1 in the game, not in the laboratory; 0 never, 1 always") \
  X(float, svgf_alpha, "r_svgf_alpha", 0.04f, 0.004f, 1, "denoiser: least weight of a frame in what its predecessors gathered") \
  X(float, svgf_moments_alpha, "r_svgf_moments_alpha", 0.1f, 0.004f, 1, "denoiser: the same, for the luminance's moments") \
  X(int, svgf_levels, "r_svgf_levels", 5, 2, 6, "denoiser: levels of the wavelet, which averages at most 5^levels pixels") \
  X(float, sigma_depth, "r_svgf_sigma_depth", 0.5f, 0.01f, 100, "denoiser: distance from a pixel's plane that parts, over the distance along it") \
  X(float, sigma_normal, "r_svgf_sigma_normal", 64, 0, 10000, "denoiser: how sharply different normals part")          \
  X(float, sigma_luminance, "r_svgf_sigma_luminance", 4, 0.01f, 1000, "denoiser: difference of luminance that parts, in standard deviations") \
  X(float, svgf_mean_frames, "r_svgf_mean_frames", 256, 1, 1000000, "denoiser: accumulated frames from which on the raw mean has half of the weight") \
  X(float, firefly, "r_firefly", 0, 0, 1000, "denoiser: cuts samples that stand out by so many standard deviations from those before; 0 none") \
  X(int, taa, "r_taa", 1, 0, 1, "denoiser: anti-aliasing over time instead of r_fxaa")                                  \
  X(int, debug_view, "r_debug", 0, 0, 35, "show a buffer: 1 normals, 2 shading normals, 3 albedo, 4 emission, 5 depth, 6 motion, 7 ids, 8 materials, 9 roughness/specular/metalness, 10 this frame's radiance, 11 relative error; denoiser: 12 deviation, 13 history length, 14 disocclusion, 15 irradiance denoised, 16 as it came") \
  X(float, emit_fullbright, "r_emit_fullbright", 6, 0, 10000, "brightness of fullbright texels and glow images")      \
  X(float, emit_lava, "r_emit_lava", 8, 0, 10000, "brightness of lava")                                                \
  X(float, emit_slime, "r_emit_slime", 1, 0, 10000, "brightness of slime")                                             \
  X(float, emit_teleport, "r_emit_teleport", 4, 0, 10000, "brightness of teleporters")                                 \
  X(float, emit_sky, "r_emit_sky", 1, 0, 10000, "brightness of the sky")                                               \
  X(float, emit_sprite, "r_emit_sprite", 8, 0, 10000, "brightness of sprites")                                         \
  X(float, emit_particle, "r_emit_particle", 1, 0, 10000, "brightness of particles")                                   \
  X(float, emit_dlight, "r_emit_dlight", 1, 0, 10000, "brightness of moving lights: rockets, muzzle flashes")          \
  X(float, emit_entlight, "r_emit_entlight", 1, 0, 10000, "brightness of the map's point lights (r_entlights)")        \
  X(float, emit_sun, "r_emit_sun", 1, 0, 10000, "brightness of suns")                                                  \
  X(int, fast_build, "r_as_build", 0, 0, 1, "acceleration structures of ray queries: 0 fast to trace, 1 fast to build")\
  X(int, force_features, "r_force_features", 0, 0, 1, "keep in the shaders what the scene does not need, to measure it")
// clang-format on

namespace fb::render {

enum class Intersector { kAuto, kQuery, kBvh };

struct RenderSettings {
#define FB_FIELD(type, field, cvar, value, low, high, help) type field = value;
  FB_RENDER_SETTINGS(FB_FIELD)
#undef FB_FIELD
  std::string estimator = "pt";
  Intersector intersector = Intersector::kAuto;
};

// Emission factors by kind, as GpuScene wants them.
EmissionScales emission_scales(const RenderSettings& settings);

// Registers a cvar for every row, r_estimator and r_intersector.
void register_render_cvars(con::Console& console);
// The cvars' values now.
RenderSettings read_render_settings(const con::Console& console);

}  // namespace fb::render
