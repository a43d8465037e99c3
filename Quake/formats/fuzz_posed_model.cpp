// Fuzzes parse_md3 and parse_md5. A text's mesh and animation are parted by a zero.
#include <algorithm>

#include "formats/fuzz_check.h"
#include "formats/invariants.h"
#include "formats/posed_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  const auto promise = [](const PosedModel& model) { return testing::broken(model); };
  if (size > 0 && data[0] == 'I') {
    testing::demand_sound(parse_md3({data, size}, testing::kFuzzName), promise);
    return 0;
  }
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), size);
  const Md5Text mesh{text.substr(0, end), testing::kFuzzName};
  if (end == size)
    testing::demand_sound(parse_md5(mesh, std::nullopt), promise);
  else
    testing::demand_sound(parse_md5(mesh, Md5Text{text.substr(end + 1), testing::kFuzzName}), promise);
  return 0;
}
