// Fuzzes parse_entity_lump and the helpers that read its values.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "world/entity_lump.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb::world;
  const auto lump = parse_entity_lump({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!lump.ok()) {
    if (!lump.error().message.starts_with("fuzz: entities: offset ")) std::abort();
    return 0;
  }
  for (const Entity& entity : *lump)
    for (const auto& [key, value] : entity.values) {
      (void)entity.integer(key, 0);
      if (!std::isfinite(entity.number(key, 0.0f))) std::abort();
      const auto color = entity.color(key);
      if (color && (color->x < 0.0f || color->x > 1.0f || color->y > 1.0f || color->z > 1.0f)) std::abort();
    }
  return 0;
}
