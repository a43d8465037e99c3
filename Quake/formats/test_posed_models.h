// Small valid MD5 and MD3 models made in code, for tests and for the fuzzers' seeds.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/posed_model.h"
#include "formats/test_bytes.h"

namespace fb::formats::testing {

// A tetrahedron on two joints, one 10 units above the other: its three lower corners hang on the lower one, its tip on
// both by halves.
inline std::string small_md5mesh(const std::string& shader = "progs/thing") {
  std::string text = "MD5Version 10\ncommandline \"\"\n\nnumJoints 2\nnumMeshes 1\n\njoints {\n";
  text += "\t\"origin\"\t-1 ( 0 0 0 ) ( 0 0 0 )\t\t// \n\t\"tip\"\t0 ( 0 0 10 ) ( 0 0 0 )\t\t// origin\n}\n\n";
  text += fmt::format("mesh {{\n\t// meshes: thing\n\tshader \"{}\"\n\n\tnumverts 4\n", shader);
  for (int v = 0; v < 3; ++v) text += fmt::format("\tvert {} ( {} 0.25 ) {} 1\n", v, 0.5 * v, v);
  text += "\tvert 3 ( 0.5 1 ) 3 2\n\n\tnumtris 4\n";
  text += "\ttri 0 0 1 2\n\ttri 1 0 3 1\n\ttri 2 1 3 2\n\ttri 3 2 3 0\n\n\tnumweights 5\n";
  text += "\tweight 0 0 1 ( 8 0 0 )\n\tweight 1 0 1 ( -4 7 0 )\n\tweight 2 0 1 ( -4 -7 0 )\n";
  text += "\tweight 3 0 0.5 ( 0 0 20 )\n\tweight 4 1 0.5 ( 0 0 10 )\n}\n";
  return text;
}

// Frame 0 is as it was bound, 1 has turned the upper joint by a quarter about x, 2 has moved the lower one by (1, 2,
// 3). `swapped`: joints by their names in the other order, which is none that a child may have before its parent; so
// both are roots then.
inline std::string small_md5anim(bool swapped = false) {
  std::string text = "MD5Version 10\ncommandline \"\"\n\nnumFrames 3\nnumJoints 2\nframeRate 10\n";
  text += "numAnimatedComponents 4\n\nhierarchy {\n";
  if (swapped)
    text += "\t\"tip\"\t-1 8 0\n\t\"origin\"\t-1 7 1\n}\n\n";
  else
    text += "\t\"origin\"\t-1 7 1\n\t\"tip\"\t0 8 0\n}\n\n";
  text += "bounds {\n";
  for (int f = 0; f < 3; ++f) text += "\t( -8 -8 0 ) ( 8 8 20 )\n";
  text += "}\n\nbaseframe {\n";
  text += swapped ? "\t( 0 0 10 ) ( 0 0 0 )\n\t( 0 0 0 ) ( 0 0 0 )\n}\n"
                  : "\t( 0 0 0 ) ( 0 0 0 )\n\t( 0 0 10 ) ( 0 0 0 )\n}\n";
  text += "frame 0 {\n\t0 0 0 0\n}\nframe 1 {\n\t0.7071067811865476 0 0 0\n}\nframe 2 {\n\t0 1 2 3\n}\n";
  return text;
}

// Of as many surfaces as there are names, tetrahedra beside each other, in frames of which the second is 2 units
// higher.
inline Bytes small_md3(const std::vector<std::string>& surfaces = {"body"}, std::uint32_t frames = 2) {
  ByteWriter w;
  w.text("IDP3", 4);
  w.u32(15);
  w.text("thing", 64);
  w.u32(0);
  w.u32(frames);
  w.u32(0);
  w.u32(static_cast<std::uint32_t>(surfaces.size()));
  w.u32(0);
  constexpr std::uint32_t kHeader = 108, kFrame = 56, kSurface = 108;
  const std::uint32_t surfaces_at = kHeader + kFrame * frames;
  w.u32(kHeader);
  w.u32(surfaces_at);
  w.u32(surfaces_at);
  const std::uint32_t size = kSurface + 4 * 12 + 68 + 4 * 8 + 4 * 8 * frames;
  w.u32(surfaces_at + size * static_cast<std::uint32_t>(surfaces.size()));
  for (std::uint32_t f = 0; f < frames; ++f) {
    for (int i = 0; i < 10; ++i) w.f32(0.0f);
    w.text(fmt::format("frame{}", f), 16);
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    w.text("IDP3", 4);
    w.text(surfaces[s], 64);
    w.u32(0);
    w.u32(frames);
    w.u32(1);
    w.u32(4);
    w.u32(4);
    w.u32(kSurface);
    w.u32(kSurface + 48);
    w.u32(kSurface + 48 + 68);
    w.u32(kSurface + 48 + 68 + 32);
    w.u32(size);
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 3u, 1u, 1u, 3u, 2u, 2u, 3u, 0u}) w.u32(i);
    w.text("progs/" + surfaces[s] + ".tga", 64);
    w.u32(0);
    for (int v = 0; v < 4; ++v) {
      w.f32(0.25f * static_cast<float>(v));
      w.f32(0.5f);
    }
    const int at[4][3] = {{8, 0, 0}, {-4, 7, 0}, {-4, -7, 0}, {0, 0, 20}};
    for (std::uint32_t f = 0; f < frames; ++f) {
      for (const auto& p : at) {
        for (const int c : {p[0] + 30 * static_cast<int>(s), p[1], p[2] + 2 * static_cast<int>(f)}) {
          const auto word = static_cast<std::uint16_t>(c * 64);
          w.u8(static_cast<std::uint8_t>(word & 0xffu));
          w.u8(static_cast<std::uint8_t>(word >> 8u));
        }
        w.u8(0);
        w.u8(0);
      }
    }
  }
  return w.out;
}

}  // namespace fb::formats::testing
