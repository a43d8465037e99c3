// What was found of a map's light, as bytes to be kept: finding it takes seconds, reading it none.
#pragma once

#include <cstdint>
#include <optional>

#include "base/bytes.h"
#include "scene/authored/authored_light.h"

namespace fb::scene {

// A number of all that the light of a map is found from: its geometry, its baked light, what its faces reflect and
// give, its lamps, suns and sky; and of how it is found (kAuthoredVersion).
std::uint64_t authored_key(const LitMap& map, const Lightmaps& lightmaps);

Bytes authored_bytes(const AuthoredLight& light, std::uint64_t key);
// Nothing where the bytes are of another key, cut short or otherwise not what authored_bytes() gave.
std::optional<AuthoredLight> read_authored(ByteView bytes, std::uint64_t key, const LitMap& map);

}  // namespace fb::scene
