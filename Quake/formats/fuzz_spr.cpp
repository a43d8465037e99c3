// Fuzzes parse_spr.
#include "formats/fuzz_check.h"
#include "formats/invariants.h"
#include "formats/spr.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  testing::demand_sound(parse_spr({data, size}, testing::kFuzzName),
                        [](const Spr& spr) { return testing::broken(spr); });
  return 0;
}
