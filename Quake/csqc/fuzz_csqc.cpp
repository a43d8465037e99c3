// Fuzz target: calls of a status bar's builtins. Bytes are steps: which function, and which words its parameters get.
// What is behind kMostCalls of them is not played: an input of 4 KB would have a thousand, and a call may make a text
// of 64 KB. Making a bar takes longer than what most inputs do with it, so it is made anew only after kRunsOfOne.
#include <cstddef>
#include <cstdint>
#include <memory>

#include "base/bytes.h"
#include "base/log.h"
#include "csqc/test_hostile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  set_log_level(LogLevel::kError);
  constexpr int kMostCalls = 64, kRunsOfOne = 256;
  static std::unique_ptr<csqc::HostileBar> made;
  static int runs = 0;
  if (!made || ++runs % kRunsOfOne == 0)
    made = std::make_unique<csqc::HostileBar>();
  else
    made->reset();
  csqc::HostileBar& bar = *made;
  ByteReader reader({data, size}, "fuzzed");
  for (int calls = 0; calls < kMostCalls && reader.remaining() >= 3; ++calls) {
    const std::uint32_t function = reader.u16();
    const unsigned words = reader.u8() % 25u;
    for (std::uint32_t i = 0; i < words && reader.remaining() >= 4; ++i) bar.set(i, reader.u32());
    (void)bar.call(function);
  }
  return 0;
}
