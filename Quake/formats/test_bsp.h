// Small valid maps and .vis files made in code, for tests and for the fuzzers' seeds (test_bytes.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "formats/bsp.h"
#include "formats/test_bytes.h"

namespace fb::formats::testing {

// The texture lump: a texture without a name has no entry (-1); one with a name but no texels is in an external file,
// and in Quake 64's maps, which know no such, nothing follows its header.
inline Bytes write_texture_lump(const std::vector<BspTexture>& textures, bool quake64 = false) {
  ByteWriter w;
  w.u32(static_cast<std::uint32_t>(textures.size()));
  for (std::size_t i = 0; i < textures.size(); ++i) w.u32(0xffffffffu);
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const BspTexture& texture = textures[i];
    if (texture.name.empty()) continue;
    w.patch_u32(4 + 4 * i, static_cast<std::uint32_t>(w.out.size()));
    w.text(texture.name, 16);
    w.u32(static_cast<std::uint32_t>(texture.width));
    w.u32(static_cast<std::uint32_t>(texture.height));
    if (quake64) w.i32(texture.shift);
    std::uint32_t at = quake64 ? 44 : 40;
    std::size_t texels = texture.indices.size();
    for (int mip = 0; mip < 4; ++mip, texels /= 4) {
      w.u32(texture.missing() ? 0 : at);
      at += static_cast<std::uint32_t>(texels);
    }
    w.bytes(texture.indices);
    for (std::size_t mip = texture.indices.size() / 4, k = 1; k < 4; ++k, mip /= 4) w.bytes(Bytes(mip, 7));
  }
  return w.out;
}

class BspWriter {
 public:
  explicit BspWriter(const Bsp& bsp)
      : bsp_(bsp),
        quake64_(bsp.version == BspVersion::kQuake64),
        wide_(bsp.version != BspVersion::kBsp29 && !quake64_) {}

  Bytes write() {
    file_.u32(quake64_ ? 0x51363420u : bsp_.version == BspVersion::kBsp29 ? 29u : 0u);
    if (wide_) {
      const std::string_view magic = bsp_.version == BspVersion::kBsp2 ? "BSP2" : "2PSB";
      std::copy(magic.begin(), magic.end(), file_.out.begin());
    }
    for (int i = 0; i < 30; ++i) file_.u32(0);
    lump(0, [&] { file_.text(bsp_.entities, bsp_.entities.size() + 1); });
    lump(1, [&] { planes(); });
    lump(2, [&] { file_.bytes(write_texture_lump(bsp_.textures, quake64_)); });
    lump(3, [&] { std::for_each(bsp_.vertices.begin(), bsp_.vertices.end(), [&](const vec3& v) { file_.vec(v); }); });
    lump(4, [&] { file_.bytes(bsp_.visibility); });
    lump(5, [&] { nodes(); });
    lump(6, [&] { texinfos(); });
    lump(7, [&] { faces(); });
    lump(8, [&] { light(); });
    lump(9, [&] { clip_nodes(); });
    lump(10, [&] { leafs(); });
    lump(11, [&] { std::for_each(bsp_.mark_faces.begin(), bsp_.mark_faces.end(), [&](auto f) { index(f); }); });
    lump(12, [&] {
      for (const auto& edge : bsp_.edges) {
        index(edge[0]);
        index(edge[1]);
      }
    });
    lump(13, [&] { std::for_each(bsp_.surfedges.begin(), bsp_.surfedges.end(), [&](auto e) { file_.i32(e); }); });
    lump(14, [&] { models(); });
    bspx();
    return std::move(file_.out);
  }

 private:
  void index(std::uint32_t v) { wide_ ? file_.u32(v) : file_.u16(v & 0xffffu); }
  void bound(const vec3& v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (bsp_.version == BspVersion::kBsp2)
        file_.f32(v[axis]);
      else
        file_.u16(static_cast<std::uint16_t>(static_cast<std::int16_t>(v[axis])));
    }
  }
  template <typename Body>
  void lump(std::size_t i, const Body& body) {
    while (file_.out.size() % 4 != 0) file_.u8(0);
    const std::size_t start = file_.out.size();
    body();
    file_.patch_u32(4 + 8 * i, static_cast<std::uint32_t>(start));
    file_.patch_u32(8 + 8 * i, static_cast<std::uint32_t>(file_.out.size() - start));
  }
  void planes() {
    for (const BspPlane& plane : bsp_.planes) {
      file_.vec(plane.normal);
      file_.f32(plane.distance);
      file_.i32(plane.type);
    }
  }
  void nodes() {
    for (const BspNode& node : bsp_.nodes) {
      file_.u32(node.plane);
      for (const std::int32_t child : node.children) index(static_cast<std::uint32_t>(child));
      bound(node.mins);
      bound(node.maxs);
      index(node.first_face);
      index(node.face_count);
    }
  }
  void texinfos() {
    for (const BspTexInfo& info : bsp_.texinfos) {
      for (const vec4& axis : info.axes) {
        for (int k = 0; k < 4; ++k) file_.f32(axis[k]);
      }
      file_.u32(info.texture);
      file_.u32(info.flags);
    }
  }
  void faces() {
    for (const BspFace& face : bsp_.faces) {
      index(face.plane);
      index(face.back_side ? 1 : 0);
      file_.u32(face.first_surfedge);
      index(face.surfedge_count);
      index(face.texinfo);
      file_.bytes(face.styles);
      file_.i32(quake64_ && face.light_offset > 0 ? 2 * face.light_offset : face.light_offset);
    }
  }
  void clip_nodes() {
    for (const BspClipNode& node : bsp_.clip_nodes) {
      file_.u32(node.plane);
      for (const std::int32_t child : node.children) index(static_cast<std::uint32_t>(child));
    }
  }
  void leafs() {
    for (const BspLeaf& leaf : bsp_.leafs) {
      file_.i32(leaf.contents);
      file_.i32(leaf.vis_offset);
      bound(leaf.mins);
      bound(leaf.maxs);
      index(leaf.first_mark_face);
      index(leaf.mark_face_count);
      file_.bytes(leaf.ambient);
    }
  }
  void models() {
    for (const BspModel& model : bsp_.models) {
      file_.vec(model.mins);
      file_.vec(model.maxs);
      file_.vec(model.origin);
      for (const std::int32_t head : model.head_nodes) file_.i32(head);
      file_.u32(model.visible_leafs);
      file_.u32(model.first_face);
      file_.u32(model.face_count);
    }
  }
  // Quake 64's, of RGBLIGHTING: 5, 5 and 6 bits of a sample in a word, its greater byte first.
  void light() {
    if (!quake64_) return file_.bytes(bsp_.lighting);
    for (const auto& [name, rgb] : bsp_.bspx) {
      if (name != "RGBLIGHTING") continue;
      for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        const auto word = static_cast<std::uint32_t>((rgb[i] >> 3) << 11 | (rgb[i + 1] >> 3) << 6 | rgb[i + 2] >> 2);
        file_.u8(word >> 8u);
        file_.u8(word & 0xffu);
      }
    }
  }
  void bspx() {
    if (bsp_.bspx.empty() || quake64_) return;
    while (file_.out.size() % 4 != 0) file_.u8(0);
    file_.text("BSPX", 4);
    file_.u32(static_cast<std::uint32_t>(bsp_.bspx.size()));
    std::size_t at = file_.out.size() + 32 * bsp_.bspx.size();
    for (const auto& [name, bytes] : bsp_.bspx) {
      file_.text(name, 24);
      file_.u32(static_cast<std::uint32_t>(at));
      file_.u32(static_cast<std::uint32_t>(bytes.size()));
      at += bytes.size();
    }
    for (const auto& [name, bytes] : bsp_.bspx) file_.bytes(bytes);
  }

  const Bsp& bsp_;
  bool quake64_, wide_;
  ByteWriter file_;
};

inline Bytes write_bsp(const Bsp& bsp) { return BspWriter(bsp).write(); }

// A hollow cube from -128 to 128, lit, with one wall in a missing texture and one in an external texture; leaf 0 is the
// solid around it, leaf 1 the room. A second model is an empty brush.
inline Bsp box_room(BspVersion version) {
  constexpr float kHalf = 128.0f;
  constexpr std::size_t kSamples = 17 * 17;  // a face of 256 units, one sample in 16
  Bsp bsp;
  bsp.version = version;
  bsp.entities =
      "{\n\"classname\" \"worldspawn\"\n}\n{\n\"classname\" \"info_player_start\"\n\"origin\" \"0 0 0\"\n}\n";
  BspTexture wall{"wall", 16, 16, {}};
  for (std::uint32_t i = 0; i < 256; ++i) wall.indices.push_back(static_cast<std::uint8_t>(i));
  bsp.textures = {wall, {"outside", 32, 16, {}}, {"", 16, 16, {}}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    bsp.vertices.emplace_back((i & 1u) != 0 ? kHalf : -kHalf, (i & 2u) != 0 ? kHalf : -kHalf,
                              (i & 4u) != 0 ? kHalf : -kHalf);
  }
  bsp.edges.push_back({0, 0});  // surfedge 0 has no sign, so edge 0 is not used
  const auto add_surfedge = [&](std::uint32_t from, std::uint32_t to) {
    for (std::size_t e = 1; e < bsp.edges.size(); ++e) {
      if (bsp.edges[e] == std::array{to, from}) {
        bsp.surfedges.push_back(-static_cast<std::int32_t>(e));
        return;
      }
    }
    bsp.surfedges.push_back(static_cast<std::int32_t>(bsp.edges.size()));
    bsp.edges.push_back({from, to});
  };
  const vec3 low(-kHalf), high(kHalf);
  for (std::uint32_t wall_index = 0; wall_index < 6; ++wall_index) {
    const std::uint32_t axis = wall_index / 2;
    const bool upper = wall_index % 2 != 0;
    const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, base = upper ? 1u << axis : 0;
    BspPlane plane{vec3(0.0f), upper ? kHalf : -kHalf, static_cast<std::int32_t>(axis)};
    plane.normal[static_cast<int>(axis)] = 1.0f;
    bsp.planes.push_back(plane);

    std::array<std::uint32_t, 4> corners = {base, base + v, base + u + v, base + u};  // clockwise, seen from the front
    if (upper) std::reverse(corners.begin(), corners.end());
    const auto first = static_cast<std::uint32_t>(bsp.surfedges.size());
    for (std::size_t k = 0; k < 4; ++k) add_surfedge(corners[k], corners[(k + 1) % 4]);
    BspTexInfo info{};
    info.axes[0][static_cast<int>((axis + 1) % 3)] = 1.0f;
    info.axes[1][static_cast<int>((axis + 2) % 3)] = 1.0f;
    info.texture = wall_index < 4 ? 0 : wall_index - 3;
    bsp.texinfos.push_back(info);
    bsp.faces.push_back({wall_index,
                         upper,
                         first,
                         4,
                         wall_index,
                         {0, 255, 255, 255},
                         static_cast<std::int32_t>(wall_index * kSamples)});
    bsp.mark_faces.push_back(wall_index);

    // Each node cuts off one wall; the rest goes to the next node, and what remains at the end is the room.
    const std::int32_t next = wall_index + 1 < 6 ? static_cast<std::int32_t>(wall_index + 1) : ~1;
    const std::int32_t next_clip = wall_index + 1 < 6 ? next : static_cast<std::int32_t>(kContentsEmpty);
    BspNode node{wall_index, {next, ~0}, low, high, wall_index, 1};
    BspClipNode clip{wall_index, {next_clip, kContentsSolid}};
    if (upper) {
      std::swap(node.children[0], node.children[1]);
      std::swap(clip.children[0], clip.children[1]);
    }
    bsp.nodes.push_back(node);
    bsp.clip_nodes.push_back(clip);
  }
  bsp.leafs = {{kContentsSolid, -1, vec3(0.0f), vec3(0.0f), 0, 0, {}},
               {kContentsEmpty, 0, low, high, 0, 6, {1, 2, 3, 4}}};
  bsp.visibility = {1};
  if (version == BspVersion::kQuake64) {
    bsp.bspx = {{"RGBLIGHTING", {}}};
    for (std::size_t i = 0; i < 6 * kSamples; ++i)
      for (const std::size_t level : {i % 32 * 8, i % 31 * 8, i % 64 * 4})
        bsp.bspx[0].second.push_back(static_cast<std::uint8_t>(level));
    bsp.textures[0].shift = 2;
    bsp.textures[1].name = "";  // there are no external ones
  } else {
    for (std::size_t i = 0; i < 6 * kSamples; ++i) bsp.lighting.push_back(static_cast<std::uint8_t>(i));
  }
  bsp.models = {{low, high, vec3(0.0f), {0, 0, 0, kContentsEmpty}, 1, 0, 6},
                {low, high, vec3(0.0f), {~0, kContentsSolid, kContentsSolid, kContentsEmpty}, 0, 0, 0}};
  return bsp;
}

// A tree of `count` nodes, each the child of the one before: of the greatest possible depth.
inline Bsp deep_room(BspVersion version, std::uint32_t count) {
  Bsp bsp = box_room(version);
  bsp.nodes.assign(count, bsp.nodes[0]);
  for (std::uint32_t i = 0; i < count; ++i) {
    bsp.nodes[i].children = {i + 1 < count ? static_cast<std::int32_t>(i + 1) : ~1, ~0};
  }
  return bsp;
}

// An external .vis: one record for each map.
inline Bytes write_vis(const std::vector<std::pair<std::string, Bsp>>& maps) {
  ByteWriter w;
  for (const auto& [name, bsp] : maps) {
    ByteWriter leafs;
    for (const BspLeaf& leaf : bsp.leafs) {
      leafs.i32(leaf.contents);
      leafs.i32(leaf.vis_offset);
      for (const vec3& corner : {leaf.mins, leaf.maxs}) {
        for (int axis = 0; axis < 3; ++axis) leafs.u16(static_cast<std::uint16_t>(static_cast<int>(corner[axis])));
      }
      leafs.u16(leaf.first_mark_face);
      leafs.u16(leaf.mark_face_count);
      leafs.bytes(leaf.ambient);
    }
    w.text(name, 32);
    w.u32(static_cast<std::uint32_t>(8 + bsp.visibility.size() + leafs.out.size()));
    w.u32(static_cast<std::uint32_t>(bsp.visibility.size()));
    w.bytes(bsp.visibility);
    w.u32(static_cast<std::uint32_t>(leafs.out.size()));
    w.bytes(leafs.out);
  }
  return w.out;
}

}  // namespace fb::formats::testing
