// csqc_make_seed_corpus DIRECTORY: what fuzz_csqc starts from: every builtin of a bar, called with texts, with numbers,
// and with both in turn.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "csqc/test_hostile.h"

namespace {

void put(fb::Bytes& to, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
    return 2;
  }
  const std::filesystem::path folder = std::filesystem::path(argv[1]) / "fuzz_csqc";
  std::filesystem::create_directories(folder);
  const fb::csqc::HostileBar bar;
  constexpr std::uint32_t kWords = 24, kOne = 0x3f800000, kSixteen = 0x41800000, kCallsEach = 24;
  const std::uint32_t text = bar.text();
  const std::uint32_t kinds[][3] = {{text, text, text}, {kOne, kSixteen, kOne}, {text, kOne, kSixteen}};
  int number = 0;
  for (const auto& kind : kinds) {
    fb::Bytes input;
    for (std::uint32_t function = 1; function < bar.functions(); ++function) {
      put(input, function, 2);
      put(input, kWords, 1);
      for (std::uint32_t i = 0; i < kWords; ++i) put(input, kind[i / 3 % 3], 4);
      if (function % kCallsEach != 0 && function + 1 < bar.functions()) continue;
      std::ofstream(folder / std::to_string(number++), std::ios::binary)
          .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
      input.clear();
    }
  }
  return 0;
}
