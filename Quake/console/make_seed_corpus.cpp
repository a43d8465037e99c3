// console_make_seed_corpus DIRECTORY: writes the seeds of fuzz_console into DIRECTORY/fuzz_console/.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "fs/file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: console_make_seed_corpus DIRECTORY\n");
    return 2;
  }
  const std::string_view seeds[] = {
      "x 3; n 2.5\ns \"a; b\" // comment\nset new 1; seta kept \"2 3\"",
      "alias a \"b; wait; a\"; alias b echo c; a; unalias b; alias",
      "toggle x; inc n 3; cycle s a b c; reset x; resetall; resetcfg",
      "exec file.cfg; stuffcmds; cmdlist; cvarlist x; apropos cv; help x; echo { ' } /* c */ d",
  };
  int number = 0;
  for (const std::string_view seed : seeds) {
    const auto path = std::filesystem::path(argv[1]) / "fuzz_console" / std::to_string(number++);
    const fb::ByteView bytes(reinterpret_cast<const std::uint8_t*>(seed.data()), seed.size());
    if (const auto status = fb::fs::write_file_atomically(path, bytes); !status) {
      std::fprintf(stderr, "%s\n", status.error().message.c_str());
      return 1;
    }
  }
  return 0;
}
