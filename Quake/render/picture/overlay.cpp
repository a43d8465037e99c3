#include "render/picture/overlay.h"

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "base/out_of_memory.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

struct TileRange {
  std::uint32_t x0, y0, x1, y1;  // inclusive; empty if x1 < x0
  bool empty;
};

TileRange tiles_of(const scene::DrawQuad& quad, std::uint32_t width, std::uint32_t height) {
  const auto tile = static_cast<float>(shared::kDrawTile);
  const float x0 = std::clamp(quad.min.x, 0.0f, static_cast<float>(width));
  const float y0 = std::clamp(quad.min.y, 0.0f, static_cast<float>(height));
  const float x1 = std::clamp(quad.max.x, 0.0f, static_cast<float>(width) - 0.5f);
  const float y1 = std::clamp(quad.max.y, 0.0f, static_cast<float>(height) - 0.5f);
  return {static_cast<std::uint32_t>(x0 / tile), static_cast<std::uint32_t>(y0 / tile),
          static_cast<std::uint32_t>(x1 / tile), static_cast<std::uint32_t>(y1 / tile), !(x1 >= x0 && y1 >= y0)};
}

}  // namespace

Overlay::Overlay(gpu::Device& device, gpu::BindingTable& table) : device_(device), table_(table) {
  quads_ = gpu::Buffer(device, gpu::BufferUse::kUpload, 64 * sizeof(shared::GpuQuad), "draw quads");
  tiles_ = gpu::Buffer(device, gpu::BufferUse::kUpload, 4096, "draw tiles");
  atlas_ = gpu::Buffer(device, gpu::BufferUse::kStorage, 16, "draw atlas");
}

void Overlay::bind() {
  table_.set_array(shared::kSetDraw, shared::kBindQuads, quads_);
  table_.set_array(shared::kSetDraw, shared::kBindTiles, tiles_);
  table_.set_array(shared::kSetDraw, shared::kBindAtlas, atlas_);
}

// From the top down: what is above the rest is the console and the menu.
std::uint32_t Overlay::first_that_fits(const scene::DrawList& list, std::uint32_t width, std::uint32_t height,
                                       std::size_t tile_count) {
  const std::uint64_t bytes = gpu::largest_buffer(device_, gpu::BufferUse::kStorage);
  std::uint64_t words = bytes / sizeof(std::uint32_t), quads = bytes / sizeof(shared::GpuQuad);
  words -= std::min<std::uint64_t>(words, 2 * tile_count);
  auto first = static_cast<std::uint32_t>(list.quads.size());
  for (; first > 0 && quads > 0; --first, --quads) {
    const TileRange range = tiles_of(list.quads[first - 1], width, height);
    const std::uint64_t tiles = range.empty ? 0 : std::uint64_t{range.x1 - range.x0 + 1} * (range.y1 - range.y0 + 1);
    if (tiles > words) break;
    words -= tiles;
  }
  if (first > 0 && !std::exchange(said_too_many_, true))
    log_warning(
        "{} of {} pictures and letters over the game are not drawn: they are more than {} allows, buffers of {}", first,
        list.quads.size(), device_.report().name, memory_text(bytes));
  return first;
}

void Overlay::prepare(const scene::DrawList* list, std::uint32_t width, std::uint32_t height) {
  bind();  // even if there is nothing to draw: the last list's preparation may have ended early
  empty_ = list == nullptr || list->quads.empty();
  if (empty_) return;
  if (list->atlas && list->atlas->revision != atlas_revision_ && !list->atlas->texels.empty()) {
    atlas_.reserve(list->atlas->texels.size() * sizeof(std::uint32_t));
    gpu::upload_now(device_, atlas_, std::span<const std::uint32_t>(list->atlas->texels));
    atlas_revision_ = list->atlas->revision;
    atlas_width_ = static_cast<std::uint32_t>(list->atlas->width);
  }
  tiles_x_ = (width + shared::kDrawTile - 1) / shared::kDrawTile;
  const std::uint32_t tiles_y = (height + shared::kDrawTile - 1) / shared::kDrawTile;
  const std::size_t tile_count = static_cast<std::size_t>(tiles_x_) * tiles_y;

  // Count, prefix-sum, fill: lists in drawing order.
  std::vector<std::uint32_t> words(2 * tile_count, 0);
  std::vector<std::uint32_t> counts(tile_count, 0);
  const std::uint32_t first = first_that_fits(*list, width, height, tile_count);
  const auto for_each_tile = [&](auto&& visit) {
    for (std::uint32_t i = first; i < list->quads.size(); ++i) {
      const TileRange range = tiles_of(list->quads[i], width, height);
      if (range.empty) continue;
      for (std::uint32_t y = range.y0; y <= range.y1; ++y) {
        for (std::uint32_t x = range.x0; x <= range.x1; ++x) visit(static_cast<std::size_t>(y) * tiles_x_ + x, i);
      }
    }
  };
  for_each_tile([&](std::size_t tile, std::uint32_t) { ++counts[tile]; });
  std::uint32_t at = static_cast<std::uint32_t>(words.size());
  for (std::size_t tile = 0; tile < tile_count; ++tile) {
    words[2 * tile] = words[2 * tile + 1] = at;
    at += counts[tile];
  }
  words.resize(at);
  for_each_tile([&](std::size_t tile, std::uint32_t quad) { words[words[2 * tile + 1]++] = quad - first; });

  tiles_.reserve(words.size() * sizeof(std::uint32_t));
  std::copy(words.begin(), words.end(), tiles_.mapped_as<std::uint32_t>().begin());
  quads_.reserve((list->quads.size() - first) * sizeof(shared::GpuQuad));
  auto quads = quads_.mapped_as<shared::GpuQuad>();
  for (std::size_t i = first; i < list->quads.size(); ++i) {
    const scene::DrawQuad& q = list->quads[i];
    quads[i - first] = {vec4(q.min.x, q.min.y, q.max.x, q.max.y), vec4(q.uv_min.x, q.uv_min.y, q.uv_max.x, q.uv_max.y),
                        q.color};
  }
  bind();
}

void Overlay::add_present(PassList& list, const gpu::ComputePipeline& present, uvec2 output) {
  list.add("present", PassKind::kFrame, [this, &present, groups = groups_over(output, 8)](gpu::Commands& commands) {
    commands.bind_third(table_, shared::kSetDraw);
    commands.dispatch(present, groups.x, groups.y);
    commands.barrier();
  });
}

}  // namespace fb::render
