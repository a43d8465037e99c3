#include "fs/mod_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "fs/path.h"
#include "fs/zip_handle.h"

namespace fb::fs {
namespace {

constexpr std::size_t kLongestName = 240, kLongestPart = 120, kLongestFolder = 64;  // letters
constexpr std::ptrdiff_t kDeepest = 16;                                             // folders in folders
constexpr std::size_t kDeepestMod = 4;                                              // folders around the mod's
constexpr std::size_t kPart = 1u << 20u;
constexpr std::string_view kOwnFolders[] = {"id1", "archives"};  // no mod's

// What Windows takes for a device, whatever follows its first dot.
bool is_device(std::string_view part) {
  const std::string stem = lower_case(part.substr(0, part.find('.')));
  for (const char* name : {"con", "prn", "aux", "nul"})
    if (stem == name) return true;
  return stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) && stem[3] >= '0' && stem[3] <= '9';
}

bool is_plain(std::string_view name) {
  return std::ranges::all_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// Of a system, not of the mod.
bool is_foreign(std::string_view name) {
  if (name.starts_with('.') || name.find("/.") != name.npos) return true;
  const std::string lower = lower_case(name);
  return lower.starts_with("__macosx/") || lower.ends_with("thumbs.db") || lower.ends_with("desktop.ini");
}

// Whether a file's name below a folder, in lower case, makes that folder a game's.
bool is_game_data(std::string_view below) {
  if (below.starts_with("maps/")) return true;
  if (below.find('/') != below.npos) return false;
  return below == "progs.dat" || below == "pak0.pak" || below.ends_with(".pk3");
}

// Of a name that may have any letters.
std::string shown(std::string_view name) {
  std::string text(name.substr(0, kLongestName));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return text;
}

struct Listed {
  std::string name, lower;
  std::uint64_t index, size;
};

// The names that an archive has had, each in the case of its first time.
class Names {
 public:
  // Why this one may not follow; empty if it may. Its folders are noted, too.
  std::string fault_of(std::string_view name, bool folder) {
    for (std::size_t slash = name.find('/'); slash != name.npos; slash = name.find('/', slash + 1))
      if (std::string fault = note(name.substr(0, slash), true); !fault.empty()) return fault;
    return note(name, folder);
  }

 private:
  std::string note(std::string_view name, bool folder) {
    const auto [at, fresh] = seen_.try_emplace(lower_case(name), std::string(name), folder);
    if (fresh || (at->second == std::pair(std::string(name), true) && folder)) return {};
    if (at->second.first != name) return fmt::format("it differs from \"{}\" by case alone", at->second.first);
    return folder != at->second.second ? "it is a file and a folder" : "there is another of its name";
  }

  std::map<std::string, std::pair<std::string, bool>> seen_;  // by the name in lower case; whether it is a folder
};

// The folders that have game data, "a/ad/", and those that lie alone in theirs.
struct Folders {
  std::set<std::string> games;
  std::map<std::string, std::set<std::string>> within;  // by the folder around them; two of each are enough
};

Folders folders_of(const std::vector<Listed>& files) {
  Folders folders;
  for (const Listed& file : files) {
    for (std::size_t start = 0; start != file.name.npos;) {
      const std::string prefix = file.name.substr(0, start);
      if (is_game_data(std::string_view(file.lower).substr(start))) folders.games.insert(prefix);
      const std::size_t slash = file.name.find('/', start);
      if (slash == file.name.npos) break;
      start = slash + 1;
      if (auto& inner = folders.within[prefix]; inner.size() < 2) inner.insert(file.name.substr(0, start));
    }
  }
  return folders;
}

// The folder of the mod, "ad/"; empty: the archive's top.
Result<std::string> find_mod(const std::vector<Listed>& files) {
  Folders folders = folders_of(files);
  std::string prefix;
  for (std::size_t depth = 0; depth <= kDeepestMod; ++depth) {
    if (folders.games.contains(prefix)) return prefix;
    std::vector<std::string> mods;
    for (const std::string& game : folders.games)
      if (game.starts_with(prefix) && game.find('/', prefix.size()) == game.size() - 1) mods.push_back(game);
    if (mods.size() > 1) return Error{fmt::format("it holds several mods, {} and {}", mods[0], mods[1])};
    if (mods.size() == 1) return mods.front();
    if (folders.within[prefix].size() != 1) break;
    prefix = *folders.within[prefix].begin();
  }
  if (std::ranges::any_of(files, [](const Listed& file) { return file.lower.ends_with(".bsp"); }))
    return Error{"it holds maps alone: unpack them into the folder id1/maps"};
  return Error{"there is no mod in it: it has no progs.dat, no pak0.pak, no pk3 and no maps"};
}

// The names that a game's folder is known by are looked for in lower case.
std::string in_folder(std::string_view name, std::string_view lower) {
  const std::size_t first = std::min(lower.find('/'), lower.size());
  const std::string_view top = lower.substr(0, first);
  const bool known = first == lower.size() ? top == "progs.dat" || top.ends_with(".pak") : top == "maps";
  return std::string(known ? top : name.substr(0, first)) + std::string(name.substr(first));
}

Status take_size(const zip_stat_t& stat, std::uint64_t archive_size, const ModLimits& limits, std::uint64_t& bytes,
                 std::uint64_t& packed) {
  bytes += stat.size;
  packed += stat.comp_size;
  if (bytes > limits.bytes) return Error{fmt::format("its files are more than the {} bytes of a mod", limits.bytes)};
  if (packed > archive_size) return Error{"its files share their packed bytes, as in no sound archive"};
  if (bytes > limits.ratio_from && bytes / limits.ratio >= archive_size)
    return Error{fmt::format("its files unpack to more than {} times its size", limits.ratio)};
  return ok_status();
}

// Of a Unix system's: a link or a device. Other systems leave the type zero.
bool is_special(::zip* archive, std::uint64_t index) {
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  if (zip_file_get_external_attributes(archive, index, 0, &system, &attributes) != 0) return false;
  constexpr zip_uint32_t kType = 0170000, kFolder = 0040000, kFile = 0100000;
  const zip_uint32_t type = (attributes >> 16u) & kType;
  return type != 0 && type != kFolder && type != kFile;
}

}  // namespace

std::string name_fault(std::string_view name) {
  if (name.empty()) return "it has no name";
  if (name.front() == '/') return "its name leads outside of the mod's folder";
  if (name.size() > kLongestName) return fmt::format("its name is longer than {} letters", kLongestName);
  if (std::ranges::count(name, '/') > kDeepest) return fmt::format("it lies more than {} folders deep", kDeepest);
  for (std::size_t start = 0; start <= name.size();) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    const std::string_view part = name.substr(start, end - start);
    start = end + 1;
    if (part == "..") return "its name leads outside of the mod's folder";
    for (const char c : part) {
      if (c == '\\') return "its name has a backslash";
      if (c == ':') return "its name has a colon, as drives have";
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
          std::string_view("<>\"|?*").find(c) != std::string_view::npos)
        return "its name has a letter that no file may have on every system";
    }
    if (part.empty() || part == "." || part.back() == '.' || part.back() == ' ' || part.front() == ' ')
      return "its name is not the same on every system";
    if (part.size() > kLongestPart) return fmt::format("its name has a part longer than {} letters", kLongestPart);
    if (is_device(part)) return "its name is a device's on Windows";
  }
  return {};
}

std::string mod_folder_name(std::string_view called) {
  std::string name = lower_case(called).substr(0, kLongestFolder);
  for (char& c : name)
    if (!(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9') &&
        std::string_view("._+-").find(c) == std::string_view::npos)
      c = '_';
  name.erase(0, std::min(name.find_first_not_of("._+-"), name.size()));
  name.erase(name.find_last_not_of("._+-") + 1);
  while (name.find("..") != name.npos) name.erase(name.find(".."), 1);
  return is_device(name) ? std::string() : name;
}

Result<std::unique_ptr<ModArchive>> ModArchive::open(const std::filesystem::path& path, const ModLimits& limits) {
  const std::string name = path.filename().string();
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return Error{fmt::format("{}: {}", name, code ? code.message() : "it is no file")};
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code) return Error{fmt::format("{}: cannot be read: {}", name, code.message())};
  const auto archive = open_zip(path, name);
  if (!archive) return archive.error();
  return finish(std::unique_ptr<ModArchive>(new ModArchive(*archive, {}, name)), size, limits);
}

Result<std::unique_ptr<ModArchive>> ModArchive::open(FileData data, std::string name, const ModLimits& limits) {
  const auto archive = open_zip(data, name);
  if (!archive) return archive.error();
  const std::uint64_t size = data.size();
  return finish(std::unique_ptr<ModArchive>(new ModArchive(*archive, std::move(data), std::move(name))), size, limits);
}

Result<std::unique_ptr<ModArchive>> ModArchive::finish(std::unique_ptr<ModArchive> archive, std::uint64_t size,
                                                       const ModLimits& limits) {
  if (Status status = archive->list(size, limits); !status)
    return Error{fmt::format("{}: {}", archive->name_, status.error().message)};
  return archive;
}

ModArchive::~ModArchive() { zip_discard(archive_); }

Status ModArchive::list(std::uint64_t archive_size, const ModLimits& limits) {
  const auto count = static_cast<std::uint64_t>(std::max<zip_int64_t>(zip_get_num_entries(archive_, 0), 0));
  if (count > limits.entries)
    return Error{fmt::format("it has {} files, of {} that a mod may have", count, limits.entries)};
  std::vector<Listed> files;
  Names names;
  std::size_t left_out = 0;
  std::string first;
  const auto leave_out = [&](std::string_view name) {
    if (left_out++ == 0) first = shown(name);
  };
  std::uint64_t bytes = 0, packed = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    const bool known = zip_stat_index(archive_, i, ZIP_FL_ENC_RAW, &stat) == 0 && (stat.valid & ZIP_STAT_NAME);
    std::string_view name = known ? std::string_view(stat.name) : std::string_view();
    const auto refused = [&](std::string_view why) { return Error{fmt::format("\"{}\" in it: {}", shown(name), why)}; };
    const bool folder = name.ends_with('/');
    if (folder) name.remove_suffix(1);
    if (const std::string fault = name_fault(name); !fault.empty()) return refused(fault);
    if (is_special(archive_, i)) return refused("it is a link or a device");
    if (const std::string fault = names.fault_of(name, folder); !fault.empty()) return refused(fault);
    if (folder) continue;
    if (const std::string fault = zip_fault(stat, archive_size, limits.file_bytes); !fault.empty())
      return refused(fault);
    if (auto status = take_size(stat, archive_size, limits, bytes, packed); !status) return status;
    if (is_foreign(name)) continue;
    if (!is_plain(name))
      leave_out(name);
    else
      files.push_back({std::string(name), lower_case(name), i, stat.size});
  }
  const auto prefix = find_mod(files);
  if (!prefix) return prefix.error();
  const std::string_view path = *prefix;
  const std::string_view called = path.empty()
                                      ? std::string_view(name_).substr(0, name_.find_last_of('.'))
                                      : path.substr(0, path.size() - 1).substr(path.rfind('/', path.size() - 2) + 1);
  plan_.folder = mod_folder_name(called);
  if (plan_.folder.empty()) return Error{fmt::format("\"{}\" gives no name for the mod's folder", called)};
  for (const std::string_view own : kOwnFolders)
    if (plan_.folder == own)
      return Error{fmt::format("its folder is {}, which is no mod's: unpack it there by hand", own)};
  for (const Listed& file : files) {
    if (!file.name.starts_with(path)) {
      leave_out(file.name);
      continue;
    }
    const std::size_t size = path.size();
    plan_.files.push_back(
        {in_folder(std::string_view(file.name).substr(size), std::string_view(file.lower).substr(size)), file.index,
         file.size});
    plan_.bytes += file.size;
  }
  if (left_out > 0)
    plan_.left_out = fmt::format("{}: {} of {} files are left out, the first is {}", name_, left_out, count, first);
  return ok_status();
}

Status ModArchive::read(const PlannedFile& file, const std::function<Status(ByteView part)>& take) const {
  const auto damaged = [&](std::string_view cause) {
    return Error{fmt::format("{}: {} in it is damaged: {}", name_, file.name, cause)};
  };
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> opened(zip_fopen_index(archive_, file.index, 0), zip_fclose);
  if (!opened) return damaged(zip_strerror(archive_));
  Bytes part(kPart);
  for (std::uint64_t left = file.size;;) {
    // Behind the last byte libzip compares the checksum.
    const zip_int64_t got = zip_fread(opened.get(), part.data(), left > 0 ? std::min<std::uint64_t>(left, kPart) : 1);
    if (got < 0) return damaged(zip_error_strerror(zip_file_get_error(opened.get())));
    if (got == 0 && left > 0) return damaged(fmt::format("it ends {} bytes early", left));
    if (got > 0 && left == 0) return damaged("it is longer than it claims");
    if (got == 0) return ok_status();
    left -= static_cast<std::uint64_t>(got);
    if (auto status = take(ByteView(part).first(static_cast<std::size_t>(got))); !status) return status;
  }
}

}  // namespace fb::fs
