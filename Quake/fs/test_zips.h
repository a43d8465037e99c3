// For tests and fuzzers: zip archives made in code, sound ones and others.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"

namespace fb::fs {

struct ZippedFile {
  std::string name, text;
  std::string packed = {};  // what the archive holds in place of the text; empty: the text
  std::uint16_t method = 0, flags = 0;
  std::uint32_t claimed_size = 0;  // 0: the text's
  std::uint32_t mode = 0;          // a Unix system's, type and permissions; 0: another system's
};

inline void append_u16(Bytes& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 16; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}
inline void append_long(Bytes& bytes, std::uint32_t value) {
  append_u16(bytes, value & 0xffffu);
  append_u16(bytes, value >> 16);
}

inline std::uint32_t crc32_of(std::string_view text) {
  std::uint32_t crc = ~0u;
  for (const char c : text) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1u ? 0xedb88320u : 0u);
  }
  return ~crc;
}

// A deflate stream of one block that is not compressed, for texts below 64 KiB.
inline std::string deflated(std::string_view text) {
  Bytes head = {1};
  append_u16(head, static_cast<std::uint32_t>(text.size()));
  append_u16(head, ~static_cast<std::uint32_t>(text.size()));
  return std::string(head.begin(), head.end()).append(text);
}

// What a file's local header and its row in the directory have in common.
inline void append_facts(Bytes& bytes, const ZippedFile& file) {
  const std::string& packed = file.packed.empty() ? file.text : file.packed;
  append_u16(bytes, 20);  // version
  append_u16(bytes, file.flags);
  append_u16(bytes, file.method);
  append_long(bytes, 0x21);  // the first of January 1980
  append_long(bytes, crc32_of(file.text));
  append_long(bytes, static_cast<std::uint32_t>(packed.size()));
  append_long(bytes, file.claimed_size ? file.claimed_size : static_cast<std::uint32_t>(file.text.size()));
  append_u16(bytes, static_cast<std::uint32_t>(file.name.size()));
  append_u16(bytes, 0);  // extra
}

inline Bytes make_zip(const std::vector<ZippedFile>& files) {
  Bytes zip, directory;
  for (const ZippedFile& file : files) {
    const std::string& packed = file.packed.empty() ? file.text : file.packed;
    append_long(directory, 0x02014b50u);
    append_u16(directory, file.mode ? 0x0314 : 20);  // made by
    append_facts(directory, file);
    for (int i = 0; i < 3; ++i) append_u16(directory, 0);  // comment, disk, attributes
    append_long(directory, file.mode << 16);
    append_long(directory, static_cast<std::uint32_t>(zip.size()));
    directory.insert(directory.end(), file.name.begin(), file.name.end());
    append_long(zip, 0x04034b50u);
    append_facts(zip, file);
    zip.insert(zip.end(), file.name.begin(), file.name.end());
    zip.insert(zip.end(), packed.begin(), packed.end());
  }
  const auto begin = static_cast<std::uint32_t>(zip.size());
  zip.insert(zip.end(), directory.begin(), directory.end());
  append_long(zip, 0x06054b50u);
  append_long(zip, 0);  // disks
  for (int i = 0; i < 2; ++i) append_u16(zip, static_cast<std::uint32_t>(files.size()));
  append_long(zip, static_cast<std::uint32_t>(directory.size()));
  append_long(zip, begin);
  append_u16(zip, 0);  // comment
  return zip;
}

}  // namespace fb::fs
