#include "fs/zip.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/log.h"
#include "fs/path.h"
#include "fs/zip_handle.h"

namespace fb::fs {

Result<std::unique_ptr<Zip>> Zip::open(const std::filesystem::path& path, std::string name) {
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code) return Error{fmt::format("{}: cannot be read: {}", name, code.message())};
  const auto archive = open_zip(path, name);
  if (!archive) return archive.error();
  return finish(std::unique_ptr<Zip>(new Zip(*archive, {}, std::move(name))), size);
}

Result<std::unique_ptr<Zip>> Zip::open(FileData data, std::string name) {
  const auto archive = open_zip(data, name);
  if (!archive) return archive.error();
  const std::uint64_t size = data.size();
  return finish(std::unique_ptr<Zip>(new Zip(*archive, std::move(data), std::move(name))), size);
}

Result<std::unique_ptr<Zip>> Zip::finish(std::unique_ptr<Zip> zip, std::uint64_t archive_size) {
  if (Status status = zip->list(archive_size); !status) return status.error();
  return zip;
}

Zip::~Zip() { zip_discard(archive_); }

Status Zip::list(std::uint64_t archive_size) {
  const auto count = static_cast<std::uint64_t>(std::max<zip_int64_t>(zip_get_num_entries(archive_, 0), 0));
  if (count > kMostZipEntries)
    return Error{fmt::format("{}: {} files, of {} that an archive may have", name_, count, kMostZipEntries)};
  std::size_t bad = 0;
  std::string first;
  for (std::uint64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    const bool known = zip_stat_index(archive_, i, ZIP_FL_ENC_RAW, &stat) == 0 && (stat.valid & ZIP_STAT_NAME);
    const std::string_view raw = known ? std::string_view(stat.name) : std::string_view();
    if (raw.ends_with('/')) continue;  // a folder
    const auto name = normalise(raw);
    std::string fault = !known                     ? "it has no name"
                        : !name                    ? "its name leads outside of the game"
                        : by_name_.contains(*name) ? "there is another of its name"
                                                   : zip_fault(stat, archive_size, kMostZipFile);
    if (!fault.empty()) {
      if (bad++ == 0) first = fmt::format("\"{}\": {}", raw.substr(0, 200), fault);
      continue;
    }
    by_name_.emplace(*name, entries_.size());
    by_lower_name_.emplace(lower_case(*name), entries_.size());
    entries_.push_back({*name, i, static_cast<std::uint32_t>(stat.size)});
  }
  if (bad > 0) left_out_ = fmt::format("{}: {} of {} files are left out; the first is {}", name_, bad, count, first);
  return ok_status();
}

const PakEntry* Zip::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &entries_[found->second];
}

const PakEntry* Zip::find_ignoring_case(std::string_view name) const {
  const auto found = by_lower_name_.find(lower_case(name));
  return found == by_lower_name_.end() ? nullptr : &entries_[found->second];
}

Error Zip::error(const PakEntry& entry, std::string_view cause) const {
  return Error{fmt::format("{}:{}: {}", name_, entry.name, cause)};
}

Result<FileData> Zip::read(const PakEntry& entry, std::uint64_t offset, std::uint64_t most) const {
  offset = std::min<std::uint64_t>(offset, entry.size);
  const std::uint64_t end = offset + std::min(most, entry.size - offset);
  const bool whole = end == entry.size;
  Bytes bytes(end);
  std::lock_guard lock(mutex_);
  zip_file_t* file = zip_fopen_index(archive_, entry.offset, 0);
  if (!file) return error(entry, zip_strerror(archive_));
  const auto fail = [&](const std::string& cause) {
    zip_fclose(file);
    return error(entry, cause);
  };
  for (std::uint64_t at = 0; at < end;) {
    const zip_int64_t got = zip_fread(file, bytes.data() + at, end - at);
    if (got < 0) return fail(zip_error_strerror(zip_file_get_error(file)));
    if (got == 0) return fail(fmt::format("it ends after {} of {} bytes", at, entry.size));
    at += static_cast<std::uint64_t>(got);
  }
  // Behind the last byte libzip compares the checksum.
  std::uint8_t behind = 0;
  const zip_int64_t more = whole ? zip_fread(file, &behind, 1) : 0;
  if (more < 0) return fail(zip_error_strerror(zip_file_get_error(file)));
  if (more > 0) return fail(fmt::format("it has more than its {} bytes", entry.size));
  zip_fclose(file);
  if (offset > 0) bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  return FileData(std::move(bytes));
}

std::vector<std::unique_ptr<Zip>> open_archives(const std::filesystem::path& directory, const std::string& label) {
  std::vector<std::string> names;
  std::error_code code, unreadable;
  for (std::filesystem::directory_iterator it(directory, code), end; !code && it != end; it.increment(code)) {
    const std::string name = it->path().filename().string();
    if (ends_with_ignoring_case(name, ".pk3") && it->is_regular_file(unreadable)) names.push_back(name);
  }
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return std::pair(lower_case(a), a) < std::pair(lower_case(b), b);
  });
  if (names.size() > kMostArchives) {
    log_warning("{}: {} archives, of {} that are read", label, names.size(), kMostArchives);
    names.resize(kMostArchives);
  }
  std::vector<std::unique_ptr<Zip>> archives;
  for (const std::string& name : names) {
    auto zip = Zip::open(directory / name, label + "/" + name);
    if (!zip) {
      log_warning("{}; it is left out", zip.error().message);
      continue;
    }
    if (!(*zip)->left_out().empty()) log_warning("{}", (*zip)->left_out());
    archives.push_back(*std::move(zip));
  }
  return archives;
}

}  // namespace fb::fs
