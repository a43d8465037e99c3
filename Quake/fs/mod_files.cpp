#include "fs/mod_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "fs/held_file.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;

constexpr const char* kFolder = "data";
constexpr std::size_t kFewFiles = 16;  // flushed one by one: the whole file system may have more than is ours

}  // namespace

// Once a level: the player may have put files there or removed some.
void ModFiles::count() {
  counted_ = true;
  number_ = 0;
  bytes_ = 0;
  const auto folder = files_.write_path(kFolder);
  if (!folder) return;
  std::error_code code;
  stdfs::recursive_directory_iterator it(*folder, stdfs::directory_options::skip_permission_denied, code), end;
  for (; !code && it != end; it.increment(code)) {
    std::error_code unreadable;
    if (!it->is_regular_file(unreadable)) continue;
    ++number_;
    const std::uint64_t size = it->file_size(unreadable);
    if (!unreadable) bytes_ += size;
  }
}

Status ModFiles::write(std::string_view name, ByteView data) {
  const auto path = files_.write_path(name);
  if (!path) return path.error();
  if (!counted_) count();
  std::error_code code;
  const bool is_new = !stdfs::is_regular_file(*path, code);
  const std::uint64_t former = is_new ? 0 : stdfs::file_size(*path, code);
  const std::uint64_t others = bytes_ - std::min(bytes_, former);
  if (is_new && number_ >= limits_.files)
    return Error{fmt::format("{}: not written: a mod may keep {} files", name, limits_.files)};
  if (data.size() > limits_.bytes - std::min(limits_.bytes, others))
    return Error{fmt::format("{}: not written: a mod may keep {} bytes in all its files", name, limits_.bytes)};
  if (static_cast<std::size_t>(std::ranges::count(name, '/')) > limits_.depth)
    return Error{fmt::format("{}: not written: a mod's file lies at most {} folders deep", name, limits_.depth)};
  if (auto status = files_.write(name, data, Flush::kLater); !status) return status;
  number_ += is_new ? 1 : 0;
  bytes_ = others + data.size();
  if (unflushed_.size() <= kFewFiles && std::ranges::find(unflushed_, *path) == unflushed_.end())
    unflushed_.push_back(*path);
  return ok_status();
}

void ModFiles::flush() {
  counted_ = false;
  if (unflushed_.size() > kFewFiles) {
    flush_file_system(unflushed_.front().parent_path());
  } else {
    std::set<stdfs::path> folders;
    for (const stdfs::path& path : unflushed_) {
      flush_path(path);
      folders.insert(path.parent_path());
    }
    for (const stdfs::path& folder : folders) flush_path(folder);
  }
  unflushed_.clear();
}

}  // namespace fb::fs
