// world_make_seed_corpus DIRECTORY: maps made in code with a few lines' choice in front, for fuzz_trace to start from.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "formats/test_bsp.h"
#include "formats/test_bytes.h"

int main(int argc, char** argv) {
  using namespace fb;
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
    return 2;
  }
  const std::filesystem::path folder = std::filesystem::path(argv[1]) / "fuzz_trace";
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const auto version : {formats::BspVersion::kBsp29, formats::BspVersion::kBsp2, formats::BspVersion::k2Psb,
                             formats::BspVersion::kQuake64}) {
    for (const float width : {0.0f, 32.0f, 64.0f}) {
      formats::testing::ByteWriter writer;
      writer.u32(static_cast<std::uint32_t>(number));
      writer.f32(200.0f);
      writer.f32(width);
      writer.bytes(formats::testing::write_bsp(formats::testing::box_room(version)));
      std::ofstream(folder / std::to_string(number++), std::ios::binary)
          .write(reinterpret_cast<const char*>(writer.out.data()), static_cast<std::streamsize>(writer.out.size()));
    }
  }
  return 0;
}
