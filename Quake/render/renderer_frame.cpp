// How a frame is drawn: what its arrays, features and constants are, and the order of its passes.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <ratio>
#include <utility>

#include "base/check.h"
#include "base/log.h"
#include "gpu/pipeline.h"
#include "render/passes/debug_views.h"
#include "render/passes/frame_keys.h"
#include "render/passes/shader_set.h"
#include "render/passes/work.h"
#include "render/picture/frame_constants.h"
#include "render/picture/last_step.h"
#include "render/picture/lens.h"
#include "render/picture/medium_distances.h"
#include "render/picture/picture_size.h"
#include "render/renderer_impl.h"
#include "shared/kinds.h"
#include "shared/rng.h"
#include "shared/veils.h"
#include "shared/work.h"

namespace fb::render {

using gpu::Buffer;
using gpu::BufferUse;

void Renderer::Impl::resize_buffers(uvec2 render, uvec2 wanted_output, const RenderSettings& settings) {
  const std::uint32_t planes = wanted_gbuffer_planes();
  const VkDeviceSize radiance_size = radiance_bytes(settings, render);
  if (render == render_size && wanted_output == allocated_output && planes == gbuffer_planes &&
      radiance_size <= radiance.size())
    return;
  render_size = allocated_output = uvec2(0);  // until all are there
  const VkDeviceSize pixels = static_cast<VkDeviceSize>(render.x) * render.y;
  const auto make = [&](Buffer& buffer, std::uint32_t binding, VkDeviceSize bytes, const char* name) {
    buffer = Buffer();  // the old one's memory goes first
    table.set_array(shared::kSetFrame, binding, buffer);
    buffer = Buffer(device, BufferUse::kStorage, bytes, name);
    table.set_array(shared::kSetFrame, binding, buffer);
  };
  previous_gbuffer = Buffer();
  previous_valid = false;
  table.set_array(shared::kSetFrame, shared::kBindPreviousGBuffer, previous_gbuffer);
  make(gbuffer, shared::kBindGBuffer, pixels * planes * 16, "G-buffer");
  make(radiance, shared::kBindRadiance, radiance_size, "radiance");
  distances.forget();
  make(mean, shared::kBindMean, pixels * 16, "mean radiance");
  make(m2, shared::kBindM2, pixels * 16, "squared deviations");
  make(ldr, shared::kBindLdr, pixels * 4, "tone-mapped picture");
  last_step.resize(wanted_output, wanted_output);  // the picture is no larger than the output
  render_size = render;
  allocated_output = wanted_output;
  gbuffer_planes = planes;
  restart = lost = true;
}

VkDeviceSize Renderer::Impl::radiance_bytes(const RenderSettings& settings, uvec2 render) const {
  const VkDeviceSize pixels = static_cast<VkDeviceSize>(render.x) * render.y;
  return 16 * (second_radiance(settings, render) + (has_second() ? pixels : 0));
}

// Texel of kBindRadiance where what second surfaces bring begins, behind all else.
VkDeviceSize Renderer::Impl::second_radiance(const RenderSettings& settings, uvec2 render) const {
  const VkDeviceSize pixels = static_cast<VkDeviceSize>(render.x) * render.y;
  if (!features.medium) return pixels;
  const uvec2 blocks = Denoiser::light_size(render, denoiser.medium_block(settings));
  return 2 * pixels + 2 * static_cast<VkDeviceSize>(blocks.x) * blocks.y;
}

// Buffers of the picture's size.
void Renderer::Impl::fit(const RenderSettings& settings) {
  const Denoiser::Layers layers{features.medium, has_second()};
  check_picture_size(device, output_size, settings, {wanted_gbuffer_planes(), denoiser.blocks(settings, layers)});
  resize_buffers(scaled_size(shown().size, settings), output_size, settings);
  denoiser.resize(render_size, shown().size, settings, layers);
}

// The frame ended early: what it was to write, and what says that it was written, is as good as lost.
void Renderer::Impl::forget_frame() {
  device.settle();
  under_way = false;
  restart = lost = true;
  scene.forget();
  previous_valid = false;
  forget_learnt();
  denoiser.forget();
}

// An unknown name leaves what there is. What one technique learnt is of no use to another.
void Renderer::Impl::choose_technique(const std::string& name) {
  const TechniqueInfo* chosen = find_technique(name);
  if (chosen != nullptr) {
    said_unknown_estimator = false;
  } else {
    chosen = info != nullptr ? info : &techniques().front();
    if (!std::exchange(said_unknown_estimator, true))
      log_warning("r_estimator {}: there is no such estimator; {} stays", name, chosen->name);
  }
  if (chosen == info && technique) return;
  info = chosen;
  technique.reset();
  for (std::uint32_t i = 0; i < shared::kTechniqueArrays; ++i) table.set_array(shared::kSetTechnique, i, Buffer());
  table.set_uniform(shared::kSetTechnique, Buffer());
  technique = info->make({device, table}, info->name);
  distances.forget();
}

// Features only grow while the assets stay: no compilation in mid-game when something comes and goes.
void Renderer::Impl::choose_features(const scene::FrameSnapshot& snapshot, const RenderSettings& settings) {
  const bool all = settings.force_features != 0;
  if (snapshot.assets->generation != generation) {
    const SceneFeatures former = features;  // the G-buffer has been made for its interfaces
    features = SceneFeatures{};
    features.water = former.water;
    features.glass = former.glass;
    features.veils = former.veils;
  }
  features.alpha_test |= scene.features().alpha_test || all;
  features.translucent |= scene.features().translucent || all;
  features.specular |= scene.features().specular || all;
  features.medium |= snapshot.medium.scatters() || scene.features().turbid || all;
  features.surfaces |= all ? shared::kFeaturesAll : scene.features().surfaces;
}

// The G-buffer that the former frame wrote becomes the previous one, for who wants it.
void Renderer::Impl::swap_gbuffers(std::uint32_t debug_view) {
  if (!info->wants_previous_gbuffer && view_owner(debug_view) != shared::kViewOfFormer) {
    previous_valid = false;
    if (previous_gbuffer) previous_gbuffer = Buffer();
  } else {
    if (!previous_gbuffer) previous_gbuffer = Buffer(device, BufferUse::kStorage, gbuffer.size(), "previous G-buffer");
    std::swap(gbuffer, previous_gbuffer);
    table.set_array(shared::kSetFrame, shared::kBindGBuffer, gbuffer);
  }
  table.set_texels(shared::kTexelsGBuffer, gbuffer);
  table.set_array(shared::kSetFrame, shared::kBindPreviousGBuffer, previous_gbuffer);
}

void Renderer::Impl::fill_constants(const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                                    std::uint64_t scene) {
  const std::uint64_t now = view_key(scene, settings);
  const bool same_view = now == key && !restart && settings.accumulate != 0;
  const bool first_frame = key == 0;
  if (!same_view) accumulated = 0;
  accumulated = std::exchange(resumed, std::nullopt).value_or(accumulated);
  const std::uint32_t sample = accumulated;  // whose random numbers they are
  if (final_passes) accumulated = 0;         // a picture of its own, no further sample

  const shared::FrameConstants former = constants;
  constants = frame_constants(snapshot, settings, render_size, output_size);
  const scene::Area place = shown();
  constants.picture_x = place.min.x;
  constants.picture_y = place.min.y;
  constants.picture_width = place.size.x;
  constants.picture_height = place.size.y;
  constants.turbid = this->scene.features().turbid;
  constants.mirrors = features.water;
  constants.second_radiance = static_cast<std::uint32_t>(second_radiance(settings, render_size));
  const GpuScene::Lights lights = this->scene.lights();
  constants.light_first = lights.first;
  constants.light_count = lights.count;
  constants.light_power = lights.power;
  constants.lamp_first = lights.first_lamp;
  constants.former_first = lights.first_former;
  constants.former_instances = lights.former_instances;
  constants.accumulated_frames = accumulated;
  constants.frame = shared::hash_combine(static_cast<std::uint32_t>(snapshot.frame), sample);
  if (technique->salt() != 0) constants.frame = shared::hash_combine(constants.frame, technique->salt());
  const double elapsed = std::clamp(snapshot.time - last_time, 0.0, 1.0);
  const bool jump = first_frame || snapshot.cut || same_view || settings.exposure_time <= 0;
  constants.adaptation = jump ? 1.0f : 1.0f - static_cast<float>(std::exp(-elapsed / settings.exposure_time));
  constants.local_exposure = std::max(settings.local_exposure, 0.0f);
  constants.bloom = std::max(settings.bloom, 0.0f);
  warps = warps_picture(snapshot, settings);
  constants.swap_red_blue = swap_red_blue;
  last_step.fill(constants);
  constants.technique_view = shows_view();
  constants.previous_gbuffer = previous_valid && !snapshot.cut;
  constants.work_parity = work_parity ^= 1u;
  denoiser.fill(constants, snapshot, settings, scene == last_scene);
  constants.spp *= static_cast<int>(constants.history_gain);
  constants.former_light_x = former.light_x;
  constants.former_light_y = former.light_y;
  constants.former_light_block = former.light_block;
  distances.fill(constants, snapshot.cut);
  fill_taps(constants, render_size, Denoiser::smooth_size(render_size, place.size, settings));
  if (settings.texture_filter < 0)
    constants.texture_filter =
        static_cast<std::int32_t>(constants.denoise != 0 ? shared::kFilterFootprint : shared::kFilterNearest);
  fill_jitter(constants, settings, static_cast<std::uint32_t>(snapshot.frame), Denoiser::antialiases(settings));
  std::memcpy(uniform.mapped(), &constants, sizeof(constants));

  key = now;
  last_scene = scene;
  last_time = snapshot.time;
  restart = lost = false;
}

// The way of a frame.
PassList Renderer::Impl::list_passes() {
  const std::uint32_t veils = features.veils ? shared::kFeatureVeils : 0;
  const Variant variant{ray_query,         features.alpha_test || features.translucent,
                        features.specular, features.surfaces | veils,
                        features.medium,   features.water || features.glass};
  PassList list;
  const auto frame = [&](const char* name, const gpu::ComputePipeline& pipeline, uvec2 groups) {
    list.dispatch(name, PassKind::kFrame, pipeline, groups);
  };
  scene.add_passes(list);
  add_gbuffer(list, shaders, variant, work(), ldr);
  const bool medium = MediumDistances::scatters(constants);
  const AskedGroups in_medium = medium ? work().groups(shared::kWorkMedium) : AskedGroups();
  const uvec2 lit = Denoiser::light_size(render_size, constants.light_block);
  const TechniquePasses own{list, shaders,   variant,           shows_view(),
                            lit,  in_medium, constants.bounces, constants.medium_bounces};
  final_passes ? technique->add_final_passes(own) : technique->add_passes(own);
  frame("accumulate", shaders.get(medium ? "accumulate_medium" : "accumulate"), groups_over(render_size, 8));
  denoiser.add_passes(list, shaders, variant, in_medium,
                      has_second() ? work().groups(shared::kWorkSecond) : AskedGroups());
  add_lens(list, shaders, constants, {.water = has_second()}, variant);
  last_step.add_passes(list, shaders, constants, warps);
  return list;
}

void Renderer::Impl::finish() {
  if (!under_way) return;
  const auto start = std::chrono::steady_clock::now();
  device.finish();
  const std::optional<PassTime> on_host = last_step.finish();
  wait_milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  under_way = false;
  pass_times = passes.times(timer.read());
  if (on_host) pass_times.push_back(*on_host);
  if (finished) finished();
}

void Renderer::Impl::begin(const scene::FrameSnapshot& snapshot, const scene::DrawList* draw,
                           const RenderSettings& asked) {
  if (!snapshot.assets) {  // nothing loaded yet: an empty scene
    scene::FrameSnapshot empty = snapshot;
    empty.assets = std::make_shared<scene::Assets>();
    empty.instances.clear();
    return begin(empty, draw, asked);
  }
  if (std::exchange(authored, snapshot.authored) != snapshot.authored) {  // all lights are others
    finish();
    forget_learnt();
    scene::FrameSnapshot relit = snapshot;
    relit.cut = true;
    return begin(relit, draw, asked);
  }
  choose_technique(asked.estimator);
  const RenderSettings settings = with_last_step(technique->adapt(asked), device.is_software());
  scene.prepare(snapshot, emission_scales(settings), info->wants_lights,
                {settings.water > 0, settings.glass > 0, settings.water_scatter});
  finish();
  picture = draw != nullptr ? draw->picture : scene::Area();
  features.medium |= snapshot.medium.scatters() || scene.features().turbid;
  const bool new_scene = snapshot.assets->generation != generation;
  const bool all = settings.force_features != 0;
  features.water = settings.water > 0 && (scene.features().water || (features.water && !new_scene) || all);
  features.glass = settings.glass > 0 && (scene.features().glass || (features.glass && !new_scene) || all);
  features.veils = !features.water && !features.glass && (scene.features().veils || (features.veils && !new_scene));
  fit(settings);
  swap_gbuffers(static_cast<std::uint32_t>(settings.debug_view));
  scene.stage();
  if (snapshot.assets->generation != generation) forget_learnt();
  choose_features(snapshot, settings);
  generation = snapshot.assets->generation;
  const CameraFrame camera = view_frame(snapshot, settings, render_size);
  const uvec2 lit = Denoiser::light_size(render_size, denoiser.light_block(settings));
  const std::uint64_t scene_now = scene_key(snapshot);
  const bool cut = lost || snapshot.cut || new_scene;
  if (const auto begun = std::exchange(iteration, std::nullopt)) technique->begin_iteration(begun->x, begun->y);
  final_passes = std::exchange(ends_iterations, false);
  FB_CHECK(!final_passes || info->ends_iterations);
  technique->prepare({snapshot, settings, render_size, lit, 2 * half_pixel_tangent(camera, render_size.y), number++,
                      cut, !cut && scene_now == last_scene, snapshot.medium.scatters(), scene.features().turbid});
  last_step.prepare(draw, output_size, settings);
  fill_constants(snapshot, settings, scene_now);
  table.flush();
  passes = list_passes();
  shaders.make();
  device.start([&](gpu::Commands& commands) {
    timer.reset(commands.handle());
    commands.set_timer(&timer);
    commands.bind(table);
    work().begin(commands);
    passes.record(commands);
  });
  under_way = true;
  ++accumulated;
  previous_valid = true;
}

}  // namespace fb::render
