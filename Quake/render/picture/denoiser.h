// The denoiser's part of a frame: temporal accumulation, edge-avoiding wavelets (SVGF, Schied 2017) and temporal
// anti-aliasing. Reads the frame's radiance and G-buffer, writes a denoised picture beside the raw mean, which it never
// touches. Shaders/shared/denoise.h has the layout of its buffer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/maths.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/pipeline.h"
#include "render/passes/pass.h"
#include "render/passes/settings.h"
#include "render/passes/shader_set.h"
#include "scene/snapshot.h"
#include "shared/frame.h"

namespace fb::render {

class Denoiser {
 public:
  Denoiser(gpu::Device& device, gpu::BindingTable& table) : device_(device), table_(table) {}

  // Whether these settings ask for the denoiser; temporal anti-aliasing works on its pictures only.
  static bool wanted(const RenderSettings& settings) { return settings.denoise > 0; }
  static bool antialiases(const RenderSettings& settings) { return wanted(settings) && settings.taa != 0; }

  // Light is sampled at one pixel of each block of so many a side (r_light_scale); 1 without the denoiser, and where a
  // debug view shows what is sampled.
  std::uint32_t light_block(const RenderSettings& settings) const;
  // Likewise of the light that a medium scatters (r_fog_scale).
  std::uint32_t medium_block(const RenderSettings& settings) const;
  // Blocks of a picture.
  static uvec2 light_size(uvec2 render, std::uint32_t block) { return groups_over(render, block); }

  // The anti-aliased picture's size: temporal anti-aliasing scales up as far as r_taa_scale says.
  static uvec2 smooth_size(uvec2 render, uvec2 output, const RenderSettings& settings);
  // What is denoised apart from pixels' own surfaces: what a medium scatters, and light on what is seen beside another
  // surface by way of water.
  struct Layers {
    bool medium = false, second = false;
  };
  // Pixels a side of the blocks at which layers are kept; 0: there is no such layer.
  struct Blocks {
    std::uint32_t medium = 0, second = 0;
    bool operator==(const Blocks&) const = default;
  };
  Blocks blocks(const RenderSettings& settings, Layers layers) const {
    return {layers.medium ? medium_block(settings) : 0, layers.second ? light_block(settings) : 0};
  }
  // Bytes of the history for these sizes.
  static std::uint64_t history_bytes(uvec2 render, uvec2 smooth, const Blocks& blocks);

  // Makes room for the history, or frees it; what was there is lost when a size changes.
  // `layers`: those that the scene can need, whether or not this frame shows them.
  void resize(uvec2 render, uvec2 output, const RenderSettings& settings, Layers layers);
  // The next frame has no history: this frame's may not have been written.
  void forget() { valid_ = false; }
  // This frame's rows of the uniform block. `still`: the same snapshot was rendered just before.
  void fill(shared::FrameConstants& constants, const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
            bool still);
  // The passes from radiance to the denoised picture; none if it is off. `traced`: the variant of shaders that trace
  // rays. `medium`, `second`: dispatches of the layers, which the G-buffer may ask for in this frame.
  void add_passes(PassList& list, ShaderSet& shaders, const Variant& traced, const AskedGroups& medium,
                  const AskedGroups& second);

  bool on() const { return on_; }
  // rgb: denoised radiance of the last frame.
  std::vector<vec4> read() const;
  // The history as it is packed (shared/denoise.h), kSectionHistory of the last frame.
  std::vector<glm::uvec4> read_history() const;

 private:
  void fill_medium(shared::FrameConstants& c, const RenderSettings& settings, std::uint32_t turn, std::uint64_t frame);
  void add_layer(PassList& list, ShaderSet& shaders, const Variant& variant, const std::string& name,
                 const AskedGroups& groups) const;
  void add_baked(PassList& list, ShaderSet& shaders, const Variant& traced) const;
  void add_change(PassList& list, ShaderSet& shaders, const Variant& variant) const;
  void add_wavelets(PassList& list, ShaderSet& shaders, const Variant& variant) const;

  gpu::Device& device_;
  gpu::BindingTable& table_;
  gpu::Buffer buffer_;
  uvec2 size_{0, 0}, smooth_{0, 0};
  bool on_ = false, valid_ = false, blends_mean_ = false;
  bool begins_baked_ = false;  // this frame begins with the map's baked light
  int levels_ = 0;
  std::uint32_t light_block_ = 1, medium_block_ = 1;
  Blocks room_;  // in buffer_
  std::uint32_t parity_ = 0, age_ = 0;
  std::uint64_t last_frame_ = 0;
};

}  // namespace fb::render
