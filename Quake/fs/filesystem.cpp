#include "fs/filesystem.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "base/log.h"
#include "fs/directory_index.h"
#include "fs/links.h"
#include "fs/obstacle.h"
#include "fs/path.h"
#include "fs/place.h"
#include "fs/zip.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;

constexpr std::string_view kSettings = "config.cfg";

bool is_file(const stdfs::path& path) {
  std::error_code code;
  return stdfs::is_regular_file(path, code);
}
bool is_a_directory(const stdfs::path& path) {
  std::error_code code;
  return stdfs::is_directory(path, code);
}

// Warns at once, because files in a folder that cannot be read would otherwise only be missed later, one by one.
void warn_of_folders(const stdfs::path& directory) {
  const auto warn = [](const Status& status) {
    if (!status) log_warning("{}", status.error().message);
    return status.ok();
  };
  if (!warn(check_listing(directory))) return;
  std::error_code code;
  for (stdfs::directory_iterator it(directory, code), end; !code && it != end; it.increment(code)) {
    if (!is_a_directory(it->path())) continue;
    if (warn(check_reach(it->path()))) (void)warn(check_listing(it->path()));
  }
}

// Returns false if there is none; fails if it exists and cannot be read.
Result<bool> take_directory(const stdfs::path& directory) {
  const PathFacts facts = look_at(directory);
  if (facts.standing == Standing::kAbsent) return false;
  const bool is_file = facts.standing == Standing::kFile;
  if (facts.standing != Standing::kDirectory) {
    return Error{fmt::format("{}: cannot be read: {}", directory.generic_string(),
                             is_file ? "it is a file, not a directory" : facts.cause)};
  }
  if (auto status = check_reach(directory); !status) return status.error();
  warn_of_folders(directory);
  return true;
}

}  // namespace

struct FileSystem::Impl {
  FsOptions options;
  stdfs::path user_dir;            // empty: none
  bool homeless = false;           // there is no user_dir where one was wanted
  std::string game = "id1";        // where writing goes
  std::vector<Place> places;       // in search order
  mutable DirectoryIndex index;    // guards itself
  mutable std::mutex notes_mutex;  // guards `noted`
  mutable std::set<std::string> noted;

  Status add_game(const std::string& name, int game_index);
  Status add_base_game_beneath();
  Status add_directory(const stdfs::path& directory, const std::string& label, int game_index);
  Result<std::unique_ptr<Pak>> open_pak(const stdfs::path& directory, std::string file, const std::string& label);
  std::optional<Hit> find_exact(const std::string& name) const;
  std::optional<Hit> find_ignoring_case(const std::string& name) const;
  std::optional<Hit> locate(std::string_view name) const;
  std::optional<Error> obstacle(std::string_view name) const;
  bool stays_within(const stdfs::path& path) const;
  stdfs::path write_folder() const { return (user_dir.empty() ? options.base_dir : user_dir) / game; }
  static bool keeps_settings(const std::string& name, const stdfs::path& target);
  // True the first time.
  bool note(const std::string& text) const;
};

// Null if there is none of this name.
Result<std::unique_ptr<Pak>> FileSystem::Impl::open_pak(const stdfs::path& directory, std::string file,
                                                        const std::string& label) {
  PathFacts facts = look_at(directory / file);
  if (facts.standing == Standing::kAbsent) {
    const auto other_case = index.find(directory, file);
    if (!other_case) return std::unique_ptr<Pak>();
    log_info("{}/{} is taken for {}: its name differs in case.", label, *other_case, file);
    file = *other_case;
    facts = look_at(directory / file);
  }
  if (facts.standing != Standing::kFile)
    return Error{fmt::format("{}: cannot be read: {}", (directory / file).generic_string(), facts.cause)};
  auto pak = Pak::open(directory / file, label + "/" + file);
  if (!pak) return pak.error();
  return std::make_unique<Pak>(*std::move(pak));
}

// Each directory is searched before those added earlier, and each of its paks before lower-numbered ones.
Status FileSystem::Impl::add_directory(const stdfs::path& directory, const std::string& label, int game_index) {
  std::vector<Place> stack;
  Place loose;
  loose.label = label;
  loose.game_index = game_index;
  loose.directory = directory;
  stack.push_back(std::move(loose));
  for (int number = 0;; ++number) {
    auto pak = open_pak(directory, fmt::format("pak{}.pak", number), label);
    if (!pak) return pak.error();
    if (*pak == nullptr) break;
    Place place;
    place.label = (*pak)->name();
    place.game_index = game_index;
    place.pak = *std::move(pak);
    stack.push_back(std::move(place));
  }
  for (auto& zip : open_archives(directory, label)) {
    Place place;
    place.label = zip->name();
    place.game_index = game_index;
    place.zip = std::move(zip);
    stack.push_back(std::move(place));
  }
  for (Place& place : stack) places.insert(places.begin(), std::move(place));
  return ok_status();
}

Status FileSystem::Impl::add_game(const std::string& name, int game_index) {
  std::string folder = name;
  if (look_at(options.base_dir / folder).standing == Standing::kAbsent) {
    if (const auto other_case = index.find(options.base_dir, name)) folder = *other_case;
  }
  const auto in_base = take_directory(options.base_dir / folder);
  if (!in_base) return in_base.error();
  const Result<bool> in_user = user_dir.empty() ? Result<bool>(false) : take_directory(user_dir / name);
  const Error none{
      fmt::format("{}: there is no directory {} in it; -basedir DIR says where the game's data is: DIR holds id1",
                  options.base_dir.generic_string(), name)};
  if (!*in_base && (!in_user || !*in_user)) return none;
  if (auto status = add_directory(options.base_dir / folder, folder, game_index); !status) return status;
  // Errors in the player's own folder are no reason to fail: a game can be played without it. If it does not exist, it
  // may be created later.
  if (!in_user) log_warning("{}; what the player has there is left out", in_user.error().message);
  if (in_user && !user_dir.empty()) {
    if (auto status = add_directory(user_dir / name, "user/" + name, game_index); !status) return status;
  }
  // The player's own id1 may be the whole game; with settings and saves alone it is none.
  if (!*in_base && game_index == 0 && !locate("progs.dat")) return none;
  game = name;
  return ok_status();
}

Status FileSystem::Impl::add_base_game_beneath() {
  if (locate("progs.dat") || !is_a_directory(options.base_game / "id1")) return ok_status();
  std::vector<Place> above = std::exchange(places, {});
  auto status = add_directory(options.base_game / "id1", "basegame/id1", -1);
  places.insert(places.begin(), std::move_iterator(above.begin()), std::move_iterator(above.end()));
  if (status)
    log_info("There is no progs.dat in {}: the base game's code plays it.", options.base_dir.generic_string());
  return status;
}

std::optional<Hit> FileSystem::Impl::find_exact(const std::string& name) const {
  for (const Place& place : places) {
    if (place.packed()) {
      if (const PakEntry* entry = place.find(name)) return Hit{&place, entry, {}};
    } else if (stdfs::path path = place.directory / name; is_file(path)) {
      return Hit{&place, nullptr, std::move(path)};
    }
  }
  return std::nullopt;
}

std::optional<Hit> FileSystem::Impl::find_ignoring_case(const std::string& name) const {
  for (const Place& place : places) {
    if (place.packed()) {
      if (const PakEntry* entry = place.find_ignoring_case(name)) return Hit{&place, entry, {}};
    } else if (const auto real = index.find(place.directory, name)) {
      if (stdfs::path path = place.directory / *real; is_file(path)) return Hit{&place, nullptr, std::move(path)};
    }
  }
  return std::nullopt;
}

std::optional<Hit> FileSystem::Impl::locate(std::string_view raw_name) const {
  const auto name = normalise(raw_name);
  if (!name) return std::nullopt;
  if (auto hit = find_exact(*name)) return hit;
  auto hit = find_ignoring_case(*name);
  if (hit && note(*name)) {
    const std::string real = hit->entry != nullptr ? hit->entry->name : hit->path.filename().generic_string();
    log_info("{}: found only as {} in {}: its name differs in case.", *name, real, hit->place->label);
  }
  return hit;
}

bool FileSystem::Impl::note(const std::string& text) const {
  std::lock_guard lock(notes_mutex);
  return noted.insert(text).second;
}

std::optional<Error> FileSystem::Impl::obstacle(std::string_view raw_name) const {
  if (const auto hit = locate(raw_name)) {
    if (hit->entry != nullptr) return std::nullopt;
    const auto file = RandomAccessFile::open(hit->path);
    return file ? std::nullopt : std::optional(file.error());
  }
  const auto name = normalise(raw_name);
  if (!name) return std::nullopt;
  for (const Place& place : places) {
    if (place.packed()) continue;
    if (auto found = find_obstacle(place.directory, *name)) return found;
  }
  return std::nullopt;
}

FileSystem::FileSystem(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FileSystem::FileSystem(FileSystem&&) noexcept = default;
FileSystem& FileSystem::operator=(FileSystem&&) noexcept = default;
FileSystem::~FileSystem() = default;

Result<FileSystem> FileSystem::open(const FsOptions& options) {
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  const bool in_the_box =
      !options.base_dir_named && !options.base_game.empty() && !is_a_directory(options.base_dir / "id1");
  if (in_the_box) impl->options.base_dir = options.base_game;
  impl->user_dir = options.user_dir ? *options.user_dir : default_user_dir();
  impl->homeless = !options.user_dir && impl->user_dir.empty() && !plays_beside_data();
  if (impl->homeless) log_warning("There is no home folder: nothing can be saved; -userdir DIR names a folder for it.");
  // If the user directory is the base directory, the same files would be found twice.
  std::error_code code;
  if (!impl->user_dir.empty() && stdfs::equivalent(impl->user_dir, impl->options.base_dir, code))
    impl->user_dir.clear();

  if (auto status = impl->add_game("id1", 0); !status) return status.error();
  int game_index = 1;
  for (const std::string& game : options.games) {
    if (!is_game_name(game)) return Error{fmt::format("\"{}\": a gamedir is one directory's name, not a path", game)};
    if (auto status = impl->add_game(game, game_index++); !status) return status.error();
  }
  if (!options.base_game.empty() && !in_the_box) {
    if (auto status = impl->add_base_game_beneath(); !status) return status.error();
  }
  return FileSystem(std::move(impl));
}

Result<FileData> FileSystem::load(std::string_view name) const {
  const auto hit = impl_->locate(name);
  if (!hit) {
    return impl_->obstacle(name).value_or(
        Error{fmt::format("{}: no such file in the game's directories and paks", name)});
  }
  return hit->read();
}

Result<FileData> FileSystem::load_part(std::string_view name, std::uint64_t offset, std::uint64_t most) const {
  const auto hit = impl_->locate(name);
  if (!hit) return Error{fmt::format("{}: no such file in the game's directories and paks", name)};
  if (hit->place->zip) return hit->place->zip->read(*hit->entry, offset, most);
  if (hit->entry != nullptr) {
    PakEntry part = *hit->entry;
    const std::uint64_t skipped = std::min<std::uint64_t>(offset, part.size);
    part.offset += skipped;
    part.size = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, part.size - skipped));
    return hit->place->pak->read(part);
  }
  const auto file = RandomAccessFile::open(hit->path);
  if (!file) return file.error();
  const std::uint64_t skipped = std::min(offset, file->size());
  return file->read(skipped, std::min(most, file->size() - skipped));
}

std::optional<FileData> FileSystem::read(std::string_view name) const {
  const auto hit = impl_->locate(name);
  if (!hit) {
    if (const auto obstacle = impl_->obstacle(name); obstacle && impl_->note(obstacle->message))
      log_warning("{}", obstacle->message);
    return std::nullopt;
  }
  auto data = hit->read();
  if (data) return *std::move(data);
  log_warning("{}", data.error().message);
  return std::nullopt;
}

// Whether a path without links lies in a folder that is searched.
bool FileSystem::Impl::stays_within(const stdfs::path& path) const {
  return std::ranges::any_of(places,
                             [&](const Place& place) { return !place.pak && is_within(path, place.directory); });
}

std::optional<FileData> FileSystem::read_for_mod(std::string_view name) const {
  const auto hit = impl_->locate(name);
  if (hit && hit->entry == nullptr) {
    const stdfs::path& folder = hit->place->directory;
    const auto followed = follow_links(folder, hit->path.lexically_relative(folder));
    if (!followed || (followed->by_link && !impl_->stays_within(followed->path))) {
      if (impl_->note(hit->path.string())) {
        log_warning("{}: not read for the mod: a link leads out of the game's folders", hit->path.generic_string());
      }
      return std::nullopt;
    }
  }
  return read(name);
}

std::optional<FileData> FileSystem::read_own(std::string_view raw_name) const {
  const auto name = normalise(raw_name);
  if (!name) return std::nullopt;
  const int last = impl_->places.front().game_index;
  for (const Place& place : impl_->places) {
    if (place.packed() || place.game_index != last || !is_file(place.directory / *name)) continue;
    auto data = read_whole_file(place.directory / *name);
    if (data) return *std::move(data);
    log_warning("{}", data.error().message);
    return std::nullopt;
  }
  return std::nullopt;
}

std::vector<FileData> FileSystem::read_all(std::string_view raw_name) const {
  std::vector<FileData> all;
  const auto name = normalise(raw_name);
  if (!name) return all;
  for (const Place& place : impl_->places) {
    const Hit hit{&place, place.packed() ? place.find(*name) : nullptr, place.directory / *name};
    if (place.packed() ? !hit.entry : !is_file(hit.path)) continue;
    if (auto data = hit.read())
      all.push_back(*std::move(data));
    else
      log_warning("{}", data.error().message);
  }
  return all;
}

std::optional<Error> FileSystem::obstacle(std::string_view name) const { return impl_->obstacle(name); }

bool FileSystem::exists(std::string_view name) const { return impl_->locate(name).has_value(); }

std::string FileSystem::source_of(std::string_view name) const {
  const auto hit = impl_->locate(name);
  return hit ? hit->place->label : std::string();
}

int FileSystem::game_index_of(std::string_view name) const {
  const auto hit = impl_->locate(name);
  return hit ? hit->place->game_index : -1;
}

bool FileSystem::is_of_base_game(std::string_view name) const {
  const int index = game_index_of(name);
  std::error_code failed;
  if (index == 0) return std::filesystem::equivalent(impl_->options.base_dir, impl_->options.base_game, failed);
  return index < 0 && exists(name);
}

std::vector<FoundFile> FileSystem::find(std::string_view prefix, std::string_view extension) const {
  const Pattern pattern{lower_case(prefix), extension};
  ListedFiles files;
  for (const Place& place : impl_->places) {
    if (place.packed()) {
      for (const PakEntry& entry : place.entries()) {
        if (pattern.file(entry.name)) files.emplace(entry.name, FoundFile{entry.name, place.label, entry.size});
      }
    } else {
      add_loose_files(place.directory, place, pattern, files);
    }
  }
  std::vector<FoundFile> list;
  list.reserve(files.size());
  for (auto& [name, file] : files) list.push_back(std::move(file));
  return list;
}

// A file of settings that a mod's archive could name would be no harm; ~/.profile would.
bool FileSystem::Impl::keeps_settings(const std::string& name, const stdfs::path& target) {
  std::error_code code;
  const bool fits = stdfs::is_regular_file(target, code) ||
                    (!stdfs::exists(target, code) && stdfs::is_directory(target.parent_path(), code));
  return name == kSettings && fits && ends_with_ignoring_case(target.filename().string(), ".cfg");
}

Result<stdfs::path> FileSystem::write_path(std::string_view raw_name) const {
  const auto name = normalise(raw_name);
  if (!name) return Error{fmt::format("{}: not a name that the game may write to", raw_name)};
  if (impl_->homeless)
    return Error{fmt::format("{}: cannot be written: there is no home folder; -userdir DIR names another", *name)};
  const stdfs::path folder = impl_->write_folder();
  auto followed = follow_links(folder, *name);
  if (!followed) return followed.error();
  if (!followed->by_link || is_within(followed->path, folder) || Impl::keeps_settings(*name, followed->path))
    return std::move(followed->path);
  return Error{fmt::format("{}: cannot be written: a link leads out of the game's folder, to {}",
                           (folder / *name).generic_string(), followed->path.generic_string())};
}

Status FileSystem::write(std::string_view name, ByteView data, Flush flush) const {
  const auto path = write_path(name);
  if (!path) return path.error();
  auto status = write_file_atomically(*path, data, flush);
  std::error_code code;
  if (status || stdfs::exists(impl_->write_folder(), code)) return status;
  return Error{status.error().message + "; -userdir DIR names another folder to write to"};
}

std::vector<std::string> FileSystem::describe() const {
  std::vector<std::string> lines;
  for (const Place& place : impl_->places) {
    if (place.packed())
      lines.push_back(fmt::format("{} ({} files)", place.label, place.entries().size()));
    else if (is_a_directory(place.directory))
      lines.push_back(place.label);
  }
  return lines;
}

const std::string& FileSystem::game() const { return impl_->game; }
const FsOptions& FileSystem::options() const { return impl_->options; }

std::vector<stdfs::path> FileSystem::folders() const {
  std::vector<stdfs::path> folders;
  if (!impl_->user_dir.empty()) folders.push_back(impl_->user_dir);
  folders.push_back(impl_->options.base_dir);
  return folders;
}

FileLoader FileSystem::loader() const {
  return [this](std::string_view name) { return read(name); };
}

}  // namespace fb::fs
