#include "audio/ogg_flac.h"

#include <string_view>
#include <utility>

namespace fb::audio {
namespace {

constexpr std::size_t kPageHeader = 27, kSerialAt = 14, kSegmentsAt = 26;
constexpr std::string_view kMapping =
                               "\x7f"
                               "FLAC",
                           kNative = "fLaC";
constexpr std::size_t kMappingSize = 9;  // the mark, its version, the number of header packets

struct Page {
  std::uint32_t serial;
  ByteView payload;
  std::size_t size;  // with its header
};

std::string_view text_of(ByteView bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::optional<Page> page_at(ByteView file, std::size_t at) {
  const ByteView rest = file.subspan(at);
  if (rest.size() < kPageHeader || !text_of(rest).starts_with("OggS")) return std::nullopt;
  const std::size_t segments = rest[kSegmentsAt], header = kPageHeader + segments;
  if (rest.size() < header) return std::nullopt;
  std::size_t length = 0;
  for (std::size_t i = 0; i < segments; ++i) length += rest[kPageHeader + i];
  if (rest.size() - header < length) return std::nullopt;
  ByteReader reader(rest, {});
  reader.seek(kSerialAt);
  return Page{reader.u32(), rest.subspan(header, length), header + length};
}

bool begins_flac(ByteView payload) {
  const std::string_view text = text_of(payload);
  return text.size() >= kMappingSize + kNative.size() && text.starts_with(kMapping) &&
         text.substr(kMappingSize).starts_with(kNative);
}

}  // namespace

std::optional<Bytes> flac_of_ogg(ByteView file) {
  std::optional<std::uint32_t> serial;
  Bytes flac;
  std::size_t at = 0;
  while (const auto page = page_at(file, at)) {
    at += page->size;
    ByteView payload = page->payload;
    if (!serial && begins_flac(payload)) {
      serial = page->serial;
      payload = payload.subspan(kMappingSize);
    }
    // Packets lie behind one another, so that their pages' contents do, too.
    if (serial == page->serial) flac.insert(flac.end(), payload.begin(), payload.end());
  }
  return serial ? std::optional(std::move(flac)) : std::nullopt;
}

}  // namespace fb::audio
