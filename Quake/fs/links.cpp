#include "fs/links.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <system_error>

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;

constexpr int kMostLinks = 40;  // as Linux

void put_first(std::deque<stdfs::path>& parts, const stdfs::path& path) {
  const stdfs::path relative = path.relative_path();
  parts.insert(parts.begin(), relative.begin(), relative.end());
}

stdfs::path without_links(const stdfs::path& folder) {
  std::error_code code;
  return stdfs::weakly_canonical(stdfs::absolute(folder.empty() ? "." : folder, code), code);
}

}  // namespace

Result<Followed> follow_links(const stdfs::path& folder, const stdfs::path& name) {
  std::error_code code;
  std::deque<stdfs::path> left;
  put_first(left, name);
  stdfs::path at = without_links(folder);
  int links = 0;
  while (!left.empty()) {
    const stdfs::path part = left.front();
    left.pop_front();
    if (part.empty() || part == ".") continue;
    if (part == "..") {
      at = at.parent_path();  // no link is left in it
      continue;
    }
    const stdfs::path next = at / part;
    if (!stdfs::is_symlink(stdfs::symlink_status(next, code))) {
      at = next;
      continue;
    }
    if (++links > kMostLinks)
      return Error{fmt::format("{}: its links lead in a circle", (folder / name).generic_string())};
    const stdfs::path target = stdfs::read_symlink(next, code);
    if (code) return Error{fmt::format("{}: cannot be read: {}", next.generic_string(), code.message())};
    if (target.is_absolute()) at = target.root_path();
    put_first(left, target);
  }
  return links == 0 ? Followed{folder / name, false} : Followed{at, true};
}

bool is_within(const stdfs::path& path, const stdfs::path& folder) {
  const stdfs::path whole = without_links(folder);
  const auto [in_folder, in_path] = std::mismatch(whole.begin(), whole.end(), path.begin(), path.end());
  return in_folder == whole.end() && in_path != path.end();
}

}  // namespace fb::fs
