// Fuzzes parse_bsp.
#include "formats/bsp.h"
#include "formats/fuzz_check.h"
#include "formats/invariants.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  testing::demand_sound(parse_bsp({data, size}, testing::kFuzzName),
                        [](const Bsp& bsp) { return testing::broken(bsp); });
  return 0;
}
