#include "fs/pak.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/log.h"
#include "fs/path.h"

namespace fb::fs {

Result<PakHeader> parse_pak_header(ByteView bytes, std::uint64_t file_size, std::string_view name) {
  ByteReader reader(bytes, name);
  const std::string magic = reader.fixed_string(4);
  PakHeader header;
  header.directory_offset = reader.u32();
  header.directory_size = reader.u32();
  if (reader.failed()) return reader.error(fmt::format("too short for a pak's header ({} bytes)", kPakHeaderSize));
  if (magic != "PACK") return reader.error_at(0, "not a pak: it does not begin with PACK");
  if (header.directory_size % kPakEntrySize != 0)
    return reader.error_at(
        8, fmt::format("the directory's length {} is no multiple of {}", header.directory_size, kPakEntrySize));
  if (header.directory_size / kPakEntrySize > kMostPakEntries)
    return reader.error_at(8, fmt::format("a directory of {} files, of {} that a pak may have",
                                          header.directory_size / kPakEntrySize, kMostPakEntries));
  if (std::uint64_t{header.directory_offset} + header.directory_size > file_size)
    return reader.error_at(4, fmt::format("the directory ({} bytes at {}) reaches past the file's end at {}",
                                          header.directory_size, header.directory_offset, file_size));
  return header;
}

PakDirectory parse_pak_directory(ByteView directory, const PakHeader& header, std::uint64_t file_size,
                                 std::string_view name) {
  ByteReader reader(directory, name);
  PakDirectory parsed;
  parsed.entries.reserve(directory.size() / kPakEntrySize);
  std::size_t count = 0, left_out = 0;
  while (reader.remaining() >= kPakEntrySize) {
    const std::size_t at = header.directory_offset + reader.offset();
    PakEntry entry;
    entry.name = reader.fixed_string(kPakNameSize);
    std::replace(entry.name.begin(), entry.name.end(), '\\', '/');
    entry.offset = reader.u32();
    entry.size = reader.u32();
    const std::size_t number = count++;
    if (entry.offset + entry.size <= file_size) {
      parsed.entries.push_back(std::move(entry));
    } else if (left_out++ == 0) {
      parsed.warning = reader
                           .error_at(at, fmt::format("entry {} \"{}\" ({} bytes at {}) reaches past the file's end at "
                                                     "{}; it is left out",
                                                     number, entry.name, entry.size, entry.offset, file_size))
                           .message;
    }
  }
  if (left_out > 1) parsed.warning += fmt::format(" (and {} more)", left_out - 1);
  return parsed;
}

Result<PakDirectory> parse_pak(ByteView data, std::string_view name) {
  const auto header = parse_pak_header(data, data.size(), name);
  if (!header) return header.error();
  const ByteView directory = data.subspan(header->directory_offset, header->directory_size);
  return parse_pak_directory(directory, *header, data.size(), name);
}

Pak::Pak(RandomAccessFile file, std::string name, std::vector<PakEntry> entries)
    : file_(std::move(file)), name_(std::move(name)), entries_(std::move(entries)) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    by_name_.emplace(entries_[i].name, i);
    by_lower_name_.emplace(lower_case(entries_[i].name), i);
  }
}

Result<Pak> Pak::open(const std::filesystem::path& path, std::string name) {
  auto file = RandomAccessFile::open(path);
  if (!file) return file.error();
  const std::uint64_t size = file->size();

  std::array<std::uint8_t, kPakHeaderSize> header_bytes{};
  const auto header_size = static_cast<std::size_t>(std::min<std::uint64_t>(size, kPakHeaderSize));
  if (auto status = file->read_at(0, std::span(header_bytes).first(header_size)); !status) return status.error();
  const auto header = parse_pak_header(std::span(header_bytes).first(header_size), size, name);
  if (!header) return header.error();

  Bytes directory(header->directory_size);
  if (auto status = file->read_at(header->directory_offset, directory); !status) return status.error();
  PakDirectory parsed = parse_pak_directory(directory, *header, size, name);
  if (!parsed.warning.empty()) log_warning("{}", parsed.warning);
  return Pak(*std::move(file), std::move(name), std::move(parsed.entries));
}

const PakEntry* Pak::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &entries_[found->second];
}

const PakEntry* Pak::find_ignoring_case(std::string_view name) const {
  const auto found = by_lower_name_.find(lower_case(name));
  return found == by_lower_name_.end() ? nullptr : &entries_[found->second];
}

Result<FileData> Pak::read(const PakEntry& entry) const {
  auto data = file_.read(entry.offset, entry.size);
  if (!data) return Error{fmt::format("{}:{}: {}", name_, entry.name, data.error().message)};
  return data;
}

}  // namespace fb::fs
