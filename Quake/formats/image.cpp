// Parses the palette, lump pictures, PCX and PNG; TGA is in image_tga.cpp.
#include "formats/image.h"

#include <png.h>

#include <algorithm>

#include "formats/image_detail.h"

namespace fb::formats {

Result<Palette> parse_palette(ByteView data, std::string_view name) {
  ByteReader reader(data, name);
  Palette palette;
  for (auto& colour : palette.rgb) {
    for (std::uint8_t& channel : colour) channel = reader.u8();
  }
  if (reader.failed()) return reader.error("palette ends before its 768 bytes");
  return palette;
}

Result<IndexedImage> parse_lmp(ByteView data, std::string_view name) {
  ByteReader reader(data, name);
  const std::uint32_t width = reader.u32();
  const std::uint32_t height = reader.u32();
  if (reader.failed()) return reader.error_at(0, "picture is too short for its size");
  if (auto error = detail::size_error(reader, 0, width, height)) return *error;
  const ByteView texels = reader.bytes(std::size_t{width} * height);
  if (reader.failed()) {
    return reader.error_at(
        8, "picture of " + std::to_string(width) + " by " + std::to_string(height) + " texels ends early");
  }
  return IndexedImage{static_cast<int>(width), static_cast<int>(height), {texels.begin(), texels.end()}};
}

namespace {

// PCX runs: two high bits mark a count of up to 63 for the next byte.
bool unpack_pcx(ByteReader& reader, std::vector<std::uint8_t>& out) {
  std::size_t at = 0;
  while (at < out.size()) {
    const std::uint8_t first = reader.u8();
    if (reader.failed()) return false;
    if (first < 0xc0) {
      out[at++] = first;
      continue;
    }
    const std::size_t run = std::min<std::size_t>(first & 0x3fu, out.size() - at);
    const std::uint8_t value = reader.u8();
    if (reader.failed()) return false;
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(at), run, value);
    at += run;
  }
  return true;
}

}  // namespace

Result<RgbaImage> parse_pcx(ByteView data, std::string_view name) {
  constexpr std::size_t kHeaderSize = 128, kPaletteSize = 769;
  ByteReader reader(data, name);
  const std::uint8_t magic = reader.u8();
  reader.skip(1);  // version
  const std::uint8_t encoding = reader.u8();
  const std::uint8_t bits = reader.u8();
  const int left = reader.u16(), top = reader.u16(), right = reader.u16(), bottom = reader.u16();
  reader.skip(4 + 48 + 1);  // resolution, 16 colours
  const std::uint8_t planes = reader.u8();
  const std::size_t row_bytes = reader.u16();
  reader.seek(kHeaderSize);
  if (reader.failed() || magic != 0x0a) return reader.error_at(0, "no PCX image");
  if (encoding != 1 || bits != 8 || (planes != 1 && planes != 3)) {
    return reader.error_at(2, "PCX image is neither 8-bit nor 24-bit run-length coded");
  }
  if (right < left || bottom < top) return reader.error_at(4, "PCX image has its corners the wrong way round");
  const auto width = static_cast<std::uint32_t>(right - left + 1);
  const auto height = static_cast<std::uint32_t>(bottom - top + 1);
  if (auto error = detail::size_error(reader, 4, width, height)) return *error;
  if (row_bytes < width) return reader.error_at(66, "PCX image has rows shorter than its width");

  ByteView colours;
  std::size_t coded_end = data.size();
  if (planes == 1) {
    if (data.size() < kHeaderSize + kPaletteSize || data[data.size() - kPaletteSize] != 0x0c) {
      return reader.error_at(data.size(), "PCX image has no palette at its end");
    }
    coded_end = data.size() - kPaletteSize;
    colours = data.subspan(coded_end + 1);
  }
  ByteReader coded(data.first(coded_end), name);
  coded.seek(kHeaderSize);
  const std::size_t unpacked_size = row_bytes * planes * height;
  if (unpacked_size / 63 > coded.remaining()) return reader.error_at(kHeaderSize, "PCX image ends early");
  std::vector<std::uint8_t> unpacked(unpacked_size);
  if (!unpack_pcx(coded, unpacked)) return reader.error_at(coded_end, "PCX image ends early");

  RgbaImage image{static_cast<int>(width), static_cast<int>(height), {}};
  image.rgba.resize(std::size_t{4} * width * height);
  std::size_t out = 0;
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* row = unpacked.data() + y * row_bytes * planes;
    for (std::size_t x = 0; x < width; ++x, out += 4) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        image.rgba[out + channel] =
            planes == 1 ? colours[std::size_t{3} * row[x] + channel] : row[channel * row_bytes + x];
      }
      image.rgba[out + 3] = 255;
    }
  }
  return image;
}

namespace {

struct PngHeader {
  std::uint32_t width = 0, height = 0, bits_per_pixel = 0;
  std::size_t first_data = 0;  // offset of the first IDAT chunk
};

std::uint32_t big_endian(ByteReader& reader) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8u | reader.u8();
  return value;
}

// Walks the chunks, so that a truncated file is refused with the offset, which libpng would not report.
Result<PngHeader> scan_png(ByteView data, std::string_view name) {
  constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::uint32_t kIhdr = 0x49484452u, kIdat = 0x49444154u, kIend = 0x49454e44u;
  ByteReader reader(data, name);
  const ByteView signature = reader.bytes(kSignature.size());
  if (!std::equal(signature.begin(), signature.end(), kSignature.begin(), kSignature.end())) {
    return reader.error_at(0, "no PNG image");
  }
  PngHeader header;
  while (true) {
    const std::size_t at = reader.offset();
    const std::uint32_t size = big_endian(reader);
    const std::uint32_t type = big_endian(reader);
    const std::size_t body = reader.offset();
    if (type == kIhdr && header.bits_per_pixel == 0) {
      header.width = big_endian(reader);
      header.height = big_endian(reader);
      const std::uint32_t depth = reader.u8();
      const std::uint32_t colour_type = reader.u8();
      constexpr std::array<std::uint32_t, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};
      if (depth > 16 || colour_type >= kChannels.size() || depth * kChannels[colour_type] == 0) {
        return reader.error_at(body, "PNG image has an unknown kind of pixel");
      }
      header.bits_per_pixel = depth * kChannels[colour_type];
    }
    if (reader.failed()) return reader.error_at(at, "PNG image ends before its last chunk");
    if (header.bits_per_pixel == 0) return reader.error_at(at, "PNG image does not begin with its header");
    if (type == kIdat && header.first_data == 0) header.first_data = at;
    reader.seek(body);
    reader.skip(size);
    reader.skip(4);  // checksum: libpng checks it
    if (reader.failed()) {
      return reader.error_at(at, "PNG chunk of " + std::to_string(size) + " bytes runs past the end of the file");
    }
    if (type == kIend) break;
  }
  if (header.first_data == 0) return reader.error("PNG image has no pixels");
  return header;
}

}  // namespace

Result<RgbaImage> parse_png(ByteView data, std::string_view name) {
  auto header = scan_png(data, name);
  if (!header) return header.error();
  const ByteReader reader(data, name);
  if (auto error = detail::size_error(reader, 16, header->width, header->height)) return *error;
  // Deflate cannot do better than 1032 to 1.
  const std::uint64_t row_bytes = 1 + (std::uint64_t{header->width} * header->bits_per_pixel + 7) / 8;
  if (row_bytes * header->height / 1032 > data.size()) {
    return reader.error_at(header->first_data, "PNG image is too short for its size");
  }

  png_image decoder{};
  decoder.version = PNG_IMAGE_VERSION;
  struct Free {
    png_image* decoder;
    ~Free() { png_image_free(decoder); }
  } free_at_end{&decoder};
  if (png_image_begin_read_from_memory(&decoder, data.data(), data.size()) == 0) {
    return reader.error_at(8, std::string("PNG image cannot be read: ") + decoder.message);
  }
  decoder.format = PNG_FORMAT_RGBA;
  if (decoder.width != header->width || decoder.height != header->height) {
    return reader.error_at(16, "PNG image has two sizes");
  }
  RgbaImage image{static_cast<int>(header->width), static_cast<int>(header->height), {}};
  image.rgba.resize(std::size_t{4} * header->width * header->height);
  if (png_image_finish_read(&decoder, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    return reader.error_at(header->first_data, std::string("PNG image cannot be read: ") + decoder.message);
  }
  return image;
}

Result<RgbaImage> parse_image(ByteView data, std::string_view name) {
  std::string extension(name.substr(std::min(name.rfind('.'), name.size())));
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (extension == ".png") return parse_png(data, name);
  if (extension == ".tga") return parse_tga(data, name);
  if (extension == ".pcx") return parse_pcx(data, name);
  return ByteReader(data, name).error_at(0, "no kind of image that is known by its extension (png, tga, pcx)");
}

}  // namespace fb::formats
