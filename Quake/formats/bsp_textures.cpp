// Parses a map's texture lump, and the BSPX lumps that tools append. Memory stays within the file's size whatever they
// claim.
#include "formats/bsp_detail.h"
#include "formats/image.h"

namespace fb::formats::detail {
namespace {

constexpr std::size_t kTextureHeaderSize = 40;
constexpr std::uint32_t kAbsent = 0xffffffffu;

BspTexture missing_texture(std::string name) {
  BspTexture texture;
  texture.name = std::move(name);
  texture.width = texture.height = 16;
  return texture;
}

// Reads one texture whose header lies inside the lump. `budget` is the number of texels that the lump can still hold,
// so that a directory which names one texture many times cannot multiply it.
BspTexture read_texture(ByteReader reader, Lump lump, std::size_t offset, std::size_t& budget, Mendings& mendings) {
  reader.seek(lump.offset + offset);
  BspTexture texture = missing_texture(reader.fixed_string(16).substr(0, 15));
  const std::uint32_t width = reader.u32();
  const std::uint32_t height = reader.u32();
  std::size_t texels_at = reader.u32();
  if (width < 1 || height < 1 || width > kMaxImageSize || height > kMaxImageSize) {
    mendings.add(lump.offset + offset, "texture has an impossible size; taken as missing");
    return texture;
  }
  texture.width = static_cast<int>(width);
  texture.height = static_cast<int>(height);
  if (texels_at == 0) return texture;  // the texels are in an external file

  const std::size_t texel_count = std::size_t{width} * height;
  const std::size_t space = lump.size - offset;
  // Like QuakeSpasm, reads the texels from after the header whatever the offset says.
  if (texels_at < kTextureHeaderSize || !range_fits(texels_at, texel_count, space)) texels_at = kTextureHeaderSize;
  if (!range_fits(texels_at, texel_count, space)) {
    mendings.add(lump.offset + offset, "texture runs past the end of its lump; taken as missing");
    return texture;
  }
  if (texel_count > budget) {
    mendings.add(lump.offset + offset, "textures overlap beyond the size of their lump; taken as missing");
    return texture;
  }
  budget -= texel_count;
  const ByteView texels = reader.data().subspan(lump.offset + offset + texels_at, texel_count);
  texture.indices.assign(texels.begin(), texels.end());
  return texture;
}

}  // namespace

Result<std::vector<BspTexture>> read_textures(const ByteReader& file, Lump lump, Mendings& mendings) {
  std::vector<BspTexture> textures;
  if (lump.size == 0) return textures;
  ByteReader reader(file.data().first(lump.end()), file.name());
  reader.seek(lump.offset);
  const std::uint32_t count = reader.u32();
  if (reader.failed() || count > reader.remaining() / 4) {
    return file.error_at(lump.offset, "texture lump is too small for its directory of " + std::to_string(count));
  }
  textures.reserve(count);
  std::size_t budget = lump.size;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = reader.offset();
    const std::uint32_t offset = reader.u32();
    if (offset == kAbsent) {
      textures.push_back(missing_texture(""));
    } else if (!range_fits(offset, kTextureHeaderSize, lump.size)) {
      mendings.add(entry, "texture lies outside its lump; taken as missing");
      textures.push_back(missing_texture(""));
    } else {
      textures.push_back(read_texture(reader, lump, offset, budget, mendings));
    }
  }
  return textures;
}

std::vector<std::pair<std::string, Bytes>> read_bspx(const ByteReader& file, std::size_t maps_end, Mendings& mendings) {
  std::vector<std::pair<std::string, Bytes>> lumps;
  ByteReader reader = file;
  reader.seek(maps_end);
  reader.skip((4 - maps_end % 4) % 4);
  const std::size_t start = reader.offset();
  if (reader.remaining() < 8 || reader.u32() != 0x58505342u /* "BSPX" */) return lumps;
  const std::uint32_t count = reader.u32();
  if (count > reader.remaining() / 32) {
    mendings.add(start, "BSPX directory runs past the end of the file; left out");
    return lumps;
  }
  std::size_t budget = file.size();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = reader.offset();
    std::string lump_name = reader.fixed_string(24);
    const std::uint32_t offset = reader.u32();
    const std::uint32_t size = reader.u32();
    if (!range_fits(offset, size, file.size()) || size > budget) {
      mendings.add(entry, "BSPX lump lies outside the file; left out");
      continue;
    }
    budget -= size;
    const ByteView part = file.data().subspan(offset, size);
    lumps.emplace_back(std::move(lump_name), Bytes(part.begin(), part.end()));
  }
  return lumps;
}

}  // namespace fb::formats::detail
