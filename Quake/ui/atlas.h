// One image with everything that 2D drawing shows: the console's characters, and the game's pictures as they are
// requested. Without game data it holds only the fallback font, so that messages can always be shown.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/file_data.h"
#include "base/maths.h"
#include "formats/image.h"
#include "formats/wad.h"
#include "scene/draw_list.h"

namespace fb::ui {

// A rectangle of the atlas, in texels.
struct Picture {
  int x = 0, y = 0, width = 0, height = 0;
};

class Atlas {
 public:
  static constexpr int kWidth = 1024;
  static constexpr int kMaxHeight = 4096;
  static constexpr int kGlyphSize = 8;

  // Reads gfx.wad and gfx/palette.lmp; missing or malformed files are reported once, and fallbacks are used. `files` is
  // kept for picture(); none: the fallback font and no pictures.
  explicit Atlas(FileLoader files = nullptr);

  // The rectangle of a character's 8x8 glyph; codes are Quake's: 128 and more are gold.
  Picture glyph(unsigned char code) const;
  // A picture by name: "gfx/conback.lmp" is a file (lmp, png, tga, pcx), "ibar" a lump of gfx.wad. Palette index 255 is
  // transparent. nullptr if there is none, after one message in the log (one for all lumps where there is no gfx.wad;
  // none where there need not be one).
  const Picture* picture(std::string_view name, bool required = true);
  // A picture of the program's own, under a name that no file has; nullptr if there is no room.
  const Picture* add(std::string_view name, const formats::RgbaImage& image);
  // One that is in it already; nullptr: not.
  const Picture* find(std::string_view name) const;
  // Puts an image in the place of the former one of this name, which must have had its size. False if there is no room.
  bool replace(std::string_view name, const formats::RgbaImage& image);
  bool has_game_font() const { return game_font_; }
  // The palette's colour at this index (0 to 255), opaque; a grey without game data.
  vec4 color(int index) const;

  // The current image, kept until something is added. Revisions of different atlases differ, too.
  std::shared_ptr<const scene::DrawAtlas> image() const;

 private:
  // An empty `failure` is one that has been told.
  std::optional<formats::RgbaImage> read_picture(const std::string& name, std::string& failure);
  // nullopt if the atlas is full.
  std::optional<Picture> add(const formats::RgbaImage& image);
  void write(const formats::RgbaImage& image, const Picture& place);
  formats::RgbaImage colored(const formats::IndexedImage& image, int transparent) const;

  FileLoader files_;
  std::optional<formats::Wad> wad_;
  std::optional<formats::Palette> palette_;
  bool game_font_ = false, missed_wad_ = false;
  std::map<std::string, std::optional<Picture>, std::less<>> pictures_;

  Picture font_;
  scene::DrawAtlas texels_;
  int shelf_x_ = 0, shelf_y_ = 0, shelf_height_ = 0;
  mutable std::shared_ptr<const scene::DrawAtlas> published_;
};

}  // namespace fb::ui
