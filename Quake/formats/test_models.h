// Small valid alias models and sprites made in code, for tests and for the fuzzers' seeds (test_bytes.h).
#pragma once

#include <cstdint>
#include <vector>

#include "formats/mdl.h"
#include "formats/spr.h"
#include "formats/test_bytes.h"

namespace fb::formats::testing {

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

}  // namespace fb::formats::testing
