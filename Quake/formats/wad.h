// WAD2 archives: gfx.wad, and wads of textures.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "formats/image.h"

namespace fb::formats {

struct WadLump {
  std::uint8_t type = 0;  // '@' palette, 'B' status bar picture, 'D' mip texture, 'E' raw
  std::size_t offset = 0, size = 0;
};

// Holds its bytes. Lump names are lower case; of two with one name the first is used. Every lump lies inside the file:
// one that does not, or is compressed, is left out with a warning.
class Wad {
 public:
  static Result<Wad> parse(FileData data, std::string_view name);
  const std::map<std::string, WadLump>& lumps() const { return lumps_; }
  // One sentence for each lump that was left out, at most a few.
  const std::vector<std::string>& warnings() const { return warnings_; }
  // Returns an empty view if there is no such lump; the name's case is ignored.
  ByteView lump(std::string_view name) const;
  // A status bar picture as an image.
  Result<IndexedImage> picture(std::string_view name) const;
  // The 128x128 console characters (16x16 glyphs of 8x8); index 0 is transparent.
  Result<IndexedImage> conchars() const;

 private:
  std::string name_;
  FileData data_;
  std::map<std::string, WadLump> lumps_;
  std::vector<std::string> warnings_;
};

}  // namespace fb::formats
