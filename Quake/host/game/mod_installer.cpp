#include "host/game/mod_installer.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/log.h"
#include "base/out_of_memory.h"
#include "fs/options.h"
#include "fs/path.h"
#include "host/game/server_list.h"

namespace fb::host {
namespace {

namespace stdfs = std::filesystem;

constexpr std::string_view kZipEnding = ".zip";
constexpr std::size_t kMostListed = 64;
constexpr const char* kInstallUsage =
    "installmod [archive [replace]]: unpack a mod's .zip, by its name in the folder archives or by its path, into the "
    "player's folder; \"cancel\" ends that, no name lists the archives";

fs::ModPlace place_of(const fs::FileSystem& files) {
  std::vector<stdfs::path> folders = files.folders();
  fs::ModPlace place;
  if (!folders.empty()) place.folder = folders.front();
  for (stdfs::path& folder : folders) place.others.push_back(std::move(folder));
  return place;
}

stdfs::path typed_path(const std::string& typed, const stdfs::path& archives) {
  if (typed.starts_with("~/")) return fs::home_directory() / typed.substr(2);
  if (typed.find('/') != typed.npos) return typed;
  return archives / (fs::ends_with_ignoring_case(typed, kZipEnding) ? typed : typed + std::string(kZipEnding));
}

}  // namespace

ModInstaller::ModInstaller(con::Console& console, const fs::FileSystem& files)
    : console_(console), files_(files), place_(place_of(files)), folder_(place_.folder / "archives") {
  console.add_command("installmod", kInstallUsage, [this](const con::Args& args) {
    const Status status = begin(args);
    if (status) return;
    if (!job_) end_with({}, status.error().message);
    console_.fail(status.error().message);
  });
  console.set_argument_completer("installmod", [this](std::string_view) {
    std::vector<std::string> names;
    for (const stdfs::path& path : find_archives()) names.push_back(path.filename().string());
    return names;
  });
}

ModInstaller::~ModInstaller() {
  if (!job_) return;
  job_->given_up = true;
  log_warning("{}: it is not installed, since the program ends", job_->archive->name());
}

std::vector<stdfs::path> ModInstaller::find_archives() const {
  std::vector<stdfs::path> found;
  std::error_code code;
  for (stdfs::directory_iterator it(folder_, code), end; !code && it != end; it.increment(code)) {
    std::error_code unreadable;
    const std::string name = it->path().filename().string();
    // What the console could not be told by its name is left out.
    if (!fs::ends_with_ignoring_case(name, kZipEnding) || plain_text(name) != name || name.find('"') != name.npos)
      continue;
    if (it->is_regular_file(unreadable)) found.push_back(it->path());
  }
  std::ranges::sort(found);
  if (found.size() > kMostListed) found.resize(kMostListed);
  return found;
}

Status ModInstaller::may_install(const fs::ModPlan& plan, fs::Existing existing) const {
  const std::vector<std::string>& games = files_.options().games;
  if (std::ranges::any_of(games, [&](const std::string& game) { return fs::lower_case(game) == plan.folder; }))
    return Error{fmt::format("{} is played: \"game id1\" leaves it, then it can be installed", plan.folder)};
  return fs::may_install(plan, place_, existing);
}

Status ModInstaller::begin(const con::Args& args) {
  if (args.size() < 2) return list(), ok_status();
  if (args.size() == 2 && args[1] == "cancel") {
    if (job_) job_->given_up = true;
    return ok_status();
  }
  if (args.size() > 3 || (args.size() == 3 && args[2] != "replace")) return Error{kInstallUsage};
  if (job_) return Error{fmt::format("installmod: {} is being installed", job_->archive->name())};
  const fs::Existing existing = args.size() == 3 ? fs::Existing::kReplace : fs::Existing::kRefuse;
  auto archive = within_memory([&] { return fs::ModArchive::open(typed_path(args[1], folder_)); });
  if (!archive) return Error{fmt::format("installmod: {}", archive.error().message)};
  const fs::ModPlan& plan = (*archive)->plan();
  if (auto status = may_install(plan, existing); !status) {
    const bool would = existing == fs::Existing::kRefuse && may_install(plan, fs::Existing::kReplace);
    return Error{fmt::format("installmod: {}{}", status.error().message,
                             would ? " (installmod NAME replace; saves and settings stay)" : "")};
  }
  if (!plan.left_out.empty()) log_warning("{}", plan.left_out);
  log_info("Installing {}: {} files, {}.", plan.folder, plan.files.size(), memory_text(plan.bytes));
  installed_.clear();
  failure_.clear();
  job_ = std::make_unique<Job>();
  job_->archive = *std::move(archive);
  job_->existing = existing;
  job_->work = std::make_unique<BackgroundWork>(1, [job = job_.get(), place = place_](std::size_t) {
    job->result = within_memory([&] {
      return fs::install_mod(*job->archive, place, job->existing, [job](std::uint64_t bytes) {
        job->done = bytes;
        return !job->given_up;
      });
    });
  });
  return ok_status();
}

void ModInstaller::poll() {
  if (!job_ || !job_->work->wait_for(std::chrono::milliseconds(0))) return;
  const std::unique_ptr<Job> job = std::move(job_);
  if (!*job->result) {
    end_with({}, fmt::format("installmod: {}", job->result->error().message));
    return console_.fail(failure_);
  }
  end_with((*job->result)->filename().string(), {});
  log_info("{} is installed: \"game {}\" plays it.", installed_, installed_);
}

void ModInstaller::end_with(std::string installed, std::string failure) {
  ++ended_;
  installed_ = std::move(installed);
  failure_ = std::move(failure);
}

void ModInstaller::list() {
  if (job_) log_info("{} is being installed: {} %", job_->archive->name(), percent());
  const auto entries = archives();
  for (const ui::menu::ArchiveEntry& entry : entries)
    log_info("   {}: {}", entry.name, entry.failure.empty() ? entry.facts : entry.failure);
  log_info("{} archives in {}", entries.size(), folder_.generic_string());
}

const ModInstaller::Known& ModInstaller::know(const stdfs::path& path) {
  std::error_code code;
  const std::uint64_t size = stdfs::file_size(path, code);
  const stdfs::file_time_type time = stdfs::last_write_time(path, code);
  Known& known = known_[path];
  if (known.size == size && known.time == time && (known.files > 0 || !known.failure.empty())) return known;
  known = {size, time, {}, {}, 0};
  const auto archive = within_memory([&] { return fs::ModArchive::open(path); });
  if (!archive) {
    known.failure = archive.error().message;
    return known;
  }
  known.plan = (*archive)->plan();
  known.files = std::exchange(known.plan.files, {}).size();
  return known;
}

std::vector<ui::menu::ArchiveEntry> ModInstaller::archives() {
  std::vector<ui::menu::ArchiveEntry> entries;
  for (const stdfs::path& path : find_archives()) {
    const Known& known = know(path);
    ui::menu::ArchiveEntry entry{path.filename().string(), known.plan.folder, memory_text(known.size)};
    entry.failure = known.failure;
    if (entry.failure.empty()) {
      entry.facts = fmt::format("{} files, {} unpacked", known.files, memory_text(known.plan.bytes));
      entry.replaces = fs::holds_game_data(fs::installed_mod(place_.folder, known.plan.folder));
      if (auto status = may_install(known.plan, fs::Existing::kReplace); !status)
        entry.failure = status.error().message;
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

int ModInstaller::percent() const {
  const std::uint64_t all = job_->archive->plan().bytes;
  return all == 0 ? 0 : static_cast<int>(job_->done * 100 / all);
}

ui::menu::InstallState ModInstaller::state() const {
  ui::menu::InstallState state;
  state.folder = folder_.generic_string();
  state.installed = installed_;
  state.failure = failure_;
  if (!job_) return state;
  state.going_on = job_->archive->plan().folder;
  state.percent = percent();
  return state;
}

std::uint64_t ModInstaller::revision() const {
  return 1000 * ended_ + (job_ ? 1 + static_cast<std::uint64_t>(percent()) : 0);
}

}  // namespace fb::host
