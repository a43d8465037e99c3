// Fuzz target: calls of a status bar's builtins. Bytes are steps: which function, and which words its parameters get.
#include <cstddef>
#include <cstdint>

#include "base/bytes.h"
#include "base/log.h"
#include "csqc/test_hostile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  set_log_level(LogLevel::kError);
  csqc::HostileBar bar;
  ByteReader reader({data, size}, "fuzzed");
  while (reader.remaining() >= 3) {
    const std::uint32_t function = reader.u16();
    const unsigned words = reader.u8() % 25u;
    for (std::uint32_t i = 0; i < words && reader.remaining() >= 4; ++i) bar.set(i, reader.u32());
    (void)bar.call(function);
  }
  return 0;
}
