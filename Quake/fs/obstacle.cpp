#include "fs/obstacle.h"

#include <fmt/format.h>

#include <iterator>
#include <system_error>

#include "fs/file.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;

Error cannot_be_read(const stdfs::path& path, const std::string& cause) {
  return Error{fmt::format("{}: cannot be read: {}", path.generic_string(), cause)};
}

}  // namespace

PathFacts look_at(const stdfs::path& path) {
  std::error_code code, ignored;
  const stdfs::file_status status = stdfs::status(path, code);
  switch (status.type()) {
    case stdfs::file_type::regular:
      return {Standing::kFile, {}};
    case stdfs::file_type::directory:
      return {Standing::kDirectory, "it is a directory"};
    case stdfs::file_type::not_found:
      if (!stdfs::is_symlink(stdfs::symlink_status(path, ignored))) return {};
      return {Standing::kUnreadable, fmt::format("it is a link to {}, and nothing is there",
                                                 stdfs::read_symlink(path, ignored).generic_string())};
    case stdfs::file_type::none:
      // No file system has a name that is too long for it.
      if (code == std::errc::filename_too_long) return {};
      return {Standing::kUnreadable, code.message()};
    default:
      return {Standing::kUnreadable, "it is neither a file nor a directory"};
  }
}

Status check_reach(const stdfs::path& directory) {
  std::error_code code;
  (void)stdfs::status(directory / ".", code);
  if (code) return cannot_be_read(directory, code.message());
  return ok_status();
}

Status check_listing(const stdfs::path& directory) {
  std::error_code code;
  (void)stdfs::directory_iterator(directory, code);
  if (code) return Error{fmt::format("{}: cannot be listed: {}", directory.generic_string(), code.message())};
  return ok_status();
}

std::optional<Error> find_obstacle(const stdfs::path& directory, std::string_view name) {
  stdfs::path path = directory;
  const stdfs::path parts(name);
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    if (look_at(path).standing != Standing::kDirectory) return std::nullopt;
    if (auto status = check_reach(path); !status) return status.error();
    path /= *part;
    const PathFacts facts = look_at(path);
    const bool last = std::next(part) == parts.end();
    if (facts.standing == Standing::kUnreadable || (last && facts.standing == Standing::kDirectory))
      return cannot_be_read(path, facts.cause);
    if (facts.standing == Standing::kAbsent) return std::nullopt;
  }
  if (auto file = RandomAccessFile::open(path); !file) return file.error();
  return std::nullopt;
}

}  // namespace fb::fs
