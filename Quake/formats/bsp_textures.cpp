// Parses a map's texture lump, Quake 64's light, and the BSPX lumps that tools append. Memory stays within a small
// multiple of the file's size whatever they claim.
#include "formats/bsp_detail.h"
#include "formats/image.h"

namespace fb::formats::detail {
namespace {

constexpr std::size_t kTextureHeaderSize = 40;  // Quake 64's has the shift, four bytes, before the offsets
constexpr std::uint32_t kAbsent = 0xffffffffu;

BspTexture missing_texture(std::string name) {
  BspTexture texture;
  texture.name = std::move(name);
  texture.width = texture.height = 16;
  return texture;
}

// Reads one texture whose header lies inside the lump. `budget` is the number of texels that the lump can still hold,
// so that a directory which names one texture many times cannot multiply it.
BspTexture read_texture(ByteReader reader, Lump lump, std::size_t offset, bool quake64, std::size_t& budget,
                        Mendings& mendings) {
  const std::size_t header_size = kTextureHeaderSize + (quake64 ? 4 : 0);
  reader.seek(lump.offset + offset);
  BspTexture texture = missing_texture(reader.fixed_string(16).substr(0, 15));
  const std::uint32_t width = reader.u32();
  const std::uint32_t height = reader.u32();
  const std::int32_t shift = quake64 ? reader.i32() : 0;
  std::size_t texels_at = reader.u32();
  if (width < 1 || height < 1 || width > kMaxImageSize || height > kMaxImageSize) {
    mendings.add(lump.offset + offset, "texture has an impossible size; taken as missing");
    return texture;
  }
  texture.width = static_cast<int>(width);
  texture.height = static_cast<int>(height);
  if (shift < 0 || shift > kMaxTextureShift)
    mendings.add(lump.offset + offset, "texture has an impossible shift; taken as 0");
  else
    texture.shift = shift;
  if (texels_at == 0 && !quake64) return texture;  // the texels are in an external file

  const std::size_t texel_count = std::size_t{width} * height;
  const std::size_t space = lump.size - offset;
  // Like QuakeSpasm, reads the texels from after the header if the offset is wrong; Quake 64's say nothing.
  if (quake64 || texels_at < header_size || !range_fits(texels_at, texel_count, space)) texels_at = header_size;
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

std::vector<BspTexture> read_textures(const ByteReader& file, Lump lump, BspVersion version, Mendings& mendings) {
  std::vector<BspTexture> textures;
  if (lump.size == 0) return textures;
  ByteReader reader(file.data().first(lump.end()), file.name());
  reader.seek(lump.offset);
  std::uint32_t count = reader.u32();
  if (reader.failed() || count > reader.remaining() / 4) {
    mendings.add(lump.offset, "texture lump is too small for its directory; what does not fit is left out");
    count = reader.failed() ? 0 : static_cast<std::uint32_t>(reader.remaining() / 4);
  }
  const bool quake64 = version == BspVersion::kQuake64;
  const std::size_t header_size = kTextureHeaderSize + (quake64 ? 4 : 0);
  textures.reserve(count);
  std::size_t budget = lump.size;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = reader.offset();
    const std::uint32_t offset = reader.u32();
    if (offset == kAbsent) {
      textures.push_back(missing_texture(""));
    } else if (!range_fits(offset, header_size, lump.size)) {
      mendings.add(entry, "texture lies outside its lump; taken as missing");
      textures.push_back(missing_texture(""));
    } else {
      textures.push_back(read_texture(reader, lump, offset, quake64, budget, mendings));
      if (textures.back().name.empty()) {
        mendings.add(lump.offset + offset, "texture has no name; it is called unnamed and its number");
        textures.back().name = "unnamed" + std::to_string(i);
      }
    }
  }
  return textures;
}

Bytes light_of_quake64(ByteView samples) {
  Bytes light;
  light.reserve(samples.size() / 2 * 3);
  for (std::size_t at = 0; at + 1 < samples.size(); at += 2) {
    const auto word = static_cast<std::uint32_t>(samples[at] << 8 | samples[at + 1]);
    light.push_back(static_cast<std::uint8_t>((word >> 11u & 31u) << 3u));
    light.push_back(static_cast<std::uint8_t>((word >> 6u & 31u) << 3u));
    light.push_back(static_cast<std::uint8_t>((word & 63u) << 2u));
  }
  return light;
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
