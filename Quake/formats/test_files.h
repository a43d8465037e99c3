// Small valid archives, pictures and demos made in code, for tests and for the fuzzers' seeds (test_bytes.h). Images of
// other formats have their own writers in test_images.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/dem.h"
#include "formats/image.h"
#include "formats/test_bytes.h"

namespace fb::formats::testing {

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
