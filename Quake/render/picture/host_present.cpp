#include "render/picture/host_present.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/check.h"
#include "base/parallel.h"
#include "shared/picture_warp.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kBlack = 0xff000000u;
constexpr std::uint32_t kBand = 32;  // rows of the output that one thread makes at once

// Numbers of 16 bits, so that eight are multiplied at once: channels of rows that are scaled across times 64, weights
// times 2^14, channels of their products times 16.
constexpr int kWeightBits = 14, kRowBits = 6, kSumBits = 4;
constexpr std::int16_t kRounding = 10;  // half a step, and half of what four products lose

struct Taps {
  std::uint32_t first;  // of four neighbours, which may lie beyond the edge
  std::array<std::int16_t, 4> weights;
};

// Where each of `to` pixels gets what it shows of `from`.
std::vector<Taps> taps_of(std::uint32_t from, std::uint32_t to, float sharpness) {
  std::vector<Taps> taps(to);
  const double step = static_cast<double>(from) / to;
  for (std::uint32_t i = 0; i < to; ++i) {
    const double at = (i + 0.5) * step - 0.5, base = std::floor(at);
    const std::array<float, 4> weights = cubic_weights(static_cast<float>(at - base), sharpness);
    taps[i].first = static_cast<std::uint32_t>(static_cast<std::int64_t>(base) + 1);  // of a row with two texels before
    int rest = 1 << kWeightBits;
    for (std::size_t k = 0; k < 4; ++k)
      rest -= taps[i].weights[k] = static_cast<std::int16_t>(std::lround(weights[k] * (1 << kWeightBits)));
    taps[i].weights[at - base < 0.5 ? 1 : 2] += static_cast<std::int16_t>(rest);
  }
  return taps;
}

std::uint32_t swapped(std::uint32_t p) { return (p & 0xff00ff00u) | ((p & 0xffu) << 16u) | ((p >> 16u) & 0xffu); }
std::uint32_t channel(std::uint32_t p, unsigned i) { return (p >> (8u * i)) & 0xffu; }

std::uint32_t pack(vec3 c) {
  const vec3 scaled = glm::clamp(c, 0.0f, 1.0f) * 255.0f + 0.5f;
  return static_cast<std::uint32_t>(scaled.x) | (static_cast<std::uint32_t>(scaled.y) << 8u) |
         (static_cast<std::uint32_t>(scaled.z) << 16u) | kBlack;
}
vec3 unpack(std::uint32_t p) { return vec3(channel(p, 0), channel(p, 1), channel(p, 2)) / 255.0f; }

// One row of the anti-aliased picture, distorted and tinted.
void take_row(const PresentedPicture& picture, std::span<const std::uint32_t> pixels, std::uint32_t y,
              std::uint32_t* to) {
  const int width = static_cast<int>(picture.size.x), height = static_cast<int>(picture.size.y);
  const vec2 size(picture.size), place(picture.place.size);
  const auto at = [&](int x, int row) {
    return unpack(pixels[static_cast<std::size_t>(std::clamp(row, 0, height - 1)) * picture.size.x +
                         static_cast<std::size_t>(std::clamp(x, 0, width - 1))]);
  };
  const float kept = 1.0f - picture.tint.w;
  const vec3 tint = vec3(picture.tint) * picture.tint.w;
  for (int x = 0; x < width; ++x) {
    vec3 color;
    if (picture.warps) {
      const vec2 shown = vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) * place / size;
      const vec2 p = shared::warped_point(shown, place, picture.warp_phase) * size / place - 0.5f;
      const vec2 base = glm::floor(p), f = p - base;
      const int i = static_cast<int>(base.x), j = static_cast<int>(base.y);
      color = glm::mix(glm::mix(at(i, j), at(i + 1, j), f.x), glm::mix(at(i, j + 1), at(i + 1, j + 1), f.x), f.y);
    } else {
      color = at(x, static_cast<int>(y));
    }
    to[x] = pack(color * kept + tint);
  }
}

// A row of the source, scaled across: four channels a pixel.
void scale_across(const std::uint32_t* row, std::uint32_t width, const std::vector<Taps>& taps,
                  std::vector<std::int16_t>& padded, std::int16_t* to) {
  const auto put = [&](std::uint32_t at, std::uint32_t p) {
    for (unsigned c = 0; c < 4; ++c) padded[4u * at + c] = static_cast<std::int16_t>(channel(p, c) << kRowBits);
  };
  put(0, row[0]);
  put(1, row[0]);
  for (std::uint32_t x = 0; x < width; ++x) put(x + 2, row[x]);
  put(width + 2, row[width - 1]);
  put(width + 3, row[width - 1]);
  for (const Taps& tap : taps) {
    const std::int16_t* from = &padded[4u * tap.first];
    for (unsigned c = 0; c < 4; ++c) {
      const int sum = from[c] * tap.weights[0] + from[4 + c] * tap.weights[1] + from[8 + c] * tap.weights[2] +
                      from[12 + c] * tap.weights[3];
      to[c] = static_cast<std::int16_t>((sum + (1 << (kWeightBits - 1))) >> kWeightBits);
    }
    to += 4;
  }
}

std::int16_t product(std::int16_t a, std::int16_t weight) {
  return static_cast<std::int16_t>((static_cast<std::int32_t>(a) * weight) >> 16);  // times 16
}

// Four such rows, scaled down.
void scale_down(const std::array<const std::int16_t*, 4>& rows, const std::array<std::int16_t, 4>& weights,
                std::size_t channels, std::uint8_t* to) {
  const std::int16_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
  for (std::size_t i = 0; i < channels; ++i) {
    const auto sum = static_cast<std::int16_t>(product(a[i], weights[0]) + product(b[i], weights[1]) +
                                               product(c[i], weights[2]) + product(d[i], weights[3]) + kRounding);
    to[i] = static_cast<std::uint8_t>(std::clamp<std::int16_t>(static_cast<std::int16_t>(sum >> kSumBits), 0, 255));
  }
}

// Rows `first` to `end` of the output that show the picture, from a source of picture.size.
void scale_rows(const PresentedPicture& picture, const std::vector<std::uint32_t>& source,
                const std::vector<Taps>& across, const std::vector<Taps>& down, std::uint32_t first, std::uint32_t end,
                std::span<std::uint32_t> output) {
  const std::size_t width = picture.place.size.x, channels = 4 * width;
  const auto height = static_cast<std::int64_t>(picture.size.y);
  std::vector<std::int16_t> padded(4 * (picture.size.x + 4)), kept(4 * channels);
  std::array<std::int64_t, 4> holds{-1, -1, -1, -1};  // row of the source in each of the four
  const auto scaled = [&](std::int64_t row) -> const std::int16_t* {
    row = std::clamp<std::int64_t>(row, 0, height - 1);
    const auto slot = static_cast<std::size_t>(row % 4);
    std::int16_t* to = &kept[slot * channels];
    if (holds[slot] != row) {
      scale_across(&source[static_cast<std::size_t>(row) * picture.size.x], picture.size.x, across, padded, to);
      holds[slot] = row;
    }
    return to;
  };
  for (std::uint32_t y = first; y < end; ++y) {
    const Taps& tap = down[y];
    const std::int64_t row = static_cast<std::int64_t>(tap.first) - 2;
    const std::array<const std::int16_t*, 4> rows{scaled(row), scaled(row + 1), scaled(row + 2), scaled(row + 3)};
    std::uint32_t* to =
        &output[static_cast<std::size_t>(picture.place.min.y + y) * picture.output.x + picture.place.min.x];
    scale_down(rows, tap.weights, channels, reinterpret_cast<std::uint8_t*>(to));
  }
}

// (x + 127) / 255, rounded, for products of two bytes.
std::uint32_t share_of(std::uint32_t x) { return (x + 128u + ((x + 128u) >> 8u)) >> 8u; }

}  // namespace

std::array<float, 4> cubic_weights(float f, float sharpness) {
  const auto near = [&](float x) { return ((2.0f - sharpness) * x + sharpness - 3.0f) * x * x + 1.0f; };
  const auto far = [&](float x) { return sharpness * (((-x + 5.0f) * x - 8.0f) * x + 4.0f); };
  return {far(1.0f + f), near(f), near(1.0f - f), far(2.0f - f)};
}

void HostPresent::prepare(const scene::DrawList* list) {
  list_.clear();
  if (list == nullptr) return;
  list_ = list->quads;
  if (list->atlas && list->atlas->revision != atlas_revision_ && !list->atlas->texels.empty()) {
    atlas_ = list->atlas->texels;
    atlas_revision_ = list->atlas->revision;
    atlas_width_ = static_cast<std::uint32_t>(list->atlas->width);
  }
}

void HostPresent::draw_quads(const PresentedPicture& picture, std::span<std::uint32_t> output, std::uint32_t first,
                             std::uint32_t end) const {
  std::vector<std::uint32_t> columns;  // of the atlas, one a pixel
  for (const Quad& quad : quads_) {
    // Pixels whose middles lie within.
    const auto from = [](float x) { return static_cast<std::uint32_t>(std::clamp(std::ceil(x - 0.5f), 0.0f, 1e6f)); };
    const std::uint32_t x0 = from(quad.min.x), y0 = std::max(from(quad.min.y), first);
    const std::uint32_t x1 = std::min(from(quad.max.x), picture.output.x);
    const std::uint32_t y1 = std::min(from(quad.max.y), end);
    if (x0 >= x1 || y0 >= y1 || quad.color[3] == 0) continue;
    const vec2 size = quad.max - quad.min;
    if (quad.textured) {
      columns.resize(x1 - x0);
      for (std::uint32_t x = x0; x < x1; ++x) {
        const float s = (static_cast<float>(x) + 0.5f - quad.min.x) / size.x;
        columns[x - x0] = static_cast<std::uint32_t>(glm::mix(quad.uv_min.x, quad.uv_max.x, s));
      }
    }
    const bool plain = quad.color[0] == 255 && quad.color[1] == 255 && quad.color[2] == 255 && quad.color[3] == 255;
    for (std::uint32_t y = y0; y < y1; ++y) {
      std::uint32_t* to = &output[static_cast<std::size_t>(y) * picture.output.x + x0];
      const float t = (static_cast<float>(y) + 0.5f - quad.min.y) / size.y;
      const auto row = static_cast<std::size_t>(quad.textured ? glm::mix(quad.uv_min.y, quad.uv_max.y, t) : 0.0f);
      for (std::uint32_t i = 0; i < x1 - x0; ++i) {
        std::array<std::uint32_t, 4> c = quad.color;
        if (quad.textured) {
          const std::size_t at = std::min(row * atlas_width_ + columns[i], atlas_.size() - 1);
          const std::uint32_t texel = picture.swap_red_blue ? swapped(atlas_[at]) : atlas_[at];
          const std::uint32_t alpha = texel >> 24u;
          if (alpha == 0) continue;
          if (plain && alpha == 255) {
            to[i] = texel;
            continue;
          }
          for (unsigned k = 0; k < 4; ++k) c[k] = share_of(c[k] * channel(texel, k));
        }
        std::uint32_t mixed = kBlack;
        for (unsigned k = 0; k < 3; ++k) mixed |= share_of(channel(to[i], k) * (255u - c[3]) + c[k] * c[3]) << (8u * k);
        to[i] = mixed;
      }
    }
  }
}

void HostPresent::draw(const PresentedPicture& picture, std::span<const std::uint32_t> pixels,
                       std::span<std::uint32_t> output) {
  const std::size_t texels = static_cast<std::size_t>(picture.size.x) * picture.size.y;
  FB_CHECK_LE(texels, pixels.size());
  FB_CHECK_LE(static_cast<std::size_t>(picture.output.x) * picture.output.y, output.size());
  const bool as_it_is = !picture.warps && picture.tint.w == 0.0f;
  source_.resize(texels);
  parallel_for(picture.size.y, kBand, [&](std::size_t y) {
    std::uint32_t* row = &source_[y * picture.size.x];
    if (as_it_is)
      std::copy_n(&pixels[y * picture.size.x], picture.size.x, row);
    else
      take_row(picture, pixels, static_cast<std::uint32_t>(y), row);
    if (picture.swap_red_blue) std::transform(row, row + picture.size.x, row, swapped);
  });

  quads_.clear();
  for (const scene::DrawQuad& q : list_) {
    const auto of_255 = [](float x) { return static_cast<std::uint32_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f); };
    std::array<std::uint32_t, 4> color{of_255(q.color.x), of_255(q.color.y), of_255(q.color.z), of_255(q.color.w)};
    if (picture.swap_red_blue) std::swap(color[0], color[2]);
    quads_.push_back({q.min, q.max, q.uv_min, q.uv_max, color, q.uv_min != q.uv_max && !atlas_.empty()});
  }

  const scene::Area place = picture.place;
  const bool scales = place.size != picture.size;
  std::vector<Taps> across, down;
  if (scales) {
    across = taps_of(picture.size.x, place.size.x, picture.sharpness);
    down = taps_of(picture.size.y, place.size.y, picture.sharpness);
  }
  std::array<std::uint32_t, 256> curve{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    const float shown = std::clamp(static_cast<float>(i) / 255.0f * picture.contrast, 0.0f, 1.0f);
    curve[i] = static_cast<std::uint32_t>(std::pow(shown, picture.gamma) * 255.0f + 0.5f);
  }
  const std::uint32_t bands = (picture.output.y + kBand - 1) / kBand;
  parallel_for(bands, 1, [&](std::size_t band) {
    const auto first = static_cast<std::uint32_t>(band * kBand);
    const std::uint32_t end = std::min(first + kBand, picture.output.y);
    const std::uint32_t from = std::clamp(first, place.min.y, place.min.y + place.size.y);
    const std::uint32_t to = std::clamp(end, place.min.y, place.min.y + place.size.y);
    std::uint32_t* rows = &output[static_cast<std::size_t>(first) * picture.output.x];
    if (place.size != picture.output)
      std::fill_n(rows, static_cast<std::size_t>(end - first) * picture.output.x, kBlack);
    if (scales) {
      scale_rows(picture, source_, across, down, from - place.min.y, to - place.min.y, output);
    } else {
      for (std::uint32_t y = from; y < to; ++y)
        std::copy_n(&source_[static_cast<std::size_t>(y - place.min.y) * picture.size.x], picture.size.x,
                    &output[static_cast<std::size_t>(y) * picture.output.x + place.min.x]);
    }
    draw_quads(picture, output, first, end);
    if (picture.gamma == 1.0f && picture.contrast == 1.0f) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(end - first) * picture.output.x; ++i)
      rows[i] = curve[channel(rows[i], 0)] | (curve[channel(rows[i], 1)] << 8u) | (curve[channel(rows[i], 2)] << 16u) |
                kBlack;
  });
}

}  // namespace fb::render
