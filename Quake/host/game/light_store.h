// What was found of maps' authored light, kept in the player's folder: `light/KEY.fblight`, the latest kMostKeptLight
// bytes of them.
#pragma once

#include <cstdint>

#include "fs/filesystem.h"
#include "scene/authored/authored_map.h"

namespace fb::host {

constexpr std::uint64_t kMostKeptLight = 128u << 20u;

// The file system must outlive it. Where nothing can be written, or a file is damaged, light is found anew.
scene::AuthoredStore light_store(fs::FileSystem& files);

}  // namespace fb::host
