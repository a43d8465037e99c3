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
  X(int, svgf_levels, "r_svgf_levels", 0, 0, 6, "denoiser: levels of the wavelet (at least 2), which average at most 5^levels pixels; 0: a sixtieth of the picture") \
  X(float, sigma_depth, "r_svgf_sigma_depth", 0.5f, 0.01f, 100, "denoiser: distance from a pixel's plane that parts, over the distance along it") \
  X(float, sigma_normal, "r_svgf_sigma_normal", 16, 0, 10000, "denoiser: how sharply different normals part")          \
  X(float, sigma_luminance, "r_svgf_sigma_luminance", 4, 0.01f, 1000, "denoiser: difference of luminance that parts, in standard deviations") \
  X(float, svgf_mean_frames, "r_svgf_mean_frames", 256, 1, 1000000, "denoiser: accumulated frames from which on the raw mean has half of the weight") \
  X(float, firefly, "r_firefly", 0, 0, 1000, "denoiser: cuts samples that stand out by so many standard deviations from those before; 0 none") \
  X(int, taa, "r_taa", 1, 0, 1, "denoiser: anti-aliasing over time instead of r_fxaa")                                  \
  X(int, debug_view, "r_debug", 0, 0, 30, "show a buffer: 1 normals, 2 shading normals, 3 albedo, 4 emission, 5 depth, 6 motion, 7 ids, 8 materials, 9 roughness/specular/metalness, 10 this frame's radiance, 11 relative error; denoiser: 12 deviation, 13 history length, 14 disocclusion, 15 irradiance denoised, 16 as it came; of path guiding 20 direction, 21 mean cosine, 22 weight, 23 samples, 24 level, 25 collisions, 26 age, 27 cache, 28 sampler used, 29 probability of guiding; 30 samples that were not finite") \
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
  X(int, deterministic, "r_deterministic", 0, 0, 1, "what estimators learn does not depend on the order of threads: the same picture in every run") \
  X(int, nee_candidates, "r_nee_candidates", 8, 1, 256, "next-event estimation: points of lights of which each vertex chooses one to look for") \
  X(int, mc_states, "r_mc_states", 1000000, 1024, 16777216, "path guiding: states in the table, 24 bytes each; rounded up to a power of two") \
  X(int, mc_cells, "r_mc_cells", 131072, 1024, 4194304, "path guiding: cells of the irradiance cache, 68 bytes each; rounded up to a power of two") \
  X(int, mc_accesses, "r_mc_accesses", 2, 1, 16, "path guiding: cells that a vertex takes states from; times r_mc_bucket this is the paper's N_mc") \
  X(int, mc_bucket, "r_mc_bucket", 4, 1, 16, "path guiding: states in a cell, a power of two; 1 is the paper's table") \
  X(float, mc_adaptive, "r_mc_adaptive", 0.7f, 0, 1, "path guiding: probability of the adaptive grid, else the static one") \
  X(float, mc_angle, "r_mc_angle", 0.6f, 0.01f, 45, "path guiding: adaptive cells are seen under this angle, degrees") \
  X(float, mc_pixels, "r_mc_pixels", 4, 0, 256, "path guiding: and are at least so many pixels wide") \
  X(float, mc_static_width, "r_mc_static", 64, 1, 4096, "path guiding: width of the static grid's cells, units") \
  X(float, mc_coarser, "r_mc_coarser", 0.3f, 0, 0.95f, "path guiding: probability of looking a level coarser, and again") \
  X(float, mc_share, "r_mc_share", 0.5f, 0, 1, "path guiding: probability of guiding where it is not learnt (1 - p_bsdf)") \
  X(int, mc_learn_share, "r_mc_learn_share", 1, 0, 1, "path guiding: learn the probability of guiding from second moments") \
  X(float, mc_share_min, "r_mc_share_min", 0, 0, 1, "path guiding: least probability of guiding that may be learnt") \
  X(float, mc_share_max, "r_mc_share_max", 0.7f, 0, 1, "path guiding: largest probability of guiding that may be learnt") \
  X(float, mc_alpha, "r_mc_alpha", 0.03f, 0.0001f, 1, "path guiding: smallest weight of a new sample in a state's averages (alpha_min)") \
  X(int, mc_count, "r_mc_count", 255, 1, 255, "path guiding: most samples that a state counts (N_max)") \
  X(float, mc_radius, "r_mc_radius", 8, 0.01f, 1024, "path guiding: size that a light is thought to have before it is known, units") \
  X(float, mc_power, "r_mc_power", 1, 0, 4, "path guiding: exponent of scores in the mixture's weights") \
  X(int, mc_share_score, "r_mc_score", 1, 0, 1, "path guiding: a state's score is its lobe's share of the light (0: the whole estimate, as in the paper)") \
  X(int, mc_in_world, "r_mc_world", 1, 0, 1, "path guiding: states keep their light's own extent and strength (0: as seen by the point that learnt them, as in the paper)") \
  X(int, mc_cache, "r_mc_cache", 1, 0, 1, "path guiding: learn reflected light too, from the irradiance cache") \
  X(float, mc_cache_alpha, "r_mc_cache_alpha", 0.15f, 0.001f, 1, "path guiding: least weight of a new frame in the irradiance cache; large follows changes, small is smooth") \
  X(float, mc_cache_pixels, "r_mc_cache_pixels", 8, 0, 256, "path guiding: least width of the cache's cells, pixels") \
  X(int, mc_train, "r_mc_train", 2, 1, 64, "path guiding: one in so many paths trains where much is known; new lights are never passed by") \
  X(int, mc_tail_train, "r_mc_tail_train", 8, 1, 64, "path guiding: mcpg_tail lets one in so many paths go on for a bounce more, so that the cache learns what the camera does not see") \
  X(int, mc_loss, "r_mc_loss", 1, 0, 1, "path guiding: discard states whose light is gone") \
  X(int, mc_predict, "r_mc_predict", 1, 0, 1, "path guiding: move targets on by the velocity of their light") \
  X(int, mc_previous, "r_mc_previous", 1, 0, 1, "path guiding: look states up where a moving surface was, too") \
  X(int, fast_build, "r_as_build", 0, 0, 1, "acceleration structures of ray queries: 0 fast to trace, 1 fast to build")\
  X(int, force_features, "r_force_features", 0, 0, 1, "keep in the shaders what the scene does not need, to measure it")
// clang-format on

namespace fb::render {

enum class Intersector { kAuto, kQuery, kBvh };
enum class ArrayAccess { kAuto, kBound, kAddress };

struct RenderSettings {
#define FB_FIELD(type, field, cvar, value, low, high, help) type field = value;
  FB_RENDER_SETTINGS(FB_FIELD)
#undef FB_FIELD
  std::string estimator = "pt";
  Intersector intersector = Intersector::kAuto;
  ArrayAccess arrays = ArrayAccess::kAuto;
  bool operator==(const RenderSettings&) const = default;
};

// Emission factors by kind, as GpuScene wants them.
EmissionScales emission_scales(const RenderSettings& settings);

// Registers a cvar for every row, r_estimator, r_intersector and r_arrays.
void register_render_cvars(con::Console& console);
// The cvars' values now.
RenderSettings read_render_settings(const con::Console& console);

}  // namespace fb::render
