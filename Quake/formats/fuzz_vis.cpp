// Fuzzes parse_vis against a small map.
#include "formats/bsp.h"
#include "formats/fuzz_check.h"
#include "formats/invariants.h"
#include "formats/test_bsp.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  static const Bsp map = testing::box_room(BspVersion::kBsp29);
  testing::demand_sound(parse_vis({data, size}, testing::kFuzzName, "room.bsp", map),
                        [](const std::optional<VisRecord>& record) -> std::string {
                          if (!record) return "";
                          if (record->leafs.size() != map.leafs.size()) return "number of leafs";
                          return testing::broken_leafs(record->leafs, map.mark_faces.size(), record->visibility.size());
                        });
  return 0;
}
