#include "panel/draw_data.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fb::panel {
namespace {

struct Corner {
  vec2 at, uv;  // output pixels; texels of the list's atlas
  vec4 color;
};

struct Writer {
  scene::DrawList& list;
  vec2 clip_min{0.0f}, clip_max{0.0f};

  // The part inside the clip; the texels go with it.
  void quad(vec2 min, vec2 max, vec2 uv_min, vec2 uv_max, const vec4& color) const {
    const vec2 inner_min = glm::max(min, clip_min), inner_max = glm::min(max, clip_max);
    if (!(inner_max.x > inner_min.x && inner_max.y > inner_min.y) || !(color.w > 0.0f)) return;
    const vec2 texels = (uv_max - uv_min) / (max - min);
    list.quads.push_back(
        {inner_min, inner_max, uv_min + (inner_min - min) * texels, uv_min + (inner_max - min) * texels, color});
  }

  // Two triangles a b c, a c d that are an upright rectangle.
  bool rectangle(const Corner& a, const Corner& b, const Corner& c, const Corner& d) const {
    const bool along_x = a.at.y == b.at.y && b.at.x == c.at.x && c.at.y == d.at.y && d.at.x == a.at.x;
    const bool along_y = a.at.x == b.at.x && b.at.y == c.at.y && c.at.x == d.at.x && d.at.y == a.at.y;
    if (!along_x && !along_y) return false;
    const bool turned = a.at.x > c.at.x, upside_down = a.at.y > c.at.y;
    const vec2 uv_min(turned ? c.uv.x : a.uv.x, upside_down ? c.uv.y : a.uv.y);
    const vec2 uv_max(turned ? a.uv.x : c.uv.x, upside_down ? a.uv.y : c.uv.y);
    quad(glm::min(a.at, c.at), glm::max(a.at, c.at), uv_min, uv_max, a.color);
    return true;
  }

  // One colour, no texture: row by row, as far as pixels' centres lie inside.
  void triangle(const std::array<Corner, 3>& corners) const {
    const auto [low, high] = std::minmax({corners[0].at.y, corners[1].at.y, corners[2].at.y});
    for (float row = std::ceil(std::max(low, clip_min.y) - 0.5f); row + 0.5f < std::min(high, clip_max.y);
         row += 1.0f) {
      float left = 1e9f, right = -1e9f;
      for (std::size_t i = 0; i < 3; ++i) {
        const vec2 &from = corners[i].at, &to = corners[(i + 1) % 3].at;
        const float y = row + 0.5f;
        if (from.y == to.y || y < std::min(from.y, to.y) || y > std::max(from.y, to.y)) continue;
        const float x = from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y);
        left = std::min(left, x);
        right = std::max(right, x);
      }
      const vec2 uv = corners[0].uv;
      quad({left, row}, {right, row + 1.0f}, uv, uv, corners[0].color);
    }
  }
};

vec4 color_of(ImU32 packed) {
  const ImVec4 color = ImGui::ColorConvertU32ToFloat4(packed);
  return {color.x, color.y, color.z, color.w};
}

}  // namespace

void append_draw_data(scene::DrawList& list, const ImDrawData& data, const ui::Picture& font, float scale) {
  const vec2 origin(data.DisplayPos.x, data.DisplayPos.y);
  const vec2 font_at(font.x, font.y), font_size(font.width, font.height);
  Writer writer{list};
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& commands = *data.CmdLists[l];
    const auto corner = [&](const ImDrawCmd& command, unsigned index) {
      const ImDrawVert& v = commands.VtxBuffer[static_cast<int>(
          command.VtxOffset + commands.IdxBuffer[static_cast<int>(command.IdxOffset + index)])];
      return Corner{(vec2(v.pos.x, v.pos.y) - origin) * scale, font_at + vec2(v.uv.x, v.uv.y) * font_size,
                    color_of(v.col)};
    };
    for (const ImDrawCmd& command : commands.CmdBuffer) {
      if (command.UserCallback != nullptr) continue;  // this program sets none
      writer.clip_min = (vec2(command.ClipRect.x, command.ClipRect.y) - origin) * scale;
      writer.clip_max = (vec2(command.ClipRect.z, command.ClipRect.w) - origin) * scale;
      const auto index = [&](unsigned i) { return commands.IdxBuffer[static_cast<int>(command.IdxOffset + i)]; };
      for (unsigned i = 0; i + 3 <= command.ElemCount;) {
        const std::array<Corner, 3> first = {corner(command, i), corner(command, i + 1), corner(command, i + 2)};
        const bool pair = i + 6 <= command.ElemCount && index(i) == index(i + 3) && index(i + 2) == index(i + 4);
        if (pair && writer.rectangle(first[0], first[1], first[2], corner(command, i + 5))) {
          i += 6;
        } else {
          writer.triangle(first);
          i += 3;
        }
      }
    }
  }
}

}  // namespace fb::panel
