#include "scene/authored/baked_words.h"

#include <bit>

#include "scene/library/surface_names.h"
#include "shared/baked_words.h"

namespace fb::scene {
namespace {

constexpr std::size_t kMostWords = 1u << 25u;  // a damaged file's faces may share luxels without end

}  // namespace

std::vector<std::uint32_t> baked_words(const formats::Bsp& bsp, const Lightmaps& lightmaps) {
  std::vector<std::uint32_t> words(lightmaps.faces().size() * shared::kBakedFaceWords, 0u);
  for (std::size_t i = 0; i < lightmaps.faces().size(); ++i) {
    const Lightmaps::Face& face = lightmaps.faces()[i];
    const std::size_t record = i * shared::kBakedFaceWords;
    const formats::BspTexInfo& texinfo = bsp.texinfos[bsp.faces[i].texinfo];
    if (texinfo.texture < bsp.textures.size() && liquid_kind(bsp.textures[texinfo.texture].name) != LiquidKind::kNone)
      words[record + shared::kBakedKind] = shared::kBakedWhole;
    std::uint32_t styles = 0;
    std::size_t count = 0;  // up to the last style
    for (std::uint32_t k = 0; k < 4; ++k) {
      styles |= static_cast<std::uint32_t>(face.styles[k]) << (8 * k);
      if (face.styles[k] != Lightmaps::kNoStyle) count = k + 1;
    }
    const std::size_t luxels = static_cast<std::size_t>(face.width) * static_cast<std::size_t>(face.height);
    if (count == 0 || words.size() + count * luxels > kMostWords) continue;
    for (std::uint32_t a = 0; a < 2; ++a)
      for (std::uint32_t c = 0; c < 4; ++c)
        words[record + shared::kBakedAxes + 4 * a + c] =
            std::bit_cast<std::uint32_t>(face.axes[a][static_cast<int>(c)]);
    words[record + shared::kBakedSize] =
        static_cast<std::uint32_t>(face.width) | static_cast<std::uint32_t>(face.height) << 16;
    words[record + shared::kBakedFirst] = static_cast<std::uint32_t>(words.size());
    words[record + shared::kBakedStyles] = styles;
    for (std::size_t k = 0; k < count; ++k)
      for (int y = 0; y < face.height; ++y)
        for (int x = 0; x < face.width; ++x) {
          const bool there = face.styles[k] != Lightmaps::kNoStyle;
          const auto bytes = there ? lightmaps.luxel(face, k, x, y) : std::array<std::uint8_t, 3>{};
          words.push_back(static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
                          static_cast<std::uint32_t>(bytes[2]) << 16);
        }
  }
  return words;
}

}  // namespace fb::scene
