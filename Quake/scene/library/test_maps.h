// For tests: maps built in code, and files in memory.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bsp.h"
#include "scene/library/library.h"

namespace fb::scene::test {

struct TestFiles {
  std::map<std::string, Bytes, std::less<>> files;
  FileLoader loader() const {
    return [this](std::string_view path) -> std::optional<Bytes> {
      const auto found = files.find(path);
      if (found == files.end()) return std::nullopt;
      return found->second;
    };
  }
  // A palette whose index i is (i, i, i), but 224 and up are (255, 128, 0).
  void add_palette() {
    Bytes& palette = files["gfx/palette.lmp"];
    for (int i = 0; i < 256; ++i)
      for (int channel = 0; channel < 3; ++channel)
        palette.push_back(static_cast<std::uint8_t>(i < 224 ? i : channel == 0 ? 255 : channel == 1 ? 128 : 0));
  }
  // A 24-bit TGA of one colour.
  void add_tga(const std::string& path, int width, int height, std::array<std::uint8_t, 3> rgb) {
    Bytes tga{
        0, 0,  2,   0, 0, 0, 0, 0, 0, 0, 0, 0, static_cast<std::uint8_t>(width), 0, static_cast<std::uint8_t>(height),
        0, 24, 0x20};
    for (int i = 0; i < width * height; ++i) tga.insert(tga.end(), {rgb[2], rgb[1], rgb[0]});
    files[path] = std::move(tga);
  }
};

inline formats::BspTexture texture(std::string name, std::uint8_t index = 10, int width = 16, int height = 16) {
  return {std::move(name), width, height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), index)};
}

// Faces one by one; model 0 holds them all. The only leaf is empty, so that lights find room everywhere.
class MapBuilder {
 public:
  MapBuilder() {
    formats::BspLeaf solid{}, empty{};
    solid.contents = formats::kContentsSolid;
    empty.contents = formats::kContentsEmpty;
    empty.vis_offset = solid.vis_offset = -1;
    bsp.leafs = {solid, empty};
    formats::BspModel model{};
    model.head_nodes = {~1, -1, -1, -1};
    bsp.models = {model};
    bsp.edges.push_back({0, 0});  // edge 0 has no negative
  }
  std::uint32_t add_texture(formats::BspTexture t) {
    bsp.textures.push_back(std::move(t));
    return static_cast<std::uint32_t>(bsp.textures.size() - 1);
  }
  // Corners clockwise as seen from the front, as in Quake. The plane's normal is `normal`, or the opposite with
  // back_side; s runs along x, t along -y.
  void add_face(const std::vector<vec3>& corners, const vec3& normal, std::uint32_t texture_index,
                bool back_side = false) {
    formats::BspPlane plane{back_side ? -normal : normal, 0.0f, 0};
    plane.distance = glm::dot(plane.normal, corners[0]);
    std::uint32_t plane_index = 0;
    while (plane_index < bsp.planes.size() &&
           (bsp.planes[plane_index].normal != plane.normal || bsp.planes[plane_index].distance != plane.distance))
      ++plane_index;
    if (plane_index == bsp.planes.size()) bsp.planes.push_back(plane);
    bsp.texinfos.push_back({{vec4(1, 0, 0, 0), vec4(0, -1, 0, 0)}, texture_index, 0});
    formats::BspFace face{};
    face.plane = plane_index;
    face.back_side = back_side;
    face.texinfo = static_cast<std::uint32_t>(bsp.texinfos.size() - 1);
    face.first_surfedge = static_cast<std::uint32_t>(bsp.surfedges.size());
    face.surfedge_count = static_cast<std::uint32_t>(corners.size());
    face.light_offset = -1;
    const auto first = static_cast<std::uint32_t>(bsp.vertices.size());
    bsp.vertices.insert(bsp.vertices.end(), corners.begin(), corners.end());
    for (std::uint32_t k = 0; k < face.surfedge_count; ++k) {
      bsp.surfedges.push_back(static_cast<std::int32_t>(bsp.edges.size()));
      bsp.edges.push_back({first + k, first + (k + 1) % face.surfedge_count});
    }
    bsp.faces.push_back(face);
    bsp.models[0].face_count = static_cast<std::uint32_t>(bsp.faces.size());
  }
  // A horizontal square from (x, y) of `side`, seen from above (or from below).
  void add_square(float x, float y, float z, float side, std::uint32_t texture_index, bool from_above = true) {
    std::vector<vec3> corners{{x, y, z}, {x, y + side, z}, {x + side, y + side, z}, {x + side, y, z}};
    if (!from_above) corners = {corners[0], corners[3], corners[2], corners[1]};
    add_face(corners, vec3(0, 0, from_above ? 1 : -1), texture_index, !from_above);
  }

  formats::Bsp bsp;
};

}  // namespace fb::scene::test
