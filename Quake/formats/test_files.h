// Small valid files made in code, for tests and for the fuzzers' seeds. The writers check nothing: a test breaks a
// structure, writes it, and checks the parser's answer. Images have their own writers in test_images.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "formats/bsp.h"
#include "formats/dem.h"
#include "formats/mdl.h"
#include "formats/spr.h"

namespace fb::formats::testing {

// Little-endian bytes, appended.
class ByteWriter {
 public:
  Bytes out;

  void u8(std::uint32_t v) { out.push_back(static_cast<std::uint8_t>(v)); }
  void u16(std::uint32_t v) {
    u8(v & 0xffu);
    u8(v >> 8u & 0xffu);
  }
  void u32(std::uint32_t v) {
    u16(v & 0xffffu);
    u16(v >> 16u);
  }
  void i32(std::int32_t v) { u32(static_cast<std::uint32_t>(v)); }
  void f32(float v) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    u32(bits);
  }
  void vec(const vec3& v) {
    for (int axis = 0; axis < 3; ++axis) f32(v[axis]);
  }
  // A field of n bytes, padded with zeros.
  void text(std::string_view s, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) u8(i < s.size() ? static_cast<std::uint8_t>(s[i]) : 0u);
  }
  void bytes(ByteView data) { out.insert(out.end(), data.begin(), data.end()); }
  void patch_u32(std::size_t at, std::uint32_t v) {
    for (std::size_t i = 0; i < 4; ++i) out[at + i] = static_cast<std::uint8_t>(v >> (8 * i));
  }
};

// --- maps ---

// The texture lump: a texture without a name has no entry (-1); one with a name but no texels is in an external file.
inline Bytes write_texture_lump(const std::vector<BspTexture>& textures) {
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
    std::uint32_t at = 40;
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
  explicit BspWriter(const Bsp& bsp) : bsp_(bsp), wide_(bsp.version != BspVersion::kBsp29) {}

  Bytes write() {
    file_.u32(bsp_.version == BspVersion::kBsp29 ? 29u : 0u);
    if (bsp_.version != BspVersion::kBsp29) {
      const std::string_view magic = bsp_.version == BspVersion::kBsp2 ? "BSP2" : "2PSB";
      std::copy(magic.begin(), magic.end(), file_.out.begin());
    }
    for (int i = 0; i < 30; ++i) file_.u32(0);
    lump(0, [&] { file_.text(bsp_.entities, bsp_.entities.size() + 1); });
    lump(1, [&] { planes(); });
    lump(2, [&] { file_.bytes(write_texture_lump(bsp_.textures)); });
    lump(3, [&] { std::for_each(bsp_.vertices.begin(), bsp_.vertices.end(), [&](const vec3& v) { file_.vec(v); }); });
    lump(4, [&] { file_.bytes(bsp_.visibility); });
    lump(5, [&] { nodes(); });
    lump(6, [&] { texinfos(); });
    lump(7, [&] { faces(); });
    lump(8, [&] { file_.bytes(bsp_.lighting); });
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
      file_.i32(face.light_offset);
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
  void bspx() {
    if (bsp_.bspx.empty()) return;
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
  bool wide_;
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
  for (std::size_t i = 0; i < 6 * kSamples; ++i) bsp.lighting.push_back(static_cast<std::uint8_t>(i));
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

// --- alias models ---

inline Bytes write_mdl(const Mdl& mdl) {
  ByteWriter w;
  w.text("IDPO", 4);
  w.u32(6);
  w.vec(mdl.scale);
  w.vec(mdl.origin);
  w.f32(mdl.bounding_radius);
  w.vec(mdl.eye_position);
  w.u32(static_cast<std::uint32_t>(mdl.skins.size()));
  w.i32(mdl.skin_width);
  w.i32(mdl.skin_height);
  w.u32(mdl.vertex_count);
  w.u32(static_cast<std::uint32_t>(mdl.triangles.size()));
  w.u32(static_cast<std::uint32_t>(mdl.frames.size()));
  w.i32(mdl.sync_type);
  w.u32(mdl.flags);
  w.f32(10.0f);
  for (const MdlSkin& skin : mdl.skins) {
    w.u32(skin.end_times.empty() ? 0 : 1);
    if (!skin.end_times.empty()) w.u32(static_cast<std::uint32_t>(skin.images.size()));
    for (const float time : skin.end_times) w.f32(time);
    for (const IndexedImage& image : skin.images) w.bytes(image.indices);
  }
  for (const MdlTexCoord& coord : mdl.tex_coords) {
    w.u32(coord.on_seam ? 0x20 : 0);
    w.i32(coord.s);
    w.i32(coord.t);
  }
  for (const MdlTriangle& triangle : mdl.triangles) {
    w.u32(triangle.faces_front ? 1 : 0);
    for (const std::uint32_t vertex : triangle.vertices) w.u32(vertex);
  }
  for (const MdlFrame& frame : mdl.frames) {
    w.u32(frame.end_times.empty() ? 0 : 1);
    if (!frame.end_times.empty()) {
      w.u32(frame.pose_count);
      w.u32(0);
      w.u32(0xffffffu);
      for (const float time : frame.end_times) w.f32(time);
    }
    for (std::uint32_t pose = frame.first_pose; pose < frame.first_pose + frame.pose_count; ++pose) {
      w.u32(0);
      w.u32(0xffffffu);
      w.text(frame.name, 16);
      for (std::uint32_t i = 0; i < mdl.vertex_count; ++i) {
        const MdlVertex& vertex = mdl.vertices[std::size_t{pose} * mdl.vertex_count + i];
        for (const std::uint8_t byte : {vertex.x, vertex.y, vertex.z, vertex.normal}) w.u8(byte);
      }
    }
  }
  return w.out;
}

// A tetrahedron with a skin and a group of two skins, a frame and a group of two poses.
inline Mdl tetrahedron() {
  Mdl mdl;
  mdl.scale = vec3(0.25f, 0.5f, 1.0f);
  mdl.origin = vec3(-1.0f, -2.0f, -3.0f);
  mdl.eye_position = vec3(0.0f, 0.0f, 22.0f);
  mdl.bounding_radius = 30.0f;
  mdl.skin_width = 8;
  mdl.skin_height = 4;
  mdl.flags = kMdlRocket | kMdlHoley;
  mdl.sync_type = 1;
  const auto skin = [](std::uint8_t colour) { return IndexedImage{8, 4, std::vector<std::uint8_t>(32, colour)}; };
  mdl.skins = {{{skin(1)}, {}}, {{skin(2), skin(3)}, {0.25f, 0.75f}}};
  mdl.vertex_count = 4;
  mdl.tex_coords = {{false, 0, 0}, {true, 3, 1}, {false, 2, 3}, {true, 1, 2}};
  mdl.triangles = {{true, {0, 1, 2}}, {false, {0, 3, 1}}, {true, {1, 3, 2}}, {false, {2, 3, 0}}};
  mdl.frames = {{"stand1", 0, 1, {}}, {"run1", 1, 2, {0.1f, 0.2f}}};
  mdl.pose_count = 3;
  for (std::uint32_t i = 0; i < 12; ++i) {
    mdl.vertices.push_back({static_cast<std::uint8_t>(10 * i), static_cast<std::uint8_t>(255 - i),
                            static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(150 + i)});
  }
  return mdl;
}

// --- sprites ---

inline Bytes write_spr(const Spr& spr) {
  ByteWriter w;
  w.text("IDSP", 4);
  w.u32(1);
  w.i32(static_cast<std::int32_t>(spr.orientation));
  w.f32(spr.bounding_radius);
  w.i32(spr.max_width);
  w.i32(spr.max_height);
  w.u32(static_cast<std::uint32_t>(spr.frames.size()));
  w.f32(spr.beam_length);
  w.i32(spr.sync_type);
  for (const SprFrame& frame : spr.frames) {
    w.u32(frame.end_times.empty() ? 0 : 1);
    if (!frame.end_times.empty()) w.u32(static_cast<std::uint32_t>(frame.images.size()));
    for (const float time : frame.end_times) w.f32(time);
    for (const SprImage& image : frame.images) {
      w.i32(image.origin_x);
      w.i32(image.origin_y);
      w.i32(image.image.width);
      w.i32(image.image.height);
      w.bytes(image.image.indices);
    }
  }
  return w.out;
}

// A frame and a group of two, of different sizes.
inline Spr small_sprite(SpriteOrientation orientation) {
  const auto image = [](int width, int height, std::uint8_t colour) {
    return SprImage{-width / 2,
                    height / 2,
                    {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), colour)}};
  };
  Spr spr;
  spr.orientation = orientation;
  spr.bounding_radius = 12.0f;
  spr.max_width = 6;
  spr.max_height = 5;
  spr.beam_length = 1.0f;
  spr.sync_type = 1;
  spr.frames = {{{image(6, 4, 9)}, {}}, {{image(3, 5, 255), image(2, 2, 8)}, {0.1f, 0.3f}}};
  return spr;
}

// --- archives, pictures, demos ---

inline Bytes write_lmp(const IndexedImage& image) {
  ByteWriter w;
  w.i32(image.width);
  w.i32(image.height);
  w.bytes(image.indices);
  return w.out;
}

struct NamedLump {
  std::string name;
  char type;
  Bytes bytes;
};
inline Bytes write_wad(const std::vector<NamedLump>& lumps) {
  ByteWriter w;
  w.text("WAD2", 4);
  w.u32(static_cast<std::uint32_t>(lumps.size()));
  w.u32(0);
  std::vector<std::size_t> offsets;
  for (const NamedLump& lump : lumps) {
    offsets.push_back(w.out.size());
    w.bytes(lump.bytes);
  }
  w.patch_u32(8, static_cast<std::uint32_t>(w.out.size()));
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    w.u32(static_cast<std::uint32_t>(offsets[i]));
    w.u32(static_cast<std::uint32_t>(lumps[i].bytes.size()));
    w.u32(static_cast<std::uint32_t>(lumps[i].bytes.size()));
    w.u8(static_cast<std::uint8_t>(lumps[i].type));
    w.text("", 3);
    w.text(lumps[i].name, 16);
  }
  return w.out;
}

inline IndexedImage small_picture() {
  IndexedImage image{5, 3, {}};
  for (std::uint8_t i = 0; i < 15; ++i) image.indices.push_back(i);
  return image;
}
inline Bytes small_wad() {
  return write_wad({{"DISC", 'B', write_lmp(small_picture())},
                    {"conchars", 'D', Bytes(128 * 128, 3)},
                    {"palette", '@', Bytes(768)}});
}

inline Bytes small_demo() {
  Bytes demo = {'-', '1', '\n'};
  append_dem_message(demo, vec3(0.0f), Bytes{1});
  append_dem_message(demo, vec3(10.0f, -90.0f, 0.5f), Bytes{7, 0, 0, 128, 63, 1});
  append_dem_message(demo, vec3(0.0f), Bytes{2});
  return demo;
}

}  // namespace fb::formats::testing
