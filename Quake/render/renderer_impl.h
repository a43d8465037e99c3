// What a renderer is made of: the frame's arrays, passes and state, for renderer.cpp and renderer_frame.cpp alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/pipeline.h"
#include "render/passes/debug_views.h"
#include "render/passes/shader_set.h"
#include "render/passes/work.h"
#include "render/picture/frame_constants.h"
#include "render/picture/last_step.h"
#include "render/picture/medium_distances.h"
#include "render/picture/picture_size.h"
#include "render/renderer.h"

namespace fb::render {

struct Renderer::Impl {
  Impl(gpu::Device& d, const GpuSceneOptions& options)
      : device(d),
        ray_query(options.ray_query),
        table(d),
        scene(d, table, options),
        last_step(d, table),
        shaders(d, table, arrays_by_address(d, options.by_address), lanes_of_gpu(d, options.gpu_lanes)),
        denoiser(d, table),
        timer(d) {
    uniform = gpu::Buffer(d, gpu::BufferUse::kUniform, sizeof(shared::FrameConstants), "frame constants");
    exposure = gpu::Buffer(d, gpu::BufferUse::kStorage, sizeof(shared::ExposureBuffer), "exposure");
    counters = gpu::Buffer(d, gpu::BufferUse::kStorage, shared::kCounterCount * 4, "counters");
    d.run([&](gpu::Commands& commands) {
      commands.fill(exposure, 0);
      commands.fill(counters, 0);
    });
    table.set_uniform(shared::kSetScene, uniform);
    table.set_array(shared::kSetFrame, shared::kBindExposure, exposure);
    table.set_array(shared::kSetFrame, shared::kBindCounters, counters);
  }

  ~Impl() { device.settle(); }

  std::uint32_t wanted_gbuffer_planes() const {
    return sizeof(shared::GBufferTexel) / 16 + (has_second() ? shared::kWaterPlanes : 0);
  }
  // Pixels may show two surfaces.
  bool has_second() const { return features.water || features.glass || features.veils; }
  void resize_buffers(uvec2 render, uvec2 output, const RenderSettings& settings);
  scene::Area shown() const { return area_within(picture, output_size); }
  void fit(const RenderSettings& settings);
  void begin(const scene::FrameSnapshot& snapshot, const scene::DrawList* draw, const RenderSettings& asked);
  void finish();
  void forget_frame();
  void choose_technique(const std::string& name);
  void choose_features(const scene::FrameSnapshot& snapshot, const RenderSettings& settings);
  void swap_gbuffers(std::uint32_t debug_view);
  void fill_constants(const scene::FrameSnapshot& snapshot, const RenderSettings& settings, std::uint64_t scene);
  // Bytes of kBindRadiance.
  VkDeviceSize radiance_bytes(const RenderSettings& settings, uvec2 render) const;
  VkDeviceSize second_radiance(const RenderSettings& settings, uvec2 render) const;
  void forget_learnt() {
    if (technique) technique->forget();
    distances.forget();
  }
  // The technique draws the debug view that is asked for.
  bool shows_view() const {
    return info->views != shared::kViewOfFrame && view_owner(constants.debug_view) == info->views;
  }
  Work work() const { return {counters, constants}; }
  PassList list_passes();

  gpu::Device& device;
  bool ray_query;
  gpu::BindingTable table;
  GpuScene scene;
  LastStep last_step;
  ShaderSet shaders;
  Denoiser denoiser;
  gpu::PassTimer timer;

  gpu::Buffer uniform, gbuffer, previous_gbuffer, radiance, mean, m2, ldr, exposure, counters;
  uvec2 output_size{640, 360}, render_size{0, 0}, allocated_output{0, 0};
  scene::Area picture;  // in the output, as it was asked for last; empty: all of it
  std::uint32_t gbuffer_planes = 0;
  std::uint32_t work_parity = 0;
  bool swap_red_blue = false;

  std::uint64_t key = 0, last_scene = 0;
  std::uint64_t generation = 0, number = 0;  // of the assets; of the next frame
  std::uint32_t accumulated = 0;             // frames in the mean after the last render
  bool restart = true;                       // accumulation begins anew
  std::optional<std::uint32_t> resumed;      // frames that count as rendered before the next one
  bool lost = true, authored = false;        // nothing is left of the former frame; baked light counted in it
  std::optional<uvec2> iteration;            // begins with the next frame: its number, its samples
  bool ends_iterations = false;              // with the next frame
  bool final_passes = false;                 // of this frame
  double last_time = 0;
  SceneFeatures features;
  bool warps = false;           // waves distort the picture
  bool previous_valid = false;  // previous_gbuffer is the former frame's
  MediumDistances distances;
  const TechniqueInfo* info = nullptr;
  std::unique_ptr<Technique> technique;
  shared::FrameConstants constants{};
  PassList passes;         // of the frame that is under way, or was the last
  bool under_way = false;  // it was begun and not finished
  std::function<void()> finished;
  std::vector<PassTime> pass_times;
  double wait_milliseconds = 0;
  bool said_unknown_estimator = false;
};

}  // namespace fb::render
