// fs_make_seed_corpus DIRECTORY: writes the seeds of fuzz_pak, all made in code, into DIRECTORY/fuzz_pak/.
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fs/file.h"
#include "fs/test_paks.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fs_make_seed_corpus DIRECTORY\n");
    return 2;
  }
  using fb::fs::make_pak;
  const std::vector<std::pair<const char*, fb::Bytes>> seeds = {
      {"empty", make_pak({})},
      {"one", make_pak({{"a", "alpha"}})},
      {"several", make_pak({{"maps/start.bsp", "x"}, {"gfx\\palette.lmp", std::string(768, 'p')}, {"empty", ""}})},
      {"doubled", make_pak({{"a", "first"}, {"a", "second"}})},
      {"long_name", make_pak({{std::string(56, 'n'), "x"}})},
      {"outside", make_pak({{"../x", "x"}, {"/x", "x"}, {"c:x", "x"}, {"a/./b//c", "x"}})},
  };
  for (const auto& [name, pak] : seeds) {
    const auto path = std::filesystem::path(argv[1]) / "fuzz_pak" / name;
    if (const auto status = fb::fs::write_file_atomically(path, pak); !status) {
      std::fprintf(stderr, "%s\n", status.error().message.c_str());
      return 1;
    }
  }
  return 0;
}
