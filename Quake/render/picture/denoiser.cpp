#include "render/picture/denoiser.h"

#include <algorithm>
#include <cmath>

#include <glm/packing.hpp>

#include "shared/denoise.h"
#include "shared/light_change.h"

namespace fb::render {
namespace {

// What a wavelet's shader is told.
struct Level {
  std::int32_t x, y;
  std::uint32_t source, target;
};

constexpr int kLayerLevels = 3;  // odd: the result is where the first target was

// So many that the footprint, 5^levels pixels, is at most a sixtieth of the picture: the same look at every size.
int levels_for(uvec2 size) {
  int levels = 2;
  for (std::uint64_t footprint = 125; levels < 6 && footprint * 60 <= std::uint64_t{size.x} * size.y; footprint *= 5)
    ++levels;
  return levels;
}

std::uint64_t layer_texels(uvec2 render, std::uint32_t block) {
  const uvec2 blocks = block > 0 ? Denoiser::light_size(render, block) : uvec2(0);
  return std::uint64_t{shared::kLayerSlots} * blocks.x * blocks.y;
}

std::uint64_t change_texels(uvec2 render) {
  const uvec2 tiles = groups_over(render, shared::kChangeTile);
  return std::uint64_t{tiles.x} * tiles.y * shared::kChangeWords / 4;
}

}  // namespace

std::uint32_t Denoiser::light_block(const RenderSettings& settings) const {
  if (!wanted(settings) || settings.debug_view != 0) return 1;
  const float chosen = settings.light_scale > 0 ? settings.light_scale : device_.is_software() ? 0.5f : 1.0f;
  return static_cast<std::uint32_t>(std::lround(1.0f / std::clamp(chosen, 0.25f, 1.0f)));
}

std::uint32_t Denoiser::medium_block(const RenderSettings& settings) const {
  const float scale = wanted(settings) && settings.debug_view == 0 ? std::clamp(settings.fog_scale, 0.25f, 1.0f) : 1.0f;
  return light_block(settings) * static_cast<std::uint32_t>(std::lround(1.0f / scale));
}

std::uint64_t Denoiser::history_bytes(uvec2 render, uvec2 smooth, const Blocks& blocks) {
  const std::uint64_t pixels = std::uint64_t{render.x} * render.y, shown = std::uint64_t{smooth.x} * smooth.y;
  const std::uint64_t texels = shared::kSectionPicture * pixels + (pixels + 1) / 2 + (shown + 1) / 2;  // whole ones
  return sizeof(glm::uvec4) *
         (texels + change_texels(render) + layer_texels(render, blocks.medium) + layer_texels(render, blocks.second));
}

uvec2 Denoiser::smooth_size(uvec2 render, uvec2 output, const RenderSettings& settings) {
  if (!antialiases(settings)) return render;
  if (settings.taa_scale <= 0) return output;
  return glm::min(output, uvec2(glm::max(vec2(render) * settings.taa_scale + 0.5f, vec2(render))));
}

void Denoiser::resize(uvec2 render, uvec2 output, const RenderSettings& settings, Layers layers) {
  on_ = wanted(settings);
  const uvec2 size = on_ ? render : uvec2(0), smooth = on_ ? smooth_size(render, output, settings) : uvec2(0);
  const Blocks wanted_blocks = on_ ? blocks(settings, layers) : Blocks();
  if (size == size_ && smooth == smooth_ && wanted_blocks == room_) return;
  const auto bind = [&] {
    table_.set_texels(shared::kTexelsHistory, buffer_);
    table_.set_array(shared::kSetFrame, shared::kBindHistory, buffer_);
  };
  size_ = uvec2(0);  // until the new one is there
  valid_ = false;
  buffer_ = gpu::Buffer();  // the old one's memory goes first
  bind();
  if (on_) {
    buffer_ = gpu::Buffer(device_, gpu::BufferUse::kStorage, history_bytes(size, smooth, wanted_blocks), "history");
  }
  size_ = size;
  smooth_ = smooth;
  room_ = wanted_blocks;
  bind();
}

void Denoiser::fill(shared::FrameConstants& c, const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                    bool still) {
  light_block_ = light_block(settings);
  c.light_block = light_block_;
  c.light_width = light_size(uvec2(c.width, c.height), light_block_).x;
  // A block's pixels in turns, neighbours seldom one after the other: the step shares no factor with their number.
  const std::uint32_t pixels = light_block_ * light_block_;
  const auto turn = static_cast<std::uint32_t>((snapshot.frame + c.accumulated_frames) * (pixels / 2 + 1) % pixels);
  c.light_x = turn % light_block_;
  c.light_y = turn / light_block_;
  fill_medium(c, settings, turn, snapshot.frame + c.accumulated_frames);
  c.denoise = on_;
  c.history_gain = 1;
  c.taa = on_ && antialiases(settings);
  // Baked light is asked of only where the map's lights are fitted to it: of others it would tell another picture.
  c.baked_past = on_ && snapshot.authored && snapshot.baked.image != scene::kNone ? settings.baked_past : 0.0f;
  if (!on_) return;
  const bool again = still && snapshot.frame == last_frame_;
  parity_ ^= 1u;
  c.medium_layer =
      shared::first_layer(size_.x * size_.y, smooth_.x * smooth_.y) + static_cast<std::uint32_t>(change_texels(size_));
  c.second_layer = c.medium_layer + static_cast<std::uint32_t>(layer_texels(size_, room_.medium));
  levels_ = settings.svgf_levels > 0 ? std::max(settings.svgf_levels, 2) : levels_for(size_);
  c.history_parity = parity_;
  c.history_valid = valid_ && (again || !snapshot.cut);
  age_ = c.history_valid != 0 ? age_ + 1 : 0;
  c.history_age = age_;
  c.history_gain = c.history_valid != 0 ? 1u : static_cast<std::uint32_t>(settings.first_spp);
  begins_baked_ = c.history_valid == 0 && c.baked_past > 0;
  c.still = still;
  blends_mean_ = c.accumulated_frames > 0;
  valid_ = true;
  last_frame_ = snapshot.frame;
}

// One of the light's pixels in each block of blocks.
void Denoiser::fill_medium(shared::FrameConstants& c, const RenderSettings& settings, std::uint32_t turn,
                           std::uint64_t frame) {
  medium_block_ = medium_block(settings);
  const std::uint32_t blocks = medium_block_ / light_block_;
  c.medium_block = medium_block_;
  c.medium_width = light_size(uvec2(c.width, c.height), medium_block_).x;
  // The light's turns come round before the next of these begins, so that all pixels have theirs.
  const std::uint32_t number = blocks * blocks, lit = light_block_ * light_block_;
  const auto next = static_cast<std::uint32_t>((frame / lit) * (number / 2 + 1) % number);
  c.medium_x = next % blocks * light_block_ + turn % light_block_;
  c.medium_y = next / blocks * light_block_ + turn / light_block_;
}

void Denoiser::add_passes(PassList& list, ShaderSet& shaders, const Variant& traced, const AskedGroups& medium,
                          const AskedGroups& second) {
  if (!on_) return;
  const Variant variant{.medium = static_cast<bool>(medium), .water = static_cast<bool>(second)};
  const uvec2 groups = groups_over(size_, 8);
  if (light_block_ > 1) {
    list.dispatch("denoise_light", PassKind::kFrame, shaders.get("denoise_light", variant),
                  groups_over(light_size(size_, light_block_), 8));
  }
  add_change(list, shaders, variant);
  list.dispatch("denoise_temporal", PassKind::kFrame,
                shaders.get(light_block_ > 1 ? "denoise_temporal_sparse" : "denoise_temporal", variant), groups);
  if (begins_baked_) add_baked(list, shaders, traced);
  if (medium) add_layer(list, shaders, variant, "denoise_medium", medium);
  if (second) add_layer(list, shaders, variant, "denoise_second", second);
  add_wavelets(list, shaders, variant);
}

// The map's baked light in the place of a past.
void Denoiser::add_baked(PassList& list, ShaderSet& shaders, const Variant& traced) const {
  struct Step {
    const gpu::ComputePipeline& pipeline;
    uvec2 groups;
  };
  const uvec2 groups = groups_over(size_, 8), tiles = groups_over(groups_over(size_, shared::kChangeTile), 8);
  const std::vector<Step> steps{{shaders.get("denoise_baked", traced), groups},
                                {shaders.get("denoise_baked_sums"), tiles},
                                {shaders.get("denoise_baked_join"), groups}};
  list.add("denoise_baked", PassKind::kFrame, [steps](gpu::Commands& commands) {
    for (const Step& step : steps) {
      commands.dispatch(step.pipeline, step.groups.x, step.groups.y);
      commands.barrier();
    }
  });
}

// How much of the history each tile of pixels keeps.
void Denoiser::add_change(PassList& list, ShaderSet& shaders, const Variant& variant) const {
  const gpu::ComputePipeline& sums =
      shaders.get(light_block_ > 1 ? "denoise_change_sparse" : "denoise_change", variant);
  const gpu::ComputePipeline& decide = shaders.get("denoise_change_decide");
  const uvec2 groups = groups_over(groups_over(size_, shared::kChangeTile), 8);
  list.add("denoise_change", PassKind::kFrame, [&sums, &decide, groups](gpu::Commands& commands) {
    for (const gpu::ComputePipeline* step : {&sums, &decide}) {
      commands.dispatch(*step, groups.x, groups.y);
      commands.barrier();
    }
  });
}

// Its light ends in slot 3 (shared/denoise.h).
void Denoiser::add_layer(PassList& list, ShaderSet& shaders, const Variant& variant, const std::string& name,
                         const AskedGroups& groups) const {
  const gpu::ComputePipeline& temporal = shaders.get(name + "_temporal", variant);
  const gpu::ComputePipeline& wavelet = shaders.get(name, variant);
  list.add(name, PassKind::kFrame, [&temporal, &wavelet, groups](gpu::Commands& commands) {
    groups.dispatch(commands, temporal);
    commands.barrier();
    Level level{1, 0, 2, 3};
    for (int i = 0; i < kLayerLevels; ++i) {
      commands.push(level);
      groups.dispatch(commands, wavelet);
      commands.barrier();
      level = {2 * level.x - level.y, level.x + 2 * level.y, level.target, level.source};
    }
  });
}

void Denoiser::add_wavelets(PassList& list, ShaderSet& shaders, const Variant& variant) const {
  struct Step {
    const gpu::ComputePipeline& pipeline;
    Level level;
  };
  std::vector<Step> steps;
  // Powers of 2 + i; every other frame mirrored, so that what a level leaves is not the same twice.
  std::int32_t a = 1, b = 0;
  for (int level = 0; level < levels_; ++level) {
    const std::uint32_t source = shared::kSectionFilter + static_cast<std::uint32_t>(level & 1);
    const std::uint32_t target = shared::kSectionFilter + static_cast<std::uint32_t>((level + 1) & 1);
    const bool last = level + 1 == levels_;
    const char* shader = level == 0 ? "denoise_wavelet_first" : last ? "denoise_wavelet_last" : "denoise_wavelet";
    steps.push_back({shaders.get(shader, last ? variant : Variant()), {a, parity_ != 0 ? b : -b, source, target}});
    const std::int32_t next = 2 * a - b;
    b = a + 2 * b;
    a = next;
  }
  if (blends_mean_) steps.push_back({shaders.get("denoise_mean"), {}});
  list.add("denoise_wavelets", PassKind::kFrame, [steps, groups = groups_over(size_, 8)](gpu::Commands& commands) {
    for (const Step& step : steps) {
      commands.push(step.level);
      commands.dispatch(step.pipeline, groups.x, groups.y);
      commands.barrier();
    }
  });
}

std::vector<vec4> Denoiser::read() const {
  const std::size_t pixels = static_cast<std::size_t>(size_.x) * size_.y;
  if (!on_) return {};
  const auto texels =
      gpu::read_now<uvec2>(device_, buffer_, pixels, shared::kSectionPicture * pixels * sizeof(glm::uvec4));
  std::vector<vec4> image(pixels);
  std::transform(texels.begin(), texels.end(), image.begin(),
                 [](const uvec2& t) { return vec4(glm::unpackHalf2x16(t.x), glm::unpackHalf2x16(t.y).x, 1); });
  return image;
}

std::vector<glm::uvec4> Denoiser::read_history() const {
  const std::size_t pixels = static_cast<std::size_t>(size_.x) * size_.y;
  if (!on_) return {};
  return gpu::read_now<glm::uvec4>(device_, buffer_, pixels,
                                   (shared::kSectionHistory + parity_) * pixels * sizeof(glm::uvec4));
}

}  // namespace fb::render
