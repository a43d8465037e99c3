#pragma once

#include <cstdint>

namespace fb {

// What the machine has in all, bytes; 4 GiB where the system does not say.
std::uint64_t physical_memory();

}  // namespace fb
