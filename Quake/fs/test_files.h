// For the tests of this module: what they write and read as text.
#pragma once

#include <string>

#include "base/bytes.h"
#include "base/test_directory.h"
#include "fs/test_paks.h"

namespace fb::fs {

inline std::string as_text(ByteView data) { return std::string(data.begin(), data.end()); }

}  // namespace fb::fs
