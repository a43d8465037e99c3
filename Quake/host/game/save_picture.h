// The small picture beside a saved game, NAME.png beside NAME.sav, which menus show. It is taken of the first frame
// after saving that shows the game alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "formats/image.h"
#include "fs/filesystem.h"

namespace fb::host {

// The middle of a picture in the shape of save pictures, each pixel the mean of those it covers. pixels: red lowest.
std::vector<std::uint32_t> shrink_to_save_picture(std::span<const std::uint32_t> pixels, uvec2 size);
// Whole or not at all. Fails with the file and the cause.
Status write_save_picture(const fs::FileSystem& files, const std::string& save, std::span<const std::uint32_t> pixels,
                          uvec2 size);
// Nothing where there is none, or none of that size.
std::optional<formats::RgbaImage> read_save_picture(const fs::FileSystem& files, const std::string& save);

}  // namespace fb::host
