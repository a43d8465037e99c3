// Fuzz target: zip archives. What is listed has a name that a game may have, and reads as long as it claims, or fails
// with a sentence.
#include <cstddef>
#include <cstdint>

#include "base/check.h"
#include "fs/path.h"
#include "fs/zip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto zip = fb::fs::Zip::open(fb::FileData(fb::Bytes(data, data + size)), "fuzz.pk3");
  if (!zip) {
    FB_CHECK(!zip.error().message.empty());
    return 0;
  }
  std::uint64_t left = 4u << 20u;  // bytes to unpack: each run is short
  for (const fb::fs::PakEntry& entry : (*zip)->entries()) {
    FB_CHECK(fb::fs::normalise(entry.name) == entry.name);
    FB_CHECK((*zip)->find(entry.name) == &entry);
    if (entry.size > left) continue;
    left -= entry.size;
    const auto whole = (*zip)->read(entry);
    if (whole)
      FB_CHECK_EQ(whole->size(), entry.size);
    else
      FB_CHECK(!whole.error().message.empty());
  }
  return 0;
}
