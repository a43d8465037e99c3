#include "fs/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/system.h"
#include "fs/raw_file.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::string_view kPrefix = ".fullbright-", kExtension = ".new";
constexpr std::size_t kDigits = 16;
constexpr Clock::duration kBetweenSweeps = std::chrono::minutes(1);
constexpr std::size_t kMostFolders = 1024;  // that are remembered

// Whether it is time to look for what killed programs have left in a folder.
bool sweep_is_due(const stdfs::path& folder) {
  static std::mutex mutex;
  static std::map<std::string, Clock::time_point> swept;
  const std::lock_guard lock(mutex);
  if (swept.size() > kMostFolders) swept.clear();
  const Clock::time_point now = Clock::now();
  const auto [at, fresh] = swept.emplace(folder.string(), now);
  if (!fresh && now - at->second < kBetweenSweeps) return false;
  at->second = now;
  return true;
}

// With its names on the disk.
Status make_folders(const stdfs::path& folder, const stdfs::path& target) {
  std::error_code code;
  stdfs::path there = folder;
  while (!there.empty() && !stdfs::exists(there, code) && there.has_relative_path()) there = there.parent_path();
  if (there == folder) return ok_status();
  stdfs::create_directories(folder, code);
  if (code) return Error{fmt::format("{}: its directory cannot be made: {}", target.generic_string(), code.message())};
  for (stdfs::path made = folder; made != there && made.has_relative_path(); made = made.parent_path())
    flush_path(made.parent_path());
  return ok_status();
}

}  // namespace

// The process's number is for people who wonder whose it is.
std::string temporary_name() {
  static std::mutex mutex;
  static std::mt19937_64 dice = [] {
    std::random_device device;
    std::seed_seq seed{device(), device(), static_cast<unsigned>(process_number())};
    return std::mt19937_64(seed);
  }();
  const std::lock_guard lock(mutex);
  return fmt::format("{}{}-{:016x}{}", kPrefix, process_number(), dice(), kExtension);
}

void remove_left_over(const stdfs::path& folder) {
  std::vector<stdfs::path> found;
  std::error_code code;
  for (stdfs::directory_iterator it(folder.empty() ? "." : folder, code), end; !code && it != end; it.increment(code)) {
    if (is_temporary_name(it->path().filename().string())) found.push_back(it->path());
  }
  for (const stdfs::path& path : found) remove_unless_held(path);
}

bool is_temporary_name(const std::string& name) {
  std::string_view rest = name;
  if (!rest.starts_with(kPrefix) || !rest.ends_with(kExtension)) return false;
  rest.remove_prefix(kPrefix.size());
  rest.remove_suffix(std::min(kExtension.size(), rest.size()));
  const std::size_t dash = rest.find('-');
  if (dash == 0 || dash == rest.npos || rest.size() - dash - 1 != kDigits) return false;
  return rest.substr(0, dash).find_first_not_of("0123456789") == rest.npos &&
         rest.substr(dash + 1).find_first_not_of("0123456789abcdef") == rest.npos;
}

Result<TemporaryFile> TemporaryFile::create(const stdfs::path& target) {
  const stdfs::path folder = target.parent_path();
  if (auto status = make_folders(folder, target); !status) return status.error();
  if (sweep_is_due(folder)) remove_left_over(folder);
  // The user knows it by the name that it will have.
  auto file = HeldFile::create([&] { return folder / temporary_name(); }, target.generic_string());
  if (!file) return file.error();
  return TemporaryFile(target, *std::move(file));
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!path_.empty()) stdfs::remove(path_, ignored);
}

Status TemporaryFile::commit(Flush flush) {
  if (flush == Flush::kNow) {
    if (auto status = file_.flush(); !status) return status;
  }
  file_.resemble(target_);
  if (const std::error_code failed = rename_over(path_, target_))
    return Error{fmt::format("{}: cannot be written: {}", target_.generic_string(), failed.message())};
  path_.clear();
  if (flush == Flush::kNow) flush_path(target_.parent_path());
  return ok_status();
}

}  // namespace fb::fs
