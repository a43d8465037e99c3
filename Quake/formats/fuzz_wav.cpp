// Fuzzes parse_wav.
#include "formats/fuzz_check.h"
#include "formats/invariants.h"
#include "formats/wav.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  testing::demand_sound(parse_wav({data, size}, testing::kFuzzName),
                        [](const Wav& wav) { return testing::broken(wav); });
  return 0;
}
