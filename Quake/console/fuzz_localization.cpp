// Fuzz target: files of texts. Whatever the file, its texts keep their limits, and so do the messages that they make.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "console/localization.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using fb::con::Localization;
  Localization texts;
  const auto added = texts.add({data, size}, "fuzz.txt");
  if (added) FB_CHECK(*added == texts.size());
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  for (std::size_t at = 0; at < size && at < 64; ++at) {
    const std::string_view piece = all.substr(at, all.find_first_of(" =\n", at) - at);
    const std::array<std::string_view, 3> pieces = {piece, all, "$a"};
    FB_CHECK(texts.text(piece).size() <= std::max(piece.size(), Localization::kMostTextBytes));
    FB_CHECK(texts.message(pieces).size() <= Localization::kMostMessageBytes);
  }
  return 0;
}
