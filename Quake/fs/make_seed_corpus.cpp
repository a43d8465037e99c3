// fs_make_seed_corpus DIRECTORY: writes the seeds of fuzz_pak, fuzz_zip and fuzz_mod_archive, all made in code, each
// into the folder of its name.
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fs/file.h"
#include "fs/test_paks.h"
#include "fs/test_zips.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fs_make_seed_corpus DIRECTORY\n");
    return 2;
  }
  using fb::fs::deflated;
  using fb::fs::make_pak;
  using fb::fs::make_zip;
  using Seeds = std::vector<std::pair<const char*, fb::Bytes>>;
  fb::Bytes beyond = make_pak({{"a", "alpha"}, {"b", "beta"}});
  beyond[beyond.size() - 1] = 0x7f;
  const Seeds paks = {
      {"beyond", beyond},
      {"empty", make_pak({})},
      {"one", make_pak({{"a", "alpha"}})},
      {"several", make_pak({{"maps/start.bsp", "x"}, {"gfx\\palette.lmp", std::string(768, 'p')}, {"empty", ""}})},
      {"doubled", make_pak({{"a", "first"}, {"a", "second"}})},
      {"long_name", make_pak({{std::string(56, 'n'), "x"}})},
      {"outside", make_pak({{"../x", "x"}, {"/x", "x"}, {"c:x", "x"}, {"a/./b//c", "x"}})},
  };
  const Seeds zips = {
      {"empty", make_zip({})},
      {"stored", make_zip({{"a", "alpha"}, {"maps/", ""}, {"maps/start.bsp", std::string(300, 'm')}})},
      {"deflated", make_zip({{"a", "alpha", deflated("alpha"), 8}, {"b", "beta", deflated("beta"), 8}})},
      {"doubled", make_zip({{"a", "first"}, {"a", "second"}})},
      {"outside", make_zip({{"../x", "x"}, {"/x", "x"}, {"c:x", "x"}, {"a/./b//c", "x"}})},
      {"lying", make_zip({{"longer", "abcd", deflated("abc"), 8}, {"huge", "x", deflated("x"), 8, 0, 0xfffffff0u}})},
      {"strange", make_zip({{"bzip", "x", "x", 12}, {"secret", "x", "x", 0, 1}})},
  };
  const Seeds mods = {
      {"top", make_zip({{"progs.dat", "code"}, {"maps/", ""}, {"maps/start.bsp", "map"}})},
      {"folder", make_zip({{"readme.txt", "read"}, {"Ad/PAK0.PAK", "pak"}, {"Ad/Maps/a.bsp", "map"}})},
      {"deep", make_zip({{"ad-1.8/ad/pak0.pak", "pak", deflated("pak"), 8}, {"ad-1.8/ad/.x", "x"}})},
      {"case", make_zip({{"progs.dat", "code"}, {"a/b", "x"}, {"A/c", "x"}})},
      {"link", make_zip({{"progs.dat", "code", {}, 0, 0, 0, 0120777}})},
  };
  for (const auto& [folder, seeds] :
       {std::pair("fuzz_pak", &paks), std::pair("fuzz_zip", &zips), std::pair("fuzz_mod_archive", &mods)}) {
    for (const auto& [name, bytes] : *seeds) {
      const auto path = std::filesystem::path(argv[1]) / folder / name;
      if (const auto status = fb::fs::write_file_atomically(path, bytes); !status) {
        std::fprintf(stderr, "%s\n", status.error().message.c_str());
        return 1;
      }
    }
  }
  return 0;
}
