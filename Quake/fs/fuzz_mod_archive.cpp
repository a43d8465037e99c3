// Fuzz target: mods' archives. What is planned has names that every system can have, each once, in one folder, and
// reads as long as it claims, or fails with a sentence.
#include <cstddef>
#include <cstdint>
#include <set>

#include "base/check.h"
#include "fs/mod_archive.h"
#include "fs/path.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto archive = fb::fs::ModArchive::open(fb::FileData(fb::Bytes(data, data + size)), "fuzz.zip");
  if (!archive) {
    FB_CHECK(archive.error().message.starts_with("fuzz.zip: "));
    return 0;
  }
  const fb::fs::ModPlan& plan = (*archive)->plan();
  FB_CHECK(fb::fs::name_fault(plan.folder).empty() && fb::fs::is_game_name(plan.folder));
  std::uint64_t left = 4u << 20u;  // bytes to unpack: each run is short
  std::set<std::string> names;
  for (const fb::fs::PlannedFile& file : plan.files) {
    FB_CHECK(fb::fs::name_fault(file.name).empty());
    FB_CHECK(fb::fs::normalise(file.name) == file.name);
    FB_CHECK(names.insert(fb::fs::lower_case(file.name)).second);
    if (file.size > left) continue;
    left -= file.size;
    std::uint64_t got = 0;
    const auto status = (*archive)->read(file, [&](fb::ByteView part) {
      got += part.size();
      FB_CHECK(got <= file.size);
      return fb::ok_status();
    });
    FB_CHECK(status ? got == file.size : !status.error().message.empty());
  }
  return 0;
}
