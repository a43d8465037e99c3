#include "scene/library/asset_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/log.h"
#include "base/out_of_memory.h"
#include "scene/library/material_text.h"

namespace fb::scene {
namespace {

constexpr std::uint8_t kFirstFullbright = 224;  // palette indices from here on glow

formats::Palette read_palette(const FileLoader& loader) {
  constexpr std::string_view kPath = "gfx/palette.lmp";
  formats::Palette greys;
  for (std::size_t i = 0; i < 256; ++i) greys.rgb[i].fill(static_cast<std::uint8_t>(i));
  const std::optional<FileData> bytes = loader ? loader(kPath) : std::nullopt;
  if (!bytes) {
    log_warning("{}: no such file; colours are greys", kPath);
    return greys;
  }
  auto palette = formats::parse_palette(*bytes, kPath);
  if (palette) return *palette;
  log_warning("{}", palette.error().message);
  return greys;
}

}  // namespace

AssetBuilder::AssetBuilder(FileLoader loader, FileRank rank, std::uint64_t most_texel_bytes)
    : loader_(std::move(loader)),
      rank_(std::move(rank)),
      assets_(std::make_shared<Assets>()),
      most_texel_bytes_(std::max(most_texel_bytes, kLeastTexelBytes)) {
  assets_->generation = next_generation();
  assets_->palette = read_palette(loader_);
}

void AssetBuilder::set_most_texel_bytes(std::uint64_t most) {
  most_texel_bytes_ = std::max(most, kLeastTexelBytes);
  fit_texels();
}

// More than must be, so that it happens rarely: whoever draws these takes all of them anew.
void AssetBuilder::fit_texels() {
  if (texel_bytes_ <= most_texel_bytes_) return;
  const std::uint64_t wanted = texel_bytes_;
  const std::size_t halved = halve_largest(assets_->images, most_texel_bytes_ - most_texel_bytes_ / 8);
  texel_bytes_ = 0;
  for (const Image& image : assets_->images) texel_bytes_ += texel_bytes(image);
  assets_->generation = next_generation();
  if (halved > 0 && !std::exchange(said_texels_, true))
    log_warning("{} images, the largest, are shown smaller than they are: all would take {} of {}", halved,
                memory_text(wanted), memory_text(most_texel_bytes_));
}

template <typename T>
std::uint32_t AssetBuilder::append(std::vector<T>& all, T&& one, std::size_t most, std::string_view kind) {
  if (all.size() < most)
    all.push_back(std::move(one));
  else if (!std::exchange(said_number_, true))
    log_warning("there are more than {} {}: what comes now looks like the last", most, kind);
  return static_cast<std::uint32_t>(all.size() - 1);
}

std::uint32_t AssetBuilder::add_image(Image image) {
  if (assets_->images.size() < kMostImages) texel_bytes_ += texel_bytes(image);
  const std::uint32_t index = append(assets_->images, std::move(image), kMostImages, "images");
  fit_texels();
  return index;
}
std::uint32_t AssetBuilder::add_material(Material material) {
  return append(assets_->materials, std::move(material), kMostMaterials, "materials");
}
std::uint32_t AssetBuilder::add_mesh(Mesh mesh) {
  assets_->meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(assets_->meshes.size() - 1);
}

namespace {

void keep_red(std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 0; i < rgba.size() / 4; ++i) rgba[i] = rgba[4 * i];
  rgba.resize(rgba.size() / 4);
  rgba.shrink_to_fit();
}

}  // namespace

std::uint32_t AssetBuilder::image_file(std::string_view stem, ImageEncoding encoding, int least_rank) {
  std::string name(stem);
  std::ranges::replace(name, '*', '#');
  const std::string key = fmt::format("{}|{}|{}", name, static_cast<int>(encoding), least_rank);
  if (const auto known = image_files_.find(key); known != image_files_.end()) return known->second;
  std::uint32_t index = kNone;
  for (const char* extension : {".png", ".tga", ".pcx"}) {
    const std::string path = name + extension;
    const std::optional<FileData> bytes = load(path);
    if (!bytes || (rank_ && rank_(path) < least_rank)) continue;  // asked last: most files are absent
    auto image = formats::parse_image(*bytes, path);
    if (image) {
      if (encoding == ImageEncoding::kLinearGray) keep_red(image->rgba);
      index = add_image({path, encoding, image->width, image->height, std::move(image->rgba)});
    } else {
      log_warning("{}", image.error().message);
    }
    break;
  }
  image_files_.emplace(key, index);
  return index;
}

int AssetBuilder::least_rank(std::string_view owner) const { return rank_ ? std::min(rank_(owner), 0) : kBaseGame; }

bool AssetBuilder::refract(Material& material, const std::vector<std::string>& stems, std::string_view owner) {
  for (const std::string& stem : stems) {
    std::string path = stem + ".mat";
    std::ranges::replace(path, '*', '#');
    const std::optional<FileData> bytes = load(path);
    if (!bytes || (rank_ && rank_(path) < least_rank(owner))) continue;
    const auto text = parse_material_text(bytes->text(), path);
    if (!text) {
      log_warning("{}", text.error().message);
      continue;
    }
    material.flags |= kMaterialDielectric;
    material.index = text->index;
    material.absorption = text->absorption;
    material.scattering = text->scattering;
    return true;
  }
  return false;
}

TextureSet AssetBuilder::replacement(const std::vector<std::string>& stems, std::string_view owner) {
  const int least = least_rank(owner);
  TextureSet set;
  const auto read_detail = [&](const std::string& stem) {
    set.normal = image_file(stem + "_norm", ImageEncoding::kLinearRgba, least);
    set.gloss = image_file(stem + "_gloss", ImageEncoding::kLinearGray, least);
    return set.normal != kNone || set.gloss != kNone;
  };
  for (const std::string& stem : stems) {
    set.base = image_file(stem, ImageEncoding::kSrgba, least);
    if (set.base == kNone) continue;
    set.luma = image_file(stem + "_luma", ImageEncoding::kSrgba, least);
    if (set.luma == kNone) set.luma = image_file(stem + "_glow", ImageEncoding::kSrgba, least);
    read_detail(stem);
    return set;
  }
  for (const std::string& stem : stems)
    if (read_detail(stem)) break;
  return set;
}

TextureSet AssetBuilder::picture(std::string_view stem, std::string_view owner) {
  const std::string path = fmt::format("{}.lmp", stem);
  const int least = least_rank(owner);
  const std::string key = fmt::format("{}||{}", path, least);
  const auto [known, added] = image_files_.try_emplace(key, kNone);
  if (added) {
    const std::optional<FileData> bytes = load(path);
    if (bytes && !(rank_ && rank_(path) < least)) {
      auto image = formats::parse_lmp(*bytes, path);
      if (image)
        known->second =
            add_image({path, ImageEncoding::kPalette, image->width, image->height, std::move(image->indices)});
      else
        log_warning("{}", image.error().message);
    }
  }
  TextureSet set;
  set.base = known->second;
  if (set.base == kNone) return set;
  for (const char* end : {"_luma", "_glow"})
    if (set.luma == kNone) set.luma = image_file(fmt::format("{}{}", stem, end), ImageEncoding::kSrgba, least);
  return set;
}

bool has_fullbright(const std::vector<std::uint8_t>& indices, bool holes) {
  return std::ranges::any_of(indices, [&](std::uint8_t i) { return i >= kFirstFullbright && !(holes && i == 255); });
}

Image luma_from_indices(const formats::Palette& palette, const std::string& name, int width, int height,
                        const std::vector<std::uint8_t>& indices, bool holes) {
  Image image{name + "_luma", ImageEncoding::kSrgba, width, height, {}};
  image.texels.reserve(indices.size() * 4);
  for (const std::uint8_t i : indices) {
    const bool glows = i >= kFirstFullbright && !(holes && i == 255);
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.texels.push_back(glows ? palette.rgb[i][channel] : std::uint8_t{0});
    image.texels.push_back(255);
  }
  return image;
}

float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}
float linear_from_srgb(std::uint8_t byte) {
  static const auto table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
    return values;
  }();
  return table[byte];
}

vec3 mean_color(const formats::Palette& palette, const Image& image) {
  glm::dvec3 sum(0.0);
  std::size_t count = 0;
  const auto add = [&](const std::uint8_t* rgb) {
    sum += glm::dvec3(linear_from_srgb(rgb[0]), linear_from_srgb(rgb[1]), linear_from_srgb(rgb[2]));
    ++count;
  };
  if (image.encoding == ImageEncoding::kPalette) {
    for (const std::uint8_t i : image.texels) add(palette.rgb[i].data());
  } else {
    for (std::size_t i = 0; i + 3 < image.texels.size(); i += 4)
      if (image.texels[i + 3] >= 128) add(image.texels.data() + i);
  }
  return count == 0 ? vec3(0.0f) : vec3(sum / static_cast<double>(count));
}

vec3 mean_glow(const formats::Palette& palette, const Image& image) {
  if (image.encoding != ImageEncoding::kPalette || image.texels.empty()) return vec3(0.0f);
  glm::dvec3 sum(0.0);
  for (const std::uint8_t i : image.texels) {
    if (i < kFirstFullbright) continue;
    const auto& rgb = palette.rgb[i];
    sum += glm::dvec3(linear_from_srgb(rgb[0]), linear_from_srgb(rgb[1]), linear_from_srgb(rgb[2]));
  }
  return vec3(sum / static_cast<double>(image.texels.size()));
}

std::string_view stem_of(std::string_view path) {
  path = path.substr(path.find_last_of('/') + 1);
  return path.substr(0, path.find_last_of('.'));
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace fb::scene
