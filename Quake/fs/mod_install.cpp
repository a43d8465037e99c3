#include "fs/mod_install.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "base/out_of_memory.h"
#include "fs/held_file.h"
#include "fs/path.h"
#include "fs/raw_file.h"
#include "fs/temporary_file.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;

// A folder that is removed with all that is in it unless it was given its name.
class NewFolder {
 public:
  static Result<NewFolder> create(const stdfs::path& place) {
    remove_left_over(place);
    const stdfs::path path = place / temporary_name();
    auto held = HeldFile::take_folder(path);
    if (!held) return held.error();
    return NewFolder(path, *std::move(held));
  }
  NewFolder(NewFolder&& other) noexcept : path_(std::exchange(other.path_, {})), held_(std::move(other.held_)) {}
  NewFolder& operator=(NewFolder&&) = delete;
  ~NewFolder() {
    std::error_code ignored;
    if (!path_.empty()) stdfs::remove_all(path_, ignored);
  }
  const stdfs::path& path() const { return path_; }

  // In the place of the former folder, if there is one.
  Status become(const stdfs::path& target, bool replaces) {
    std::error_code code;
    if (replaces) {
      // The former one has the temporary name then, and is removed.
      if (exchange_names(path_, target)) return ok_status();
      // Under a plain name, which nothing sweeps: a kill between the two leaves the player's files.
      stdfs::path former = target;
      former += ".old";
      if (stdfs::exists(stdfs::symlink_status(former, code)))
        return Error{
            fmt::format("{}: remove it first: the former mod is kept there meanwhile", former.generic_string())};
      stdfs::rename(target, former, code);
      if (code) return failure(target, code);
      stdfs::rename(path_, target, code);
      if (code) {
        const Error error = failure(target, code);
        stdfs::rename(former, target, code);
        return error;
      }
      path_ = former;
      return ok_status();
    }
    stdfs::rename(path_, target, code);
    if (code) return failure(target, code);
    path_.clear();
    return ok_status();
  }

 private:
  NewFolder(stdfs::path path, HeldFile held) : path_(std::move(path)), held_(std::move(held)) {}
  static Error failure(const stdfs::path& target, const std::error_code& code) {
    return Error{fmt::format("{}: cannot be made: {}", target.generic_string(), code.message())};
  }

  stdfs::path path_;
  HeldFile held_;
};

Status unpack(const ModArchive& archive, const stdfs::path& folder, const InstallProgress& progress) {
  const Error given_up{fmt::format("{}: it was not installed: it was given up", archive.name())};
  std::uint64_t done = 0;
  for (const PlannedFile& file : archive.plan().files) {
    const stdfs::path path = folder / file.name;
    std::error_code code;
    stdfs::create_directories(path.parent_path(), code);
    if (code) return Error{fmt::format("{}: {} cannot be made: {}", archive.name(), file.name, code.message())};
    const auto held = HeldFile::create([&] { return path; }, archive.plan().folder + "/" + file.name);
    if (!held) return held.error();
    if (!progress(done)) return given_up;
    const Status status = archive.read(file, [&](ByteView part) -> Status {
      if (auto written = held->append(part); !written) return written;
      done += part.size();
      return progress(done) ? ok_status() : Status(given_up);
    });
    if (!status) return status;
  }
  return ok_status();
}

// Of one file system, so that no byte is copied where it can have two names; a link stays a link.
std::error_code keep_file(const stdfs::path& from, const stdfs::path& to, stdfs::file_type type) {
  std::error_code code;
  stdfs::create_directories(to.parent_path(), code);
  if (code) return code;
  if (type == stdfs::file_type::symlink) {
    stdfs::copy_symlink(from, to, code);
    return code;
  }
  stdfs::create_hard_link(from, to, code);
  if (!code) return code;
  stdfs::copy_file(from, to, code);
  if (!code) flush_path(to);
  return code;
}

// What stays of the former folder, into the new one.
Status keep_files(const stdfs::path& former, const stdfs::path& folder) {
  const bool was_mod = holds_game_data(former);
  std::error_code code;
  stdfs::recursive_directory_iterator it(former, code), end;
  for (; !code && it != end; it.increment(code)) {
    const stdfs::path name = it->path().lexically_relative(former), target = folder / name;
    std::error_code failed;
    const stdfs::file_type type = it->symlink_status(failed).type();
    if (type != stdfs::file_type::regular && type != stdfs::file_type::symlink) continue;
    const Kept kept = kept_file(name.generic_string());
    if (kept == Kept::kNo && was_mod) continue;
    if (stdfs::exists(stdfs::symlink_status(target, failed))) {
      if (kept != Kept::kAlways) continue;
      stdfs::remove_all(target, failed);
    }
    if (failed = keep_file(it->path(), target, type); failed)
      return Error{fmt::format("{} cannot be kept, so the mod stays as it was: {}", it->path().generic_string(),
                               failed.message())};
  }
  if (code) return Error{fmt::format("{}: cannot be read: {}", former.generic_string(), code.message())};
  return ok_status();
}

// The folder that there is or is to be.
stdfs::path target_of(const ModPlan& plan, const ModPlace& place) {
  const stdfs::path there = installed_mod(place.folder, plan.folder);
  return there.empty() ? place.folder / plan.folder : there;
}

}  // namespace

bool holds_game_data(const stdfs::path& folder) {
  std::error_code code;
  for (const char* name : {"pak0.pak", "progs.dat", "maps"})
    if (stdfs::exists(folder / name, code)) return true;
  for (stdfs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    if (ends_with_ignoring_case(it->path().filename().string(), ".pk3")) return true;
  return false;
}

stdfs::path installed_mod(const stdfs::path& place, std::string_view folder) {
  std::error_code code;
  stdfs::path found;
  for (stdfs::directory_iterator it(place, code), end; !code && it != end; it.increment(code)) {
    const std::string name = it->path().filename().string();
    if (name == folder) return it->path();
    if (lower_case(name) == lower_case(folder)) found = it->path();
  }
  return found;
}

Kept kept_file(std::string_view name) {
  const std::string lower = lower_case(name);
  for (const char* folder : {"data/", "screenshots/", "captures/", "autosave/"})
    if (lower.starts_with(folder)) return Kept::kAlways;
  if (lower.ends_with(".sav") || lower == "config.cfg" || lower == "autoexec.cfg") return Kept::kAlways;
  if (lower.find('/') != lower.npos) return Kept::kUnless;
  for (const char* ending : {".dat", ".pak", ".pk3"})
    if (lower.ends_with(ending)) return Kept::kNo;
  return Kept::kUnless;
}

namespace {

Status check_place(const ModPlan& plan, const ModPlace& place, Existing existing) {
  for (const stdfs::path& other : place.others) {
    std::error_code code;
    if (other.empty() || stdfs::equivalent(other, place.folder, code)) continue;
    const stdfs::path there = installed_mod(other, plan.folder);
    if (!there.empty() && holds_game_data(there))
      return Error{fmt::format("{} is there already, where the game's data is; two of them would be mixed",
                               there.generic_string())};
  }
  std::error_code code;
  const stdfs::path target = target_of(plan, place);
  const stdfs::file_type type = stdfs::symlink_status(target, code).type();
  if (type == stdfs::file_type::symlink)
    return Error{fmt::format("{} is a link, in whose place nothing is installed", target.generic_string())};
  if (type != stdfs::file_type::not_found && type != stdfs::file_type::directory)
    return Error{fmt::format("{} is there and is no folder", target.generic_string())};
  if (type == stdfs::file_type::directory && existing == Existing::kRefuse && holds_game_data(target))
    return Error{fmt::format("{} is there already, and was not asked to be replaced", target.generic_string())};
  return ok_status();
}

}  // namespace

Status may_install(const ModPlan& plan, const ModPlace& place, Existing existing) {
  if (auto status = check_place(plan, place, existing); !status) return status;
  std::error_code code;
  const stdfs::space_info space = stdfs::space(place.folder, code);
  if (!code && space.available < plan.bytes)
    return Error{fmt::format("{}: the mod needs {}, and {} are free", place.folder.generic_string(),
                             memory_text(plan.bytes), memory_text(space.available))};
  return ok_status();
}

Result<stdfs::path> install_mod(const ModArchive& archive, const ModPlace& place, Existing existing,
                                const InstallProgress& progress) {
  std::error_code code;
  stdfs::create_directories(place.folder, code);
  if (code) return Error{fmt::format("{}: cannot be made: {}", place.folder.generic_string(), code.message())};
  if (auto status = may_install(archive.plan(), place, existing); !status) return status.error();
  auto folder = NewFolder::create(place.folder);
  if (!folder) return folder.error();
  if (auto status = unpack(archive, folder->path(), progress); !status) return status.error();
  flush_file_system(folder->path());
  // Meanwhile somebody may have put a mod there, or saved.
  if (auto status = check_place(archive.plan(), place, existing); !status) return status.error();
  const stdfs::path target = target_of(archive.plan(), place);
  const bool replaces = stdfs::exists(target, code);
  if (replaces) {
    if (auto status = keep_files(target, folder->path()); !status) return status.error();
    flush_path(folder->path());
  }
  if (auto status = folder->become(target, replaces); !status) return status.error();
  flush_path(place.folder);
  return target;
}

}  // namespace fb::fs
