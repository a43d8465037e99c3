// formats_make_seed_corpus DIRECTORY: writes the seeds of this module's fuzz targets, all made in code, into
// DIRECTORY/<target>/.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>
#include <system_error>

#include "formats/test_bsp.h"
#include "formats/test_files.h"
#include "formats/test_images.h"
#include "formats/test_models.h"
#include "formats/test_posed_models.h"
#include "formats/test_waves.h"

namespace fb::formats::testing {
namespace {

struct Seed {
  std::string target, name;
  Bytes bytes;
};

void add_map_seeds(std::vector<Seed>& seeds) {
  const char* names[] = {"bsp29", "bsp2", "2psb", "quake64"};
  for (const BspVersion version : {BspVersion::kBsp29, BspVersion::kBsp2, BspVersion::k2Psb, BspVersion::kQuake64}) {
    const std::string name = names[static_cast<int>(version)];
    Bsp room = box_room(version);
    seeds.push_back({"fuzz_bsp", name + "_room", write_bsp(room)});
    seeds.push_back({"fuzz_bsp", name + "_deep", write_bsp(deep_room(version, 40))});
    room.lighting.resize(16);
    room.bspx = {{"RGBLIGHTING", Bytes(48, 9)}, {"LMSHIFT", Bytes(6, 4)}};
    seeds.push_back({"fuzz_bsp", name + "_bspx", write_bsp(room)});
    room.visibility.clear();
    room.lighting.clear();
    room.bspx.clear();
    room.textures.clear();
    seeds.push_back({"fuzz_bsp", name + "_bare", write_bsp(room)});
  }
  const Bsp room = box_room(BspVersion::kBsp29);
  Bsp other = room;
  other.leafs.resize(1);
  seeds.push_back({"fuzz_vis", "one", write_vis({{"room.bsp", room}})});
  seeds.push_back({"fuzz_vis", "second", write_vis({{"other.bsp", other}, {"room.bsp", room}})});
}

void add_model_seeds(std::vector<Seed>& seeds) {
  Mdl mdl = tetrahedron();
  seeds.push_back({"fuzz_mdl", "groups", write_mdl(mdl)});
  ByteWriter more{write_mdl(mdl)};
  more.patch_u32(68, 3);  // frames than there are
  seeds.push_back({"fuzz_mdl", "cut", more.out});
  mdl.skins.resize(1);
  mdl.frames.resize(1);
  seeds.push_back({"fuzz_mdl", "single", write_mdl(mdl)});
  for (int i = 0; i < 5; ++i) {
    Spr spr = small_sprite(static_cast<SpriteOrientation>(i));
    if (i == 1) spr.frames[0].images[0].image = {0, 1, {}};
    if (i > 2) spr.frames.resize(1);
    seeds.push_back({"fuzz_spr", "orientation" + std::to_string(i), write_spr(spr)});
  }
}

void add_posed_seeds(std::vector<Seed>& seeds) {
  const auto bytes = [](const std::string& text) { return Bytes(text.begin(), text.end()); };
  seeds.push_back({"fuzz_posed_model", "md3", small_md3({"body", "head"})});
  seeds.push_back({"fuzz_posed_model", "mesh", bytes(small_md5mesh())});
  seeds.push_back({"fuzz_posed_model", "pair", bytes(small_md5mesh() + '\0' + small_md5anim())});
}

void add_picture_seeds(std::vector<Seed>& seeds) {
  seeds.push_back({"fuzz_wad", "pictures",
                   write_wad({{"disc", 'B', write_lmp(small_picture())}, {"num_0", 'B', write_lmp(small_picture())}})});
  seeds.push_back({"fuzz_wad", "conchars", small_wad()});
  ByteWriter outside{small_wad()};
  outside.patch_u32(outside.out.size() - 3 * 32, 0x7fffffffu);
  seeds.push_back({"fuzz_wad", "outside", outside.out});
  seeds.push_back({"fuzz_image", "picture.lmp", write_lmp(small_picture())});
  seeds.push_back({"fuzz_image", "paletted.pcx", write_pcx(small_picture(), Palette{})});
  seeds.push_back({"fuzz_image", "coloured.pcx", write_pcx(small_image(false))});
  for (const bool alpha : {false, true}) {
    seeds.push_back({"fuzz_image", alpha ? "rgba.png" : "rgb.png", write_png(small_image(alpha), alpha)});
  }
  for (const std::uint32_t type : {1u, 2u, 3u, 9u, 10u, 11u}) {
    for (const std::uint32_t bits : {8u, 16u, 24u, 32u}) {
      if (((type & 3u) == 2) == (bits == 8) || ((type & 3u) != 2 && bits > 16)) continue;
      seeds.push_back({"fuzz_image", "type" + std::to_string(type) + "_" + std::to_string(bits) + ".tga",
                       write_tga(small_image(true), {type, bits, bits == 16, bits == 24, bits == 32 ? "id" : ""})});
    }
  }
}

void add_demo_seeds(std::vector<Seed>& seeds) {
  seeds.push_back({"fuzz_dem", "three", small_demo()});
  Bytes one = {'1', '1', '\r', '\n'};
  append_dem_message(one, vec3(1.0f, 2.0f, 3.0f), Bytes(40, 1));
  seeds.push_back({"fuzz_dem", "one", one});
}

void add_sound_seeds(std::vector<Seed>& seeds) {
  seeds.push_back({"fuzz_wav", "plain", write_wav({})});
  seeds.push_back(
      {"fuzz_wav", "loop", write_wav({.channels = 2, .bits = 8, .cue = 1, .marked = 2, .odd_chunk = true})});
}

bool write_seeds(const std::filesystem::path& root) {
  std::vector<Seed> seeds;
  add_map_seeds(seeds);
  add_model_seeds(seeds);
  add_posed_seeds(seeds);
  add_picture_seeds(seeds);
  add_demo_seeds(seeds);
  add_sound_seeds(seeds);
  for (const Seed& seed : seeds) {
    std::error_code ignored;  // a directory that cannot be made shows when the file cannot be
    std::filesystem::create_directories(root / seed.target, ignored);
    std::ofstream file(root / seed.target / seed.name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.bytes.data()), static_cast<std::streamsize>(seed.bytes.size()));
    file.close();
    if (!file) {
      std::fprintf(stderr, "cannot write %s\n", (root / seed.target / seed.name).c_str());
      return false;
    }
  }
  std::printf("%zu seeds in %s\n", seeds.size(), root.c_str());
  return true;
}

}  // namespace
}  // namespace fb::formats::testing

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: formats_make_seed_corpus DIRECTORY\n");
    return 2;
  }
  return fb::formats::testing::write_seeds(argv[1]) ? 0 : 1;
}
