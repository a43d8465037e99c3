// Maps a part of an open file into memory. The only code that knows how a system maps files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/file_data.h"

namespace fb::fs {

// `size` must be above 0 and within the file. The file may be closed afterwards. Returns nothing if the system cannot
// map it; then it is read instead.
std::optional<FileData> map_part(std::intptr_t handle, std::uint64_t offset, std::size_t size);

}  // namespace fb::fs
