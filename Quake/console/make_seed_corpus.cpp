// console_make_seed_corpus DIRECTORY: writes the seeds of fuzz_console and fuzz_localization into
// DIRECTORY/fuzz_console/ and DIRECTORY/fuzz_localization/.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fs/file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: console_make_seed_corpus DIRECTORY\n");
    return 2;
  }
  const std::vector<std::string_view> scripts = {
      "x 3; n 2.5\ns \"a; b\" // comment\nset new 1; seta kept \"2 3\"",
      "alias a \"b; wait; a\"; alias b echo c; a; unalias b; alias",
      "toggle x; inc n 3; cycle s a b c; reset x; resetall; resetcfg",
      "exec file.cfg; stuffcmds; cmdlist; cvarlist x; apropos cv; help x; echo { ' } /* c */ d",
  };
  const std::vector<std::string_view> texts = {
      "\xef\xbb\xbf// comment\r\na = \"{0} found {1}\\n\"\r\nb=no quotes \n",
      "$a $a {} {0}\na = \"{0}{0}{1}{}\"\n",
      "a = \"\xc3\xa9\xe2\x80\xa6\xf0\x9f\x98\x80\xc1\\\"\\\\\"\n\"a\" = b",
  };
  for (const auto& [folder, seeds] : {std::pair("fuzz_console", &scripts), std::pair("fuzz_localization", &texts)}) {
    int number = 0;
    for (const std::string_view seed : *seeds) {
      const auto path = std::filesystem::path(argv[1]) / folder / std::to_string(number++);
      const fb::ByteView bytes(reinterpret_cast<const std::uint8_t*>(seed.data()), seed.size());
      if (const auto status = fb::fs::write_file_atomically(path, bytes); !status) {
        std::fprintf(stderr, "%s\n", status.error().message.c_str());
        return 1;
      }
    }
  }
  return 0;
}
