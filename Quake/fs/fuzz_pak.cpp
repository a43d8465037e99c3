// Fuzz target: the pak's header and directory. Every entry that is accepted must lie inside the file.
#include <cstddef>
#include <cstdint>

#include "base/check.h"
#include "fs/pak.h"
#include "fs/path.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parsed = fb::fs::parse_pak({data, size}, "fuzz.pak");
  if (!parsed) {
    FB_CHECK(!parsed.error().message.empty());
    return 0;
  }
  for (const fb::fs::PakEntry& entry : parsed->entries) {
    FB_CHECK_LE(entry.offset + entry.size, size);
    FB_CHECK_LT(entry.name.size(), fb::fs::kPakNameSize + 1);
    if (const auto name = fb::fs::normalise(entry.name)) {
      FB_CHECK(fb::fs::normalise(*name) == name);
      FB_CHECK(name->front() != '/');
    }
  }
  return 0;
}
