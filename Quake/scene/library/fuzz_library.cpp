// Fuzzes ModelLibrary: bytes as a map with all that is made of it, or as a model; the assets must be sound.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/log.h"
#include "scene/library/library.h"
#include "scene/library/test_sound.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  set_log_level(LogLevel::kError);
  const Bytes bytes(data, data + size);
  scene::ModelLibrary library([&](std::string_view path) -> std::optional<Bytes> {
    if (path == "maps/m.bsp" || path == "model") return bytes;
    if (path.ends_with("_00_00.lmp")) return Bytes{1, 0, 0, 0, 1, 0, 0, 0, 7};  // a skin of one texel
    return std::nullopt;
  });
  if (library.load_map("maps/m.bsp").ok())
    for (std::uint32_t i = 0; i < library.map()->models.size(); ++i) (void)library.model("*" + std::to_string(i));
  else
    (void)library.model("model");
  if (const std::string fault = scene::test::broken(*library.assets()); !fault.empty()) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
  }
  return 0;
}
