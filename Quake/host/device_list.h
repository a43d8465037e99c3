// -listdevices: each device's name, its missing features, and which one would be chosen.
#pragma once

#include <string>

namespace fb::host {

// Prints the list. Returns the exit status: 0 if some device is usable.
int print_devices(const std::string& preferred);

}  // namespace fb::host
