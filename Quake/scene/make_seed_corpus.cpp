// scene_make_seed_corpus DIRECTORY: writes seeds for fuzz_library, and for fuzz_entity_lump of world/, into
// DIRECTORY/<target>/.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "formats/test_bsp.h"
#include "formats/test_models.h"
#include "scene/library/test_maps.h"

namespace {

void write_seed(const std::filesystem::path& directory, const std::string& target, const std::string& name,
                const fb::Bytes& bytes) {
  std::filesystem::create_directories(directory / target);
  std::ofstream out(directory / target / name, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

constexpr std::string_view kEntities =
    "{\"classname\" \"worldspawn\" \"_sunlight\" \"200\" \"_sun_mangle\" \"30 -60 0\" \"_sunlight2\" \"50\"\n"
    "\"wateralpha\" \".5\"} // lamps\n{classname light _color \"255 200 .5\" wait 2 delay 5 style 3 mangle \"0 -90 "
    "0\"}\n"
    "{classname light _surface +0lamp light 100}{classname light _sun 1 target t}{targetname t origin \"1 -2e3 +4\"}";

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: scene_make_seed_corpus DIRECTORY\n", stderr);
    return 1;
  }
  using namespace fb;
  namespace files = formats::testing;
  const std::filesystem::path directory = argv[1];
  scene::test::MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(scene::test::texture("+0lamp", 230)));
  map.add_square(0, 0, 32, 64, map.add_texture(scene::test::texture("*water", 12)));
  map.add_square(16, 0, 32, 64, 1, false);
  map.add_square(64, 0, 32, 64, map.add_texture(scene::test::texture("sky1", 12, 32, 16)));
  map.bsp.entities = kEntities;
  write_seed(directory, "fuzz_library", "map", files::write_bsp(map.bsp));
  write_seed(directory, "fuzz_library", "room", files::write_bsp(files::box_room(formats::BspVersion::kBsp2)));
  map.bsp.version = formats::BspVersion::kQuake64;
  map.bsp.textures[1].shift = 1;
  map.add_square(64, 64, 32, 64, map.add_texture(scene::test::texture("sky64", 12, 32, 64)));
  map.add_square(0, 64, 0, 64, map.add_texture(scene::test::texture("+2lamp", 230)));
  write_seed(directory, "fuzz_library", "quake64", files::write_bsp(map.bsp));
  write_seed(directory, "fuzz_library", "alias", files::write_mdl(files::tetrahedron()));
  write_seed(directory, "fuzz_library", "sprite",
             files::write_spr(files::small_sprite(formats::SpriteOrientation::kParallel)));
  write_seed(directory, "fuzz_entity_lump", "lamps", Bytes(kEntities.begin(), kEntities.end()));
  return 0;
}
