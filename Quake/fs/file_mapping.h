// A part of an open file, mapped into memory: the only place that knows how a system maps files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/file_data.h"

namespace fb::fs {

// `size` is above 0, and the file has these bytes. The file may be closed afterwards. Nothing where the system cannot:
// then it is read.
std::optional<FileData> map_part(std::intptr_t handle, std::uint64_t offset, std::size_t size);

}  // namespace fb::fs
