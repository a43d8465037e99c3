#include "fs/options.h"

namespace fb::fs {

std::filesystem::path home_directory() { return {}; }
std::filesystem::path default_user_dir() { return {}; }
bool plays_beside_data() { return true; }

}  // namespace fb::fs
