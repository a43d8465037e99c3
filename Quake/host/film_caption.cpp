#include "host/film_caption.h"

#include <algorithm>
#include <cmath>

#include "ui/painter.h"

namespace fb::host {
namespace {

constexpr int kMargin = 2, kLineHeight = 10;  // virtual pixels

vec4 unpacked(std::uint32_t p) { return vec4(p & 0xffu, (p >> 8u) & 0xffu, (p >> 16u) & 0xffu, p >> 24u) / 255.0f; }

std::uint32_t packed(const vec3& color) {
  std::uint32_t value = 0xff000000u;
  for (int c = 0; c < 3; ++c)
    value |= static_cast<std::uint32_t>(std::lround(255 * std::clamp(color[c], 0.0f, 1.0f))) << (8 * c);
  return value;
}

}  // namespace

void draw_over(lab::FilmFrame& frame, const scene::DrawList& list) {
  for (const scene::DrawQuad& quad : list.quads) {
    const vec2 low = glm::max(glm::ceil(quad.min - 0.5f), vec2(0.0f));
    const vec2 high = glm::min(glm::ceil(quad.max - 0.5f), vec2(frame.size));
    for (auto y = static_cast<std::uint32_t>(low.y); static_cast<float>(y) < high.y; ++y)
      for (auto x = static_cast<std::uint32_t>(low.x); static_cast<float>(x) < high.x; ++x) {
        vec4 color = quad.color;
        if (quad.uv_min != quad.uv_max) {
          const vec2 share = (vec2(x, y) + 0.5f - quad.min) / (quad.max - quad.min);
          const auto texel = uvec2(quad.uv_min + (quad.uv_max - quad.uv_min) * share);
          color *= unpacked(
              list.atlas->texels[std::size_t{texel.y} * static_cast<std::size_t>(list.atlas->width) + texel.x]);
        }
        std::uint32_t& pixel = frame.pixels[std::size_t{y} * frame.size.x + x];
        pixel = packed(glm::mix(vec3(unpacked(pixel)), vec3(color), color.w));
      }
  }
}

void draw_caption(lab::FilmFrame& frame, ui::Atlas& atlas, const lab::LaneColumns& columns,
                  const std::vector<std::string>& lines) {
  std::size_t longest = 0;
  for (const std::string& line : lines) longest = std::max(longest, line.size());
  const int width = static_cast<int>(columns.end) - static_cast<int>(columns.begin);
  const int wanted = static_cast<int>(longest) * 8 + 4 * kMargin;
  const int scale = std::clamp(width / std::max(wanted, 1), 1,
                               ui::automatic_scale(static_cast<int>(frame.size.x), static_cast<int>(frame.size.y)));
  const int fits = (width / scale - 4 * kMargin) / 8;
  if (fits < 1 || longest == 0) return;
  scene::DrawList list;
  {
    const ui::Canvas canvas{vec2(static_cast<float>(columns.begin), 0.0f), static_cast<float>(scale), width / scale,
                            static_cast<int>(frame.size.y) / scale};
    ui::Painter painter(list, atlas, canvas);
    const int letters = std::min(static_cast<int>(longest), fits);
    painter.fill(kMargin, kMargin, static_cast<float>(8 * letters + 2 * kMargin),
                 static_cast<float>(kLineHeight * static_cast<int>(lines.size()) + kMargin), vec4(0, 0, 0, 0.6f));
    for (std::size_t i = 0; i < lines.size(); ++i)
      painter.text(2 * kMargin, static_cast<float>(2 * kMargin + kLineHeight * static_cast<int>(i)),
                   lines[i].substr(0, static_cast<std::size_t>(fits)), i == 0);
  }
  draw_over(frame, list);
}

}  // namespace fb::host
