// Fuzzes all image parsers with the same bytes: PCX and PNG tell themselves apart by their first bytes, TGA and lump
// pictures take anything that fits.
#include "formats/fuzz_check.h"
#include "formats/image.h"
#include "formats/invariants.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  const fb::ByteView bytes(data, size);
  const auto promise = [](const auto& image) { return testing::broken_image(image); };
  testing::demand_sound(parse_lmp(bytes, testing::kFuzzName), promise);
  testing::demand_sound(parse_pcx(bytes, testing::kFuzzName), promise);
  testing::demand_sound(parse_tga(bytes, testing::kFuzzName), promise);
  testing::demand_sound(parse_png(bytes, testing::kFuzzName), promise);
  testing::demand_sound(parse_palette(bytes, testing::kFuzzName), [](const Palette&) { return std::string(); });
  return 0;
}
