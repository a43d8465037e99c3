// Parses WAD2 archives: a directory at the end lists the lumps before it.
#include "formats/wad.h"

namespace fb::formats {
namespace {

constexpr std::uint32_t kWadMagic = 0x32444157u;  // "WAD2"
constexpr std::size_t kEntrySize = 32;
constexpr int kConcharsSize = 128;
constexpr std::size_t kMostWarnings = 8;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

}  // namespace

Result<Wad> Wad::parse(FileData data, std::string_view name) {
  Wad wad;
  ByteReader reader(data, name);
  const std::uint32_t magic = reader.u32();
  if (reader.failed() || magic != kWadMagic) return reader.error_at(0, "no archive: it does not begin with WAD2");
  const std::uint32_t count = reader.u32();
  const std::uint32_t directory = reader.u32();
  if (reader.failed()) return reader.error("file ends inside the archive's header");
  if (directory > data.size() || count > (data.size() - directory) / kEntrySize) {
    return reader.error_at(4, "directory of " + std::to_string(count) + " lumps at " + std::to_string(directory) +
                                  " runs past the end of the file");
  }
  reader.seek(directory);
  std::size_t left_out = 0;
  const auto leave_out = [&](std::size_t at, const std::string& cause) {
    if (++left_out <= kMostWarnings) wad.warnings_.push_back(reader.error_at(at, cause + "; it is left out").message);
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = reader.offset();
    WadLump lump;
    lump.offset = reader.u32();
    const std::uint32_t stored_size = reader.u32();
    lump.size = reader.u32();
    lump.type = reader.u8();
    const std::uint8_t compression = reader.u8();
    reader.skip(2);
    const std::string lump_name = lower_case(reader.fixed_string(16));
    // The field alone does not prove compression: QuakeSpasm ignores it, so it may hold any value.
    if (compression != 0 && stored_size != lump.size) {
      leave_out(at, "lump " + lump_name + " is compressed, which nothing can read");
    } else if (lump.offset > data.size() || lump.size > data.size() - lump.offset) {
      leave_out(at, "lump " + lump_name + " (" + std::to_string(lump.size) + " bytes at " +
                        std::to_string(lump.offset) + ") lies outside the file");
    } else {
      wad.lumps_.emplace(lump_name, lump);
    }
  }
  if (left_out > kMostWarnings) wad.warnings_.back() += " (and " + std::to_string(left_out - kMostWarnings) + " more)";
  wad.name_ = name;
  wad.data_ = std::move(data);
  return wad;
}

ByteView Wad::lump(std::string_view name) const {
  const auto found = lumps_.find(lower_case(name));
  if (found == lumps_.end()) return {};
  return ByteView(data_).subspan(found->second.offset, found->second.size);
}

Result<IndexedImage> Wad::picture(std::string_view name) const {
  const auto found = lumps_.find(lower_case(name));
  if (found == lumps_.end()) return Error{name_ + ": has no lump " + std::string(name)};
  const std::string where = name_ + ":" + found->first + " (at " + std::to_string(found->second.offset) + ")";
  return parse_lmp(lump(name), where);
}

Result<IndexedImage> Wad::conchars() const {
  const auto found = lumps_.find("conchars");
  if (found == lumps_.end()) return Error{name_ + ": has no lump conchars"};
  const ByteView glyphs = lump("conchars");
  constexpr std::size_t kTexels = std::size_t{kConcharsSize} * kConcharsSize;
  if (glyphs.size() < kTexels) {
    return ByteReader(data_, name_)
        .error_at(found->second.offset,
                  "lump conchars has " + std::to_string(glyphs.size()) + " bytes, too few for 128 by 128 texels");
  }
  return IndexedImage{kConcharsSize, kConcharsSize, {glyphs.begin(), glyphs.begin() + kTexels}};
}

}  // namespace fb::formats
