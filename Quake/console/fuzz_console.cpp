// Fuzz target: scripts. Whatever the text, it ends, the console stays whole, and its configuration reads back the same.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "base/log.h"
#include "console/console.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::con;
  fb::set_log_level(fb::LogLevel::kError);
  const std::string script(reinterpret_cast<const char*>(data), size);
  const auto add_cvars = [](Console& console) {
    console.add_cvar({"x", "1", "", kCvarArchive, -4, 4});
    console.add_cvar({"n", "1", "", kCvarArchive, 0, 9, true});
    console.add_cvar("s", "", "", kCvarArchive);
  };
  Console console;
  add_cvars(console);
  console.set_file_loader([&, calls = 0](std::string_view) mutable -> std::optional<fb::Bytes> {
    if (++calls > 100) return std::nullopt;
    return fb::Bytes(data, data + size);
  });
  console.append(script);
  for (int frame = 0; frame < 4; ++frame) console.execute();
  FB_CHECK(console.cvar("x").value() >= -4.0f && console.cvar("x").value() <= 4.0f);
  FB_CHECK(console.cvar("n").integer() >= 0 && console.cvar("n").integer() <= 9);
  (void)console.complete(script);

  Console other;
  add_cvars(other);
  const std::string config = console.config_text();
  other.append(config);
  other.execute();
  FB_CHECK(other.config_text() == config);
  return 0;
}
