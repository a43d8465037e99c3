// Every number that a user can set of the renderer: a row is a setting, from its cvar to the uniform field that shaders
// read.
//
//   X(type, field, cvar, default, lowest, highest, help)
//
// The host makes fields of RenderSettings and cvars of the rows (render/passes/settings.h), of these and of the
// techniques' (estimators/techniques.h), the laboratory its --set, and the manual its table (Misc/docs/settings.md,
// `make settings-page`). Shaders make uniform fields of the same rows, with the type float or int: the struct of a
// group names it.
#ifndef FB_SHARED_SETTINGS_H
#define FB_SHARED_SETTINGS_H

#define FB_UNIFORM_FIELD(type, field, cvar, value, low, high, help) type field;

// clang-format off
// Rows of FrameConstants, in every pass.
#define FB_FRAME_SETTINGS(X) \
  X(int, spp, "r_spp", 1, 1, 4096, "samples (paths) per pixel and frame") \
  X(int, bounces, "r_bounces", 2, 0, 64, "most reflections of a path; 0 shows emission alone") \
  X(int, medium_bounces, "r_fog_bounces", 1, 1, 8, "most rays of a path that fog scatters to the camera: 1 is light straight from what glows, 2 also what one surface reflects") \
  X(float, fog_about, "r_fog_about", 0.5f, 0, 1, "share of the distances in fog that are sampled about a light (equi-angular), where lights are looked for; the others by transmittance") \
  X(float, fog_guided, "r_fog_guided", 0.5f, 0, 0.9f, "estimators that learn: share of the distances in fog and in liquids that are sampled about those from which light came in past frames") \
  X(float, fog_scale, "r_fog_scale", 0.5f, 0.25f, 1, "with the denoiser: resolution of the light that fog scatters, of that of other light (r_light_scale); 1, 0.5 or 0.25") \
  X(int, seed, "r_seed", 0, 0, 2147483647, "seed of the random numbers; the same seed gives the same picture") \
  X(int, texture_filter, "r_texture_filter", -1, -1, 2, "filter of textures that camera rays hit: 0 nearest texel, 1 bilinear, 2 mean over the pixel; -1: 2 with the denoiser, else 0") \
  X(int, auto_exposure, "r_autoexposure", 1, 0, 1, "automatic exposure: adapt to the picture's mean luminance") \
  X(float, exposure, "r_exposure", 1, 0.0001f, 10000, "exposure: a factor on the automatic one; the whole exposure where r_autoexposure is 0") \
  X(float, exposure_target, "r_exposure_target", 0.16f, 0.001f, 10, "mean luminance that automatic exposure aims at") \
  X(float, exposure_time, "r_exposure_time", 1, 0, 60, "time constant of automatic exposure, seconds") \
  X(float, exposure_rest, "r_exposure_rest", 0.2f, 0, 4, "how far the picture may be from its exposure before that follows, stops: explosions and shots do not make it pump") \
  X(float, local_exposure, "r_local_exposure", -1, -1, 1, "local exposure: how much of the contrast between bright and dark parts of the picture is taken away, contrast within them is kept; -1: 0.35 in the game, 0 in the laboratory") \
  X(float, bloom, "r_bloom", -1, -1, 1, "bloom: share of the light that spreads about where it falls, as in a lens; -1: 0.04 in the game, 0 in the laboratory") \
  X(int, tone_map, "r_tonemap", 1, 0, 1, "tone mapping: 0 clamps at white, 1 is a filmic curve that keeps colours") \
  X(float, gamma, "gamma", 1, 0.25f, 4, "exponent of the finished picture with all that is drawn over it; below 1 is brighter") \
  X(float, contrast, "contrast", 1, 1, 2, "factor on the finished picture, before gamma") \
  X(int, fxaa, "r_fxaa", 1, 0, 1, "anti-alias the finished picture by FXAA (unless r_taa does)") \
  X(int, debug_view, "r_debug", 0, 0, last_debug_view(), "show a buffer in the place of the picture, by name or number; Misc/docs/settings.md lists them")

// Rows of FrameConstants, for the denoiser's passes.
#define FB_DENOISER_SETTINGS(X) \
  X(int, denoise, "r_denoise", -1, -1, 1, "denoiser: -1 on in the game and off in the laboratory, 0 off, 1 on") \
  X(float, svgf_alpha, "r_svgf_alpha", 0.04f, 0.004f, 1, "denoiser: least weight of the new frame when it is blended into the history of irradiance") \
  X(float, svgf_moments_alpha, "r_svgf_moments_alpha", 0.1f, 0.004f, 1, "denoiser: the same weight for the luminance's moments, of which the variance is estimated") \
  X(int, svgf_levels, "r_svgf_levels", 0, 0, 6, "denoiser: levels of the wavelet filter, 2 to 6; n levels average up to 5^n pixels; 0 chooses n so that this is at most a sixtieth of the picture") \
  X(float, sigma_depth, "r_svgf_sigma_depth", 0.5f, 0.01f, 100, "denoiser: edge stop by depth: distance off the pixel's plane, relative to the distance along it, at which neighbours stop mixing; larger blurs more") \
  X(float, sigma_normal, "r_svgf_sigma_normal", 16, 0, 10000, "denoiser: edge stop by normals: exponent of the cosine between two normals; larger keeps more edges") \
  X(float, sigma_luminance, "r_svgf_sigma_luminance", 4, 0.01f, 1000, "denoiser: edge stop by luminance: difference, in standard deviations, at which neighbours stop mixing; larger blurs more") \
  X(float, svgf_settle, "r_svgf_settle", 12, 1, 255, "denoiser: frames over which the edge stop by luminance comes in where a surface has come into sight; few samples say little of their deviation") \
  X(float, svgf_mean_frames, "r_svgf_mean_frames", 256, 1, 1000000, "denoiser: number of accumulated frames at which the raw mean makes up half of a still view's picture") \
  X(float, firefly, "r_firefly", 0, 0, 1000, "denoiser: clamp samples that exceed their pixel's history by this many standard deviations; 0 clamps none") \
  X(float, light_scale, "r_light_scale", 0, 0, 1, "denoiser: width and height at which light is sampled, relative to the rendered picture's: 1, 0.5 (one pixel of four a frame, in turns), 0.33 or 0.25; 0 is 0.5 where the device is a CPU, else 1") \
  X(int, first_spp, "r_first_spp", 4, 1, 64, "denoiser: samples of a frame that has no past (a map's start, a cut), times r_spp") \
  X(float, baked_past, "r_baked_past", 8, 0, 64, "denoiser: frames of history that the map's baked light counts as where a frame has no past (a map's start, a cut) and r_authored fits that light; 0: none") \
  X(int, taa, "r_taa", 1, 0, 1, "denoiser: temporal anti-aliasing, in the place of r_fxaa")

// Factors that the host multiplies into materials.
#define FB_EMISSION_SETTINGS(X) \
  X(float, emit_fullbright, "r_emit_fullbright", 6, 0, 10000, "emission of fullbright texels and of glow and luma images: factor") \
  X(float, emit_lava, "r_emit_lava", 8, 0, 10000, "emission of lava: factor") \
  X(float, emit_slime, "r_emit_slime", 1, 0, 10000, "emission of slime: factor") \
  X(float, emit_teleport, "r_emit_teleport", 4, 0, 10000, "emission of teleporters: factor") \
  X(float, emit_sky, "r_emit_sky", 1, 0, 10000, "emission of the sky: factor") \
  X(float, emit_sprite, "r_emit_sprite", 8, 0, 10000, "emission of sprites: factor") \
  X(float, emit_particle, "r_emit_particle", 1, 0, 10000, "emission of particles: factor") \
  X(float, emit_dlight, "r_emit_dlight", 1, 0, 10000, "emission of dynamic lights (rockets, muzzle flashes): factor") \
  X(float, emit_entlight, "r_emit_entlight", 1, 0, 10000, "emission of the map's light entities (r_entlights): factor") \
  X(float, emit_sun, "r_emit_sun", 1, 0, 10000, "emission of suns: factor")

// What the host alone reads.
#define FB_RENDERER_SETTINGS(X) \
  X(int, accumulate, "r_accumulate", 1, 0, 1, "while nothing in the view changes, show the mean of its frames") \
  X(int, jitter, "r_jitter", -1, -1, 1, "sub-pixel jitter of camera rays: -1 while accumulating and with r_taa, 0 never, 1 always, and elsewhere for every seed and (without denoiser) pixel") \
  X(float, scale, "r_scale", 1, 0.1f, 8, "rendered width and height, relative to the shown picture's, scaled up over time with r_taa; 2 and above, as in QuakeSpasm: 1 / 2 and so on") \
  X(int, water, "r_water", -1, -1, 1, "water and slime: 0 classic opaque or translucent surfaces that warp, 1 clear liquids that reflect, refract and absorb light; -1: 1 in the game on a GPU, else 0") \
  X(int, glass, "r_glass", 1, 0, 1, "what a .mat file names refractive: 1 a smooth interface of glass that reflects, refracts and absorbs light, 0 a surface like any other") \
  X(int, water_warp, "r_waterwarp", -1, -1, 2, "in water, slime and lava: 0 nothing, 1 waves distort the picture, 2 the field of view widens and narrows; -1: 1 in the game with r_water 0, where nothing else moves, else 0") \
  X(float, water_waves, "r_water_waves", 0.6f, 0, 8, "height of the waves of level surfaces of water, with r_water 1, units") \
  X(float, water_scatter, "r_water_scatter", 1, 0, 1, "share of what water, slime and glass scatter of the light within them, by their kind or their .mat file, that they do scatter; 0 leaves clear liquids") \
  X(float, water_g, "r_water_g", 0.5f, -0.999f, 0.999f, "how far ahead liquids and glass scatter light: mean cosine of their phase function (Henyey and Greenstein 1941); 0: evenly") \
  X(int, deterministic, "r_deterministic", 0, 0, 1, "learning estimators do not depend on the order of threads: the same picture in every run, at some cost") \
  X(int, fast_build, "r_as_build", 0, 0, 1, "acceleration structures of ray queries: 0 fast to trace, 1 fast to build") \
  X(int, force_features, "r_force_features", 0, 0, 1, "compile shader features that the scene does not use, to measure what specialisation saves")

// Techniques that sample the list of lights (lib/steps/direct_list.glsl).
#define FB_LIGHT_SETTINGS(X) \
  X(int, nee_candidates, "r_nee_candidates", 8, 1, 256, "next-event estimation: light samples a vertex draws of the list, of which (and of a sun) it chooses one to trace a shadow ray to") \
  X(int, nee_remembered, "r_nee_remembered", 4, 0, 256, "next-event estimation: how many of r_nee_candidates are drawn of the lamps that rays from hereabouts found in past frames, not of all; 0: light is chosen without memory of single lamps") \
  X(int, nee_visibility, "r_nee_visibility", 1, 0, 1, "next-event estimation: candidates are weighed by how many rays between the same two places arrived in past frames")
// clang-format on

#endif
