// Fuzzes parse_mdl.
#include "formats/fuzz_check.h"
#include "formats/invariants.h"
#include "formats/mdl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  testing::demand_sound(parse_mdl({data, size}, testing::kFuzzName),
                        [](const Mdl& mdl) { return testing::broken(mdl); });
  return 0;
}
