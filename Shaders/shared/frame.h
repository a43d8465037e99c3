// What a frame's passes share: the uniform block and the elements of the frame's arrays (shared/bindings.h).
#ifndef FB_SHARED_FRAME_H
#define FB_SHARED_FRAME_H
#include "shared/common.h"
#include "shared/debug_views.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kCounterNan = 0u;         // samples that were NaN or infinite; they count as zero
FB_CONST uint kCounterGuideNan = 1u;    // states of the guide that were not finite; they were not stored
FB_CONST uint kCounterHistory = 8u;     // irradiances that were not finite and never entered the denoiser's history
FB_CONST uint kCounterFirstWork = 16u;  // of two frames (shared/work.h)
FB_CONST uint kCounterCount = 40u;
FB_CONST uint kHistogramBins = 128u;
FB_CONST uint kDrawTile = 32u;  // output pixels a side

FB_CONST uint kMaxSuns = 4u;

// std140-compatible: vec4s, then scalars. Settings are as set, but for those that their reader resolves (denoise, taa).
struct FrameConstants {
  vec4 camera_position;  // w: tan of half a pixel's angle (footprints)
  vec4 camera_forward;
  vec4 camera_right;  // times tan(fov_x / 2)
  vec4 camera_up;     // times tan(fov_y / 2)
  vec4 prev_camera_position;
  vec4 prev_camera_forward;
  vec4 prev_camera_right;
  vec4 prev_camera_up;
  vec4 sky_color;         // factor or radiance; w: time in seconds, modulo what keeps it exact
  vec4 sky_even;          // radiance besides, that the camera does not see
  vec4 sun_direction[4];  // w: 1 - cosine of the angular radius
  vec4 sun_radiance[4];   // w: sum of the channels, with the sky's factor
  vec4 ambient;           // rgb: radiance from everywhere, of what the camera sees alone; w: factor on what the medium
                          // scatters to the camera before the sky
  vec4 medium;            // rgb: albedo; w: extinction, 1/unit, 0: there is no medium
  vec4 medium_phase;  // xy: g and alpha of its phase function; z: share of the sky's light that it lets the camera see;
                      // w: g of liquids
  vec4 fog_glow;      // rgb: radiance of the fog itself where it hides all; w: factor on it before the sky
  vec4 gain_origin;   // of the gain field (shared/gain_field.h); w: cells a unit
  vec4 light_styles[16];  // factors of the 64 styles on baked light, as displayed, of kViewOfMap
  vec4 screen_tint;
  uint width, height;  // rendered pixels
  uint output_width, output_height;
  uint picture_x, picture_y, picture_width, picture_height;  // where in the output the picture is
  uint smooth_width, smooth_height;  // of the anti-aliased picture: the output's if it is scaled up over time
  uint gain_image, gain_width, gain_depth, gain_height;  // kNoIndex: there is no gain field
  uint frame;  // seed of this frame's random numbers; differs from frame to frame
  uint sky_mode, sky_solid, sky_alpha, sun_count;
  uint sky_box0, sky_box1, sky_box2, sky_box3;
  uint sky_box4, sky_box5, sky_beyond, accumulated_frames;
  float time, prev_time, jitter_x, jitter_y;  // jitter in pixels, 0: pixel centre
  uint jitter_seed;                           // not 0: each pixel's jitter is moved by a random offset of its own
  float tap_size, tap_shift;                  // kFilterFootprint: a pixel's points, in pixels; their part of the jitter
  float exposure_least, exposure_most;        // of the automatic part, log2
  float adaptation;                           // of the exposure: weight of the new value, 1 at a cut
  uint swap_red_blue, quad_tiles_x, draw_quads, atlas_width;
  uint technique_view;            // the technique draws the debug view
  uint previous_gbuffer;          // kBindPreviousGBuffer holds the former frame's
  uint light_first, light_count;  // the list of lights (GpuLight): the texel where they begin; 0: there are none
  float light_power;              // of all: area times radiance, sum of the channels
  uint lamp_first;                // the texel where its lamps begin
  // Light is sampled at one pixel of each block of light_block x light_block, at light_x, light_y in it; 1: at every
  // pixel.
  uint light_block, light_x, light_y, light_width;  // light_width: blocks in a row
  // Of the medium's light likewise; blocks of these are whole ones of the light's, and its pixel is one of theirs.
  uint medium_block, medium_x, medium_y, medium_width;
  uint second_radiance;             // of kBindRadiance, where what second surfaces bring begins; without water no place
  uint medium_layer, second_layer;  // of the denoiser's history: the first of a layer's slots, texels
  uint history_parity, history_valid;
  uint history_age, history_gain;  // frames since there was no history; frames that this one counts
  uint still;                      // still: the same snapshot again, so nothing has moved
  float water_height, water_size;  // of its waves (shared/waves.h)
  uint water_clock;
  uint camera_liquid;                    // that the camera is in, as Vertex::liquid has it (lib/interaction.glsl)
  float camera_fog, camera_fog_square;   // along the camera's rays (Haze of shared/medium.h); 0 in a liquid
  uint turbid;                           // some liquid or glass scatters light
  uint mirrors;                          // some surface is an interface of a liquid
  float warp_phase;                      // of the picture's waves (shared/picture_warp.h), radians
  uint distances_former, distances_now;  // halves of what is known of distances: the former frame's, kNoIndex: there is
                                         // none; this one's
  uint work_parity;                      // of this frame's words in shared/work.h
  // Which pixel of a block was lit in the former frame.
  uint former_light_x, former_light_y, former_light_block;
  uint former_first, former_instances;  // where instances of the former frame are now: the texel of the table, how many
  uint baked_image, baked_faces;        // baked light as words (shared/baked_words.h); kNoIndex: none
  FB_FRAME_SETTINGS(FB_UNIFORM_FIELD)
  FB_DENOISER_SETTINGS(FB_UNIFORM_FIELD)
};

// Of GBufferTexel::material_metalness.
FB_CONST uint kTexelMaterial = 0x3fffffu;
FB_CONST uint kTexelGlows = 0x400000u;   // the point emits light itself
FB_CONST uint kTexelLiquid = 0x800000u;  // the surface of a liquid

// In memory five planes, four words of every pixel in each.
FB_CONST uint kFirstWaterPlane = 5u, kWaterPlanes = 4u;  // that follow where there is water (lib/water_texel.glsl)
FB_CONST uint kLiquidPlane = 8u;                         // the last of them
struct GBufferTexel {                                    // 80 bytes
  vec4 position_t;  // world position; w: distance along the ray, 0 where nothing was hit
  vec4 albedo_roughness;
  vec4 emission_specular;       // rgb radiance towards the camera
  uint normal, shading_normal;  // octahedral; both face the camera
  uint id;                      // scene::Instance::id
  uint material_metalness;      // kTexelMaterial, kTexelGlows, kTexelLiquid; metalness * 255 above
  vec4 motion;                  // xy: previous minus current position in pixels; z, w: view depth now and before
};

struct ExposureState {
  float exposure;      // factor on radiance
  float log_exposure;  // log2 of the automatic part, as it follows the picture
  float pad0, pad1;
};

// What stands between radiance and the screen. The grid: luminance by place in the picture and by log luminance, so
// that a dark pixel beside a window does not count as bright (bilateral grid, Chen 2007). Both have one size, whatever
// the picture's.
FB_CONST uint kGridWidth = 20u, kGridHeight = 12u, kGridBins = 16u;
FB_CONST uint kGridCells = kGridWidth * kGridHeight * kGridBins;  // x fastest, then y, then bins
FB_CONST uint kBloomWidth = 96u, kBloomHeight = 54u, kBloomPixels = kBloomWidth * kBloomHeight;
struct ExposureBuffer {
  ExposureState state;
  uint histogram[128];           // kHistogramBins
  uint grid_count[kGridCells];   // samples in a cell
  uint grid_sum[kGridCells];     // of log2 luminance above the lowest bin's, in 1/256
  uint grid[kGridCells];         // smoothed: half2 of the weight of a cell's samples and of their mean log2 luminance
  uint bloom[2 * kBloomPixels];  // pack_rgb9e5 of exposed radiance; twice kBloomWidth x kBloomHeight
};

struct GpuQuad {   // 48 bytes, output pixels and atlas texels
  vec4 rectangle;  // min.xy, max.xy
  vec4 uv;         // min.xy, max.xy; equal: a plain fill
  vec4 color;
};

FB_NAMESPACE_END
#endif
