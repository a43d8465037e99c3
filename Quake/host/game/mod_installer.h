// installmod: a mod's archive is unpacked into the player's folder on a thread of its own, while the game goes on. Also
// which archives wait in the folder `archives` of the player's folder, for the menu.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/background_work.h"
#include "base/result.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "fs/mod_install.h"
#include "ui/menu/facts.h"

namespace fb::host {

class ModInstaller {
 public:
  // Registers installmod. Both must outlive this object, and the console must not execute it afterwards.
  ModInstaller(con::Console& console, const fs::FileSystem& files);
  ~ModInstaller();  // gives up what is under way
  ModInstaller(const ModInstaller&) = delete;
  ModInstaller& operator=(const ModInstaller&) = delete;

  // Once a frame: says how it ended.
  void poll();
  bool busy() const { return job_ != nullptr; }
  // For the menu: what goes on, what ended last, and the archives by name, 64 at most, those that changed read anew.
  ui::menu::InstallState state() const;
  std::vector<ui::menu::ArchiveEntry> archives();
  // Changes with each percent and at the end.
  std::uint64_t revision() const;

 private:
  struct Job {
    std::unique_ptr<fs::ModArchive> archive;
    fs::Existing existing;
    std::atomic<std::uint64_t> done{0};  // bytes
    std::atomic<bool> given_up{false};
    std::optional<Result<std::filesystem::path>> result;
    std::unique_ptr<BackgroundWork> work;  // the last: the others outlive it
  };
  struct Known {  // of an archive's file of this size and time
    std::uint64_t size = 0;
    std::filesystem::file_time_type time;
    std::string failure;
    fs::ModPlan plan;  // without its files
    std::size_t files = 0;
  };

  Status begin(const con::Args& args);
  void end_with(std::string installed, std::string failure);
  void list();
  Status may_install(const fs::ModPlan& plan, fs::Existing existing) const;
  const Known& know(const std::filesystem::path& path);
  std::vector<std::filesystem::path> find_archives() const;
  int percent() const;

  con::Console& console_;
  const fs::FileSystem& files_;
  fs::ModPlace place_;
  std::filesystem::path folder_;  // of archives
  std::map<std::filesystem::path, Known> known_;
  std::unique_ptr<Job> job_;
  std::string installed_, failure_;  // of the last one
  std::uint64_t ended_ = 0;          // how many
};

}  // namespace fb::host
