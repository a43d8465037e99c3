// Fuzz target: progs.dat. Whatever the bytes, they are refused with a place and a cause, or every function runs to an
// end inside of its memory.
#include <cstddef>
#include <cstdint>

#include "base/log.h"
#include "progs/test_soundness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  set_log_level(LogLevel::kError);
  const auto program = progs::load_program({data, size}, "fuzzed");
  if (!program.ok()) {
    FB_CHECK(program.error().message.starts_with("fuzzed: offset "));
    return 0;
  }
  FB_CHECK_EQ(progs::testing::broken(*program), "");
  return 0;
}
