#include "fs/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <ostream>
#include <system_error>
#include <utility>

#include "fs/links.h"
#include "fs/raw_file.h"
#include "fs/temporary_file.h"

namespace fb::fs {
namespace {

ByteView bytes_of_text(std::string_view text) {
  return ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

Result<RandomAccessFile> RandomAccessFile::open(const std::filesystem::path& path) {
  RandomAccessFile file;
  file.name_ = path.generic_string();
  const OpenedFile opened = open_to_read(path);
  file.handle_ = opened.handle;
  file.size_ = opened.size;
  if (opened.handle == kNoHandle) return Error{fmt::format("{}: cannot be opened: {}", file.name_, last_failure())};
  if (!opened.regular) return Error{fmt::format("{}: not a regular file", file.name_)};
  return file;
}

RandomAccessFile::RandomAccessFile(RandomAccessFile&& other) noexcept
    : name_(std::move(other.name_)),
      handle_(std::exchange(other.handle_, kNoHandle)),
      size_(std::exchange(other.size_, 0)) {}

RandomAccessFile& RandomAccessFile::operator=(RandomAccessFile&& other) noexcept {
  if (this != &other) {
    close();
    name_ = std::move(other.name_);
    handle_ = std::exchange(other.handle_, kNoHandle);
    size_ = std::exchange(other.size_, 0);
  }
  return *this;
}

RandomAccessFile::~RandomAccessFile() { close(); }

void RandomAccessFile::close() {
  if (handle_ != kNoHandle) close_handle(std::exchange(handle_, kNoHandle));
}

Status RandomAccessFile::read_at(std::uint64_t offset, std::span<std::uint8_t> into) const {
  while (!into.empty()) {
    const auto got = read_some(handle_, offset, into);
    if (!got) return Error{fmt::format("{}: offset {}: cannot be read: {}", name_, offset, last_failure())};
    if (*got == 0) return ends_short(offset, into.size());
    offset += *got;
    into = into.subspan(*got);
  }
  return ok_status();
}

Error RandomAccessFile::ends_short(std::uint64_t offset, std::uint64_t by) const {
  return Error{fmt::format("{}: offset {}: the file ends, {} bytes short", name_, offset, by)};
}

Result<FileData> RandomAccessFile::read(std::uint64_t offset, std::uint64_t size) const {
  if (size > kMostReadWhole) {
    const std::uint64_t now = size_of(handle_);  // the file may have been truncated since it was opened
    if (now < offset || now - offset < size)
      return ends_short(std::max(now, offset), offset + size - std::max(now, offset));
    if (auto mapped = map_part(handle_, offset, static_cast<std::size_t>(size))) return *std::move(mapped);
  }
  // Not a vector, which would first fill the memory with zeros.
  std::shared_ptr<std::uint8_t[]> bytes(new (std::nothrow) std::uint8_t[static_cast<std::size_t>(size)]);
  if (!bytes) return Error{fmt::format("{}: offset {}: there is no memory for {} bytes", name_, offset, size)};
  const std::span<std::uint8_t> view(bytes.get(), static_cast<std::size_t>(size));
  if (auto status = read_at(offset, view); !status) return status.error();
  return FileData(view, std::move(bytes));
}

Result<FileData> read_whole_file(const std::filesystem::path& path) {
  auto file = RandomAccessFile::open(path);
  if (!file) return file.error();
  return file->read(0, file->size());
}

Status write_file_atomically(const std::filesystem::path& path, ByteView data, Flush flush) {
  auto file = TemporaryFile::create(path);
  if (!file) return file.error();
  if (auto status = file->append(data); !status) return status;
  return file->commit(flush);
}

Status write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  return write_file_atomically(path, bytes_of_text(text));
}

Result<std::filesystem::path> output_path(const std::filesystem::path& typed) {
  std::error_code code;
  if (!std::filesystem::is_symlink(std::filesystem::symlink_status(typed, code))) return typed;
  auto followed = follow_links(typed.parent_path(), typed.filename());
  return followed ? Result<std::filesystem::path>(std::move(followed->path)) : followed.error();
}

Status write_output(const std::filesystem::path& typed, std::string_view text) {
  using std::filesystem::file_type;
  std::error_code code;
  // As the system follows links: that of /dev/stdout in a pipeline names no path.
  const file_type type = std::filesystem::status(typed, code).type();
  if (type == file_type::regular || type == file_type::not_found || type == file_type::none ||  // links in a circle
      type == file_type::directory) {                                                           // which is refused
    const auto path = output_path(typed);
    return path ? write_text_atomically(*path, text) : Status(path.error());
  }
  std::ofstream stream(typed, std::ios::binary);
  stream << text << std::flush;
  if (stream) return ok_status();
  return Error{fmt::format("{}: cannot be written: {}", typed.generic_string(), last_failure())};
}

}  // namespace fb::fs
