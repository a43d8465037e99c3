#include "render/picture/frame_constants.h"

#include <algorithm>
#include <cmath>

#include "shared/kinds.h"
#include "shared/phase.h"
#include "shared/picture_warp.h"
#include "shared/rng.h"
#include "shared/scene_gpu.h"
#include "shared/sun_disc.h"
#include "shared/waves.h"

namespace fb::render {
namespace {

constexpr float kWaveSize = 64.0f;  // about the length of the longest wave of water, units

// QuakeSpasm's: a sine of time takes up to 6% from the width that is seen while it adds them to the height.
constexpr float kBreath = 0.03f;    // half of that
constexpr double kBreathing = 1.5;  // radians a second

CameraFrame breathing(CameraFrame frame, bool in_liquid, double time, const RenderSettings& settings) {
  if (!in_liquid || settings.water_warp != 2) return frame;
  const auto breath = static_cast<float>(std::sin(kBreathing * time));
  frame.right *= 1.0f - kBreath + kBreath * breath;
  frame.up *= 1.0f + kBreath - kBreath * breath;
  return frame;
}

}  // namespace

CameraFrame camera_frame(const scene::Camera& camera, std::uint32_t width, std::uint32_t height) {
  const AxisVectors axes = angle_vectors(camera.angles);
  const float tan_x = std::tan(radians(std::clamp(camera.fov_x, 1.0f, 179.0f) * 0.5f));
  const float tan_y = camera.fov_y > 0 ? std::tan(radians(std::clamp(camera.fov_y, 1.0f, 179.0f) * 0.5f))
                                       : tan_x * static_cast<float>(height) / static_cast<float>(width);
  return {camera.position, axes.forward, axes.right * tan_x, axes.up * tan_y};
}

CameraFrame view_frame(const scene::FrameSnapshot& snapshot, const RenderSettings& settings, uvec2 size) {
  return breathing(camera_frame(snapshot.camera, size.x, size.y), snapshot.in_liquid, snapshot.time, settings);
}

CameraFrame former_view_frame(const scene::FrameSnapshot& snapshot, const RenderSettings& settings, uvec2 size) {
  if (snapshot.cut) return view_frame(snapshot, settings, size);
  return breathing(camera_frame(snapshot.prev_camera, size.x, size.y), snapshot.was_in_liquid, snapshot.prev_time,
                   settings);
}

bool warps_picture(const scene::FrameSnapshot& snapshot, const RenderSettings& settings) {
  return snapshot.in_liquid && settings.water_warp == 1 && settings.debug_view == 0;
}

vec2 jitter_at(std::uint32_t index) {
  const double x = 0.5 + 0.7548776662466927 * index, y = 0.5 + 0.5698402909980532 * index;
  return {static_cast<float>(x - std::floor(x)) - 0.5f, static_cast<float>(y - std::floor(y)) - 0.5f};
}

void fill_jitter(shared::FrameConstants& c, const RenderSettings& settings, std::uint32_t frame, bool moving) {
  const bool asked = settings.jitter > 0, always = asked || (settings.jitter < 0 && moving);
  if (!always && (settings.jitter == 0 || c.accumulated_frames == 0)) return;
  const bool alone = settings.accumulate == 0;  // no frames that spread evenly together
  const std::uint32_t start =
      asked ? shared::hash_combine(static_cast<std::uint32_t>(settings.seed), alone ? frame : 0u) : 0;
  const vec2 jitter = jitter_at(start + (always ? frame : 0) + c.accumulated_frames);
  c.jitter_x = jitter.x;
  c.jitter_y = jitter.y;
  const bool alike = c.denoise != 0 || c.texture_filter == std::int32_t{shared::kFilterFootprint};
  c.jitter_seed = asked && !alike ? start | 1u : 0;
}

void fill_taps(shared::FrameConstants& c, uvec2 render, uvec2 smooth) {
  c.smooth_width = smooth.x;
  c.smooth_height = smooth.y;
  const bool scales_up = smooth != render;
  c.tap_size = scales_up ? static_cast<float>(render.x) / static_cast<float>(smooth.x) : 1.0f;
  c.tap_shift = 0.5f * (scales_up ? c.tap_size : -1.0f);
}

// Where a texture in light of 1 is shown about as it was painted, by the tone curve, log2; and how far automatic
// exposure moves from there in maps whose authors have said how bright they are.
constexpr float kPaintedExposure = -0.6f, kAuthoredStops = 1.5f;

float half_pixel_tangent(const CameraFrame& camera, std::uint32_t height) {
  return glm::length(camera.up) / static_cast<float>(height);
}

shared::FrameConstants frame_constants(const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                                       uvec2 render, uvec2 output) {
  shared::FrameConstants c{};
  copy_settings(settings, c);
  const CameraFrame now = view_frame(snapshot, settings, render);
  const CameraFrame before = former_view_frame(snapshot, settings, render);
  c.camera_position = vec4(now.position, half_pixel_tangent(now, render.y));
  c.camera_forward = vec4(now.forward, 0);
  c.camera_right = vec4(now.right, 0);
  c.camera_up = vec4(now.up, 0);
  c.prev_camera_position = vec4(before.position, 0);
  c.prev_camera_forward = vec4(before.forward, 0);
  c.prev_camera_right = vec4(before.right, 0);
  c.prev_camera_up = vec4(before.up, 0);

  c.exposure_least = snapshot.authored ? kPaintedExposure - kAuthoredStops : -6.0f;
  c.exposure_most = snapshot.authored ? kPaintedExposure + kAuthoredStops : 8.0f;
  const scene::GainTable& gains = snapshot.gains;
  c.gain_image = snapshot.authored ? gains.image : shared::kNoIndex;
  c.gain_origin = vec4(gains.origin, 1.0f / gains.side);
  c.baked_image = snapshot.baked.image;
  c.baked_faces = snapshot.baked.faces;
  for (std::size_t i = 0; i < snapshot.baked.styles.size(); ++i)
    c.light_styles[i / 4][static_cast<int>(i % 4)] = snapshot.baked.styles[i];
  c.gain_width = gains.width;
  c.gain_depth = gains.depth;
  c.gain_height = gains.height;

  const scene::Sky& sky = snapshot.sky;
  c.sky_mode = static_cast<std::uint32_t>(sky.mode);
  c.sky_color = vec4(sky.color, 0);
  c.sky_even = vec4(sky.even, 0);
  c.sky_solid = sky.solid;
  c.sky_alpha = sky.alpha;
  if (sky.mode == scene::SkyMode::kLayers && sky.solid == scene::kNone) c.sky_mode = 0;
  c.sky_box0 = sky.box[0];
  c.sky_box1 = sky.box[1];
  c.sky_box2 = sky.box[2];
  c.sky_box3 = sky.box[3];
  c.sky_box4 = sky.box[4];
  c.sky_box5 = sky.box[5];
  c.sky_beyond = sky.beyond_everything;
  c.sun_count = static_cast<std::uint32_t>(std::min<std::size_t>(sky.suns.size(), shared::kMaxSuns));
  for (std::uint32_t i = 0; i < c.sun_count; ++i) {
    const scene::Sun& sun = sky.suns[i];
    const float radius = radians(std::clamp(sun.angular_radius, 0.05f, 90.0f));
    const float half = std::sin(radius * 0.5f);
    const float disc = 2.0f * half * half;  // 1 - cos, without the cancellation
    c.sun_direction[i] = vec4(sun.direction, disc);
    // The sky's own factor reaches suns through the material of sky surfaces; taken out here so that r_emit_sun is
    // alone.
    const float sky_factor = settings.emit_sky > 0 ? settings.emit_sky : 1.0f;
    const vec3 radiance = sun.irradiance * (settings.emit_sun / shared::sun_solid_angle(disc) / sky_factor);
    c.sun_radiance[i] = vec4(radiance, (radiance.x + radiance.y + radiance.z) * sky_factor);
  }
  c.ambient = vec4(snapshot.ambient, std::clamp(snapshot.medium.before_sky, 0.0f, 1.0f));
  c.fog_glow = vec4(0, 0, 0, c.ambient.w);
  c.medium_phase.z = 1.0f;  // shaders that know of a medium go on when there is none any more
  if (snapshot.medium.scatters()) {
    const scene::Medium& m = snapshot.medium;
    c.medium = vec4(glm::clamp(m.albedo, 0.0f, 1.0f), m.extinction);
    const shared::PhaseFunction phase = shared::phase_function(m.g, m.alpha);
    c.medium_phase = vec4(phase.g, phase.alpha, std::clamp(m.sky, 0.0f, 1.0f), 0);
    if (m.square > 0.0f) {
      c.medium.w = 0.0f;
      c.camera_fog_square = m.square;
      c.fog_glow = vec4(glm::max(m.glow, vec3(0.0f)), std::clamp(m.glow_before_sky, 0.0f, 1.0f));
    } else {
      c.fog_glow = vec4(vec3(c.medium) * vec3(c.ambient), c.ambient.w);
    }
  }
  c.water_height = settings.water_waves;
  c.water_size = kWaveSize;
  c.water_clock = shared::wave_clock(snapshot.time, kWaveSize);
  constexpr std::uint32_t kMostInside = 0xffff;  // materials that a point can be in (lib/interaction.glsl)
  const bool in_liquid = settings.water > 0 && snapshot.camera_liquid < kMostInside;
  c.camera_fog = in_liquid ? 0.0f : c.medium.w;
  if (in_liquid) c.camera_fog_square = 0.0f;
  c.medium_phase.w = std::clamp(settings.water_g, -shared::kPhaseMaxG, shared::kPhaseMaxG);
  c.camera_liquid = in_liquid ? kMostInside << 16 | snapshot.camera_liquid : shared::kNoIndex;
  c.screen_tint = in_liquid ? snapshot.tint_in_liquid : snapshot.screen_tint;
  const double turns = snapshot.time * static_cast<double>(shared::kWarpTurns);
  c.warp_phase = static_cast<float>(turns - std::floor(turns)) * shared::kWarpTurn;
  c.width = render.x;
  c.height = render.y;
  c.output_width = output.x;
  c.output_height = output.y;
  c.picture_width = output.x;
  c.picture_height = output.y;
  c.time = static_cast<float>(snapshot.time);
  c.prev_time = static_cast<float>(snapshot.prev_time);
  return c;
}

}  // namespace fb::render
