#include "ui/atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/check.h"
#include "base/log.h"
#include "ui/fallback_font.h"

namespace fb::ui {
namespace {

constexpr int kFontSide = 128;

std::uint64_t next_revision() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

// Characters in white and gold, until a palette says otherwise.
formats::Palette fallback_palette() {
  formats::Palette palette;
  palette.rgb[1] = {232, 228, 216};
  palette.rgb[2] = {224, 164, 72};
  return palette;
}

}  // namespace

Atlas::Atlas(FileLoader files) : files_(std::move(files)) {
  texels_.width = kWidth;
  std::optional<formats::IndexedImage> font;
  if (files_) {
    if (auto data = files_("gfx/palette.lmp")) {
      auto palette = formats::parse_palette(*data, "gfx/palette.lmp");
      if (palette)
        palette_ = *palette;
      else
        log_warning("{}", palette.error().message);
    }
    if (auto data = files_("gfx.wad")) {
      auto wad = formats::Wad::parse(*std::move(data), "gfx.wad");
      if (wad) {
        for (const std::string& warning : wad->warnings()) log_warning("{}", warning);
        wad_ = *std::move(wad);
      } else {
        log_warning("{}", wad.error().message);
      }
    }
  }
  if (wad_ && palette_) {
    auto conchars = wad_->conchars();
    if (conchars && conchars->width == kFontSide && conchars->height == kFontSide)
      font = *std::move(conchars);
    else
      log_warning("{}", conchars ? "gfx.wad: conchars is not 128x128" : conchars.error().message);
  }
  game_font_ = font.has_value();
  const std::optional<formats::Palette> game_palette = palette_;
  if (!game_font_) {
    palette_ = fallback_palette();
    font = fallback_font();
  }
  const auto place = add(colored(*font, 0));
  palette_ = game_palette;
  FB_CHECK(place.has_value());
  font_ = *place;
}

formats::RgbaImage Atlas::colored(const formats::IndexedImage& image, int transparent) const {
  formats::RgbaImage rgba;
  rgba.width = image.width;
  rgba.height = image.height;
  rgba.rgba.reserve(4 * image.indices.size());
  for (const std::uint8_t index : image.indices) {
    const auto& rgb = palette_->rgb[index];
    const bool clear = index == transparent;
    for (const std::uint8_t channel : rgb) rgba.rgba.push_back(clear ? std::uint8_t{0} : channel);
    rgba.rgba.push_back(clear ? std::uint8_t{0} : std::uint8_t{255});
  }
  return rgba;
}

Picture Atlas::glyph(unsigned char code) const {
  return {font_.x + code % 16 * kGlyphSize, font_.y + code / 16 * kGlyphSize, kGlyphSize, kGlyphSize};
}

const Picture* Atlas::picture(std::string_view name, bool required) {
  auto known = pictures_.find(name);
  if (known == pictures_.end()) {
    std::optional<Picture> place;
    std::string failure;
    if (const auto image = read_picture(std::string(name), failure)) {
      place = add(*image);
      if (!place)
        failure = fmt::format("{}: no room for {}x{} pixels in the 2D atlas", name, image->width, image->height);
    }
    if (!failure.empty() && required) log_warning("{}", failure);
    known = pictures_.emplace(std::string(name), place).first;
  }
  return known->second ? &*known->second : nullptr;
}

const Picture* Atlas::add(std::string_view name, const formats::RgbaImage& image) {
  const auto place = add(image);
  if (!place) log_warning("{}: no room for {}x{} pixels in the 2D atlas", name, image.width, image.height);
  return place ? &*pictures_.insert_or_assign(std::string(name), place).first->second : nullptr;
}

const Picture* Atlas::find(std::string_view name) const {
  const auto known = pictures_.find(name);
  return known != pictures_.end() && known->second ? &*known->second : nullptr;
}

bool Atlas::replace(std::string_view name, const formats::RgbaImage& image) {
  auto known = pictures_.find(name);
  if (known == pictures_.end()) {
    known = pictures_.emplace(std::string(name), add(image)).first;
  } else if (known->second) {
    FB_CHECK(known->second->width == image.width && known->second->height == image.height);
    write(image, *known->second);
  }
  return known->second.has_value();
}

vec4 Atlas::color(int index) const {
  index = std::clamp(index, 0, 255);
  if (!palette_) return vec4(vec3(static_cast<float>(index) / 255.0f), 1.0f);
  const auto& rgb = palette_->rgb[static_cast<std::size_t>(index)];
  return vec4(vec3(rgb[0], rgb[1], rgb[2]) / 255.0f, 1.0f);
}

std::optional<formats::RgbaImage> Atlas::read_picture(const std::string& name, std::string& failure) {
  const auto accept_indexed = [&](Result<formats::IndexedImage> image) -> std::optional<formats::RgbaImage> {
    if (image && palette_) return colored(*image, 255);
    failure = image ? fmt::format("{}: there is no palette to show it with", name) : image.error().message;
    return std::nullopt;
  };
  if (name.find('/') == name.npos) {
    if (wad_) return accept_indexed(wad_->picture(name));
    if (!std::exchange(missed_wad_, true))
      failure = fmt::format("{}: there is no gfx.wad that could hold this and the status bar's other pictures", name);
    return std::nullopt;
  }
  const auto data = files_ ? files_(name) : std::nullopt;
  if (!data) {
    failure = fmt::format("{}: there is no such picture", name);
    return std::nullopt;
  }
  if (name.ends_with(".lmp")) return accept_indexed(formats::parse_lmp(*data, name));
  auto image = formats::parse_image(*data, name);
  if (image) return *std::move(image);
  failure = image.error().message;
  return std::nullopt;
}

// Shelf packing: pictures are placed side by side until the row is full; the tallest of a row sets where the next
// begins.
std::optional<Picture> Atlas::add(const formats::RgbaImage& image) {
  if (image.width > kWidth || image.width <= 0 || image.height <= 0) return std::nullopt;
  int x = shelf_x_, y = shelf_y_, height = shelf_height_;
  if (x + image.width > kWidth) {
    x = 0;
    y += height;
    height = 0;
  }
  if (y + image.height > kMaxHeight) return std::nullopt;
  shelf_x_ = x + image.width;
  shelf_y_ = y;
  shelf_height_ = std::max(height, image.height);

  const int needed = shelf_y_ + shelf_height_;
  if (needed > texels_.height) {
    texels_.height = std::min(kMaxHeight, std::max(needed, texels_.height == 0 ? 128 : 2 * texels_.height));
    texels_.texels.resize(static_cast<std::size_t>(kWidth) * static_cast<std::size_t>(texels_.height), 0);
  }
  const Picture place{x, y, image.width, image.height};
  write(image, place);
  return place;
}

void Atlas::write(const formats::RgbaImage& image, const Picture& place) {
  const std::uint8_t* from = image.rgba.data();
  for (int row = 0; row < image.height; ++row) {
    std::uint32_t* to =
        &texels_.texels[static_cast<std::size_t>(place.y + row) * kWidth + static_cast<std::size_t>(place.x)];
    for (int column = 0; column < image.width; ++column, from += 4) {
      to[column] = static_cast<std::uint32_t>(from[0]) | static_cast<std::uint32_t>(from[1]) << 8u |
                   static_cast<std::uint32_t>(from[2]) << 16u | static_cast<std::uint32_t>(from[3]) << 24u;
    }
  }
  texels_.revision = next_revision();
  published_.reset();
}

std::shared_ptr<const scene::DrawAtlas> Atlas::image() const {
  if (!published_) published_ = std::make_shared<const scene::DrawAtlas>(texels_);
  return published_;
}

}  // namespace fb::ui
