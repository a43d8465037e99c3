// Fuzzes Wad::parse, and the pictures in what it takes.
#include "formats/fuzz_check.h"
#include "formats/invariants.h"
#include "formats/wad.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  const auto wad = Wad::parse(fb::Bytes(data, data + size), testing::kFuzzName);
  testing::demand_sound(wad, [](const Wad& parsed) -> std::string {
    // Lumps may overlap, so that a thousand of them name a thousand times the file: a few will do.
    int left = 64;
    for (const auto& [name, lump] : parsed.lumps()) {
      if (parsed.lump(name).size() != lump.size) return "a lump's size";
      const auto picture = parsed.picture(name);
      if (picture.ok()) {
        if (auto fault = testing::broken_image(*picture); !fault.empty()) return fault;
      }
      if (--left == 0) break;
    }
    if (const auto conchars = parsed.conchars(); conchars.ok()) return testing::broken_image(*conchars);
    return "";
  });
  return 0;
}
