// What the parts of ModelLibrary share while they fill Assets: adding things, and images from files, each read once.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_data.h"
#include "formats/image.h"
#include "scene/assets.h"
#include "scene/library/library.h"
#include "scene/library/texel_budget.h"

namespace fb::scene {

class AssetBuilder {
 public:
  static constexpr std::size_t kMostImages = 1u << 17u, kMostMaterials = 1u << 17u;

  // Reads gfx/palette.lmp; without it (one logged sentence) colours are greys. The images take `most_texel_bytes`
  // together (texel_budget.h): beyond them the largest become smaller, which is said once. Assets then have another
  // generation where that changed an image that was there before.
  explicit AssetBuilder(FileLoader loader, FileRank rank = {}, std::uint64_t most_texel_bytes = kUsualTexelBytes);

  Assets& assets() { return *assets_; }
  std::shared_ptr<const Assets> shared_assets() const { return assets_; }
  const formats::Palette& palette() const { return assets_->palette; }

  void set_most_texel_bytes(std::uint64_t most);
  // Of more than kMostImages and kMostMaterials, more than any game has, the last stands for all others.
  std::uint32_t add_image(Image image);
  std::uint32_t add_material(Material material);
  std::uint32_t add_mesh(Mesh mesh);

  std::optional<FileData> load(std::string_view path) const { return loader_ ? loader_(path) : std::nullopt; }
  // The image in `stem` + .png, .tga or .pcx, the first that is there; kNone if none is, or it is malformed (then one
  // logged sentence). `*` in the stem is `#` in file names.
  // Files that rank below `least_rank` are not there.
  std::uint32_t image_file(std::string_view stem, ImageEncoding encoding, int least_rank = kBaseGame);
  // For the model or map in the file `owner`: the first stem that has an image, with what stands beside it: _luma or
  // else _glow, _norm, _gloss. The last two also without an image, for a skin that must stay paletted since players'
  // colours change it: then `base` is kNone. Which files count: see FileRank.
  TextureSet replacement(const std::vector<std::string>& stems, std::string_view owner);
  // Likewise the picture `stem`.lmp, in the palette's colours, with _luma or else _glow.
  TextureSet picture(std::string_view stem, std::string_view owner);
  // Likewise the first stem that has a .mat text (material_text.h), with an image or without; one that is wrong is not
  // there, and said (once a material). True if `material` is refractive by it now.
  bool refract(Material& material, const std::vector<std::string>& stems, std::string_view owner);

 private:
  static constexpr int kBaseGame = -1;  // FileRank's lowest

  int least_rank(std::string_view owner) const;
  void fit_texels();
  template <typename T>
  std::uint32_t append(std::vector<T>& all, T&& one, std::size_t most, std::string_view kind);

  FileLoader loader_;
  FileRank rank_;
  std::shared_ptr<Assets> assets_;
  std::uint64_t most_texel_bytes_, texel_bytes_ = 0;
  bool said_texels_ = false, said_number_ = false;
  std::map<std::string, std::uint32_t, std::less<>> image_files_;
};

// Palette indices 224..255 glow; 255 does not where it is a hole.
bool has_fullbright(const std::vector<std::uint8_t>& indices, bool holes);
// The glowing texels in their colours, the others black: what a replaced image needs to keep the original's light.
Image luma_from_indices(const formats::Palette& palette, const std::string& name, int width, int height,
                        const std::vector<std::uint8_t>& indices, bool holes);
// Linear Rec.709 colour of an sRGB byte, and the mean over an image (opaque texels alone).
float linear_from_srgb(std::uint8_t byte);
float linear_from_srgb(float encoded);
vec3 mean_color(const formats::Palette& palette, const Image& image);
// The same of what glows by its palette index, over all texels.
vec3 mean_glow(const formats::Palette& palette, const Image& image);
inline float luminance(const vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

std::string lower_case(std::string_view text);
// "start" of "maps/start.bsp".
std::string_view stem_of(std::string_view path);

}  // namespace fb::scene
