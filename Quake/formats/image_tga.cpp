// Parses TGA: colour-mapped, true-colour and grey images, plain or in packets of up to 128 pixels. Follows Truevision's
// specification 2.0, except that the fourth byte of a 32-bit pixel is always alpha, because tools leave the
// descriptor's field at 0.
#include <algorithm>
#include <array>

#include "formats/image_detail.h"

namespace fb::formats {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

struct TgaHeader {
  std::uint8_t id_size, map_type, type;
  std::uint32_t map_first, map_count;
  std::uint8_t map_bits;
  std::uint32_t width, height;
  std::uint8_t bits, descriptor;

  bool packed() const { return type >= 8; }
  bool mapped() const { return (type & 7u) == 1; }
  bool grey() const { return (type & 7u) == 3; }
  std::size_t pixel_size() const { return (bits + 7u) / 8u; }
};

TgaHeader read_header(ByteReader& reader) {
  TgaHeader h{};
  h.id_size = reader.u8();
  h.map_type = reader.u8();
  h.type = reader.u8();
  h.map_first = reader.u16();
  h.map_count = reader.u16();
  h.map_bits = reader.u8();
  reader.skip(4);  // position on a screen
  h.width = reader.u16();
  h.height = reader.u16();
  h.bits = reader.u8();
  h.descriptor = reader.u8();
  return h;
}

std::uint8_t widen5(std::uint32_t value) { return static_cast<std::uint8_t>(value << 3u | value >> 2u); }

bool known_colour_bits(std::uint8_t bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

// A colour of 15 to 32 bits; blue comes first. The alpha of 16 bits is used only if the descriptor claims a bit for it.
Pixel read_colour(const std::uint8_t* bytes, std::uint8_t bits, bool alpha_bit) {
  if (bits >= 24) return {bytes[2], bytes[1], bytes[0], bits == 32 ? bytes[3] : std::uint8_t{255}};
  const std::uint32_t value = bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8u;
  const bool opaque = bits == 15 || !alpha_bit || (value & 0x8000u) != 0;
  return {widen5(value >> 10u & 31u), widen5(value >> 5u & 31u), widen5(value & 31u),
          opaque ? std::uint8_t{255} : std::uint8_t{0}};
}

class TgaParser {
 public:
  TgaParser(ByteView data, std::string_view name) : reader_(data, name), header_(read_header(reader_)) {}
  Result<RgbaImage> parse();

 private:
  std::optional<Error> check_header();
  std::optional<Error> read_map();
  // Returns false if the pixel's index is not in the colour map.
  bool decode(const std::uint8_t* bytes, Pixel& pixel) const;
  std::uint8_t* place(RgbaImage& image, std::size_t index) const;

  ByteReader reader_;
  TgaHeader header_;
  std::vector<Pixel> map_;
};

std::optional<Error> TgaParser::check_header() {
  const TgaHeader& h = header_;
  if (reader_.failed()) return reader_.error_at(0, "file is too short for a TGA image");
  const int kind = h.type & 7;
  if ((h.type & ~8u) != static_cast<unsigned>(kind) || kind < 1 || kind > 3) {
    return reader_.error_at(2, "TGA image has the unknown type " + std::to_string(h.type));
  }
  const bool good_bits = h.mapped() ? (h.bits == 8 || h.bits == 16) && h.map_type == 1
                         : h.grey() ? h.bits == 8 || h.bits == 16
                                    : known_colour_bits(h.bits);
  if (!good_bits || (h.map_type == 1 && h.mapped() && !known_colour_bits(h.map_bits))) {
    return reader_.error_at(16, "TGA image of type " + std::to_string(h.type) + " has pixels of " +
                                    std::to_string(h.bits) + " bits, colours of " + std::to_string(h.map_bits));
  }
  return detail::size_error(reader_, 12, h.width, h.height);
}

std::optional<Error> TgaParser::read_map() {
  reader_.skip(header_.id_size);
  const std::size_t colour_size = (header_.map_bits + 7u) / 8u;
  const std::size_t at = reader_.offset();
  const ByteView colours = reader_.bytes(header_.map_type == 1 ? colour_size * header_.map_count : 0);
  if (reader_.failed()) return reader_.error_at(at, "TGA image ends inside its colour map");
  if (!header_.mapped()) return std::nullopt;
  for (std::size_t i = 0; i < header_.map_count; ++i) {
    map_.push_back(read_colour(colours.data() + i * colour_size, header_.map_bits, false));
  }
  return std::nullopt;
}

bool TgaParser::decode(const std::uint8_t* bytes, Pixel& pixel) const {
  if (header_.mapped()) {
    std::uint32_t index = bytes[0];
    if (header_.bits == 16) index |= static_cast<std::uint32_t>(bytes[1]) << 8u;
    if (index < header_.map_first || index - header_.map_first >= map_.size()) return false;
    pixel = map_[index - header_.map_first];
  } else if (header_.grey()) {
    pixel = {bytes[0], bytes[0], bytes[0], header_.bits == 16 ? bytes[1] : std::uint8_t{255}};
  } else {
    pixel = read_colour(bytes, header_.bits, (header_.descriptor & 15u) == 1);
  }
  return true;
}

// The position in the image of the file's pixel number `index`: bit 5 says that rows come from the top, bit 4 that they
// run from the right.
std::uint8_t* TgaParser::place(RgbaImage& image, std::size_t index) const {
  std::size_t x = index % header_.width;
  std::size_t y = index / header_.width;
  if ((header_.descriptor & 0x20u) == 0) y = header_.height - 1 - y;
  if ((header_.descriptor & 0x10u) != 0) x = header_.width - 1 - x;
  return image.rgba.data() + 4 * (y * header_.width + x);
}

Result<RgbaImage> TgaParser::parse() {
  if (auto error = check_header()) return *error;
  if (auto error = read_map()) return *error;
  const std::size_t pixels = std::size_t{header_.width} * header_.height;
  const std::size_t pixel_size = header_.pixel_size();
  const std::size_t least = header_.packed() ? (pixels + 127) / 128 * (1 + pixel_size) : pixels * pixel_size;
  if (least > reader_.remaining()) return reader_.error("TGA image ends before its last pixel");

  RgbaImage image{static_cast<int>(header_.width), static_cast<int>(header_.height), {}};
  image.rgba.resize(4 * pixels);
  std::size_t done = 0;
  while (done < pixels) {
    const std::size_t at = reader_.offset();
    std::size_t length = pixels - done;
    bool repeated = false;
    if (header_.packed()) {
      const std::uint8_t packet = reader_.u8();
      repeated = (packet & 0x80u) != 0;
      length = std::min<std::size_t>(length, (packet & 0x7fu) + 1u);
    }
    const ByteView coded = reader_.bytes((repeated ? 1 : length) * pixel_size);
    if (reader_.failed()) return reader_.error_at(at, "TGA image ends before its last pixel");
    Pixel pixel{};
    for (std::size_t i = 0; i < length; ++i) {
      if ((i == 0 || !repeated) && !decode(coded.data() + i * pixel_size, pixel)) {
        return reader_.error_at(
            at, "TGA image has a pixel that its colour map of " + std::to_string(map_.size()) + " does not hold");
      }
      std::copy(pixel.begin(), pixel.end(), place(image, done + i));
    }
    done += length;
  }
  return image;
}

}  // namespace

Result<RgbaImage> parse_tga(ByteView data, std::string_view name) { return TgaParser(data, name).parse(); }

}  // namespace fb::formats
