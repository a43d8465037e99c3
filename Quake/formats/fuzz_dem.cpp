// Fuzzes DemReader: reads to the end or to the first error, and what was read, written again, is what was there.
#include <algorithm>
#include <cmath>

#include "formats/dem.h"
#include "formats/fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::formats;
  auto demo = DemReader::open({data, size}, testing::kFuzzName);
  if (!demo.ok()) {
    testing::demand_place(demo);
    return 0;
  }
  std::size_t last = demo->offset();
  while (!demo->at_end()) {
    const auto message = demo->next();
    if (!message.ok()) {
      testing::demand_place(message);
      break;
    }
    testing::demand(message->data.size() <= kMaxDemMessage, "a message's size");
    for (int axis = 0; axis < 3; ++axis) testing::demand(std::isfinite(message->view_angles[axis]), "an angle");
    fb::Bytes again;
    append_dem_message(again, message->view_angles, message->data);
    testing::demand(again.size() == demo->offset() - last, "a message's place");
    testing::demand(std::equal(message->data.begin(), message->data.end(), data + last + 16), "a message's bytes");
    last = demo->offset();
  }
  return 0;
}
