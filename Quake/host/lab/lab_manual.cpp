// fullbright-lab's commands that print pages of the manual.
#include <fmt/format.h>

#include <filesystem>
#include <random>
#include <system_error>

#include "base/log.h"
#include "console/manual.h"
#include "host/game/dedicated.h"
#include "host/game/game.h"
#include "host/lab/lab_stage.h"
#include "render/passes/settings.h"

namespace fb::host {
namespace {

// A folder with an empty game, which is all that registering commands needs; gone again with this.
class EmptyGame {
 public:
  EmptyGame()
      : path_(std::filesystem::temp_directory_path(failed_) /
              fmt::format("fullbright-{:08x}", std::random_device{}())) {
    if (!failed_) std::filesystem::create_directories(path_ / "id1", failed_);
  }
  ~EmptyGame() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  EmptyGame(const EmptyGame&) = delete;
  EmptyGame& operator=(const EmptyGame&) = delete;
  const std::error_code& failed() const { return failed_; }
  GameOptions options() const {
    GameOptions options;
    options.sound = false;
    options.arguments = {"-basedir", path_.string(), "-userdir", path_.string()};
    return options;
  }

 private:
  std::error_code failed_;
  std::filesystem::path path_;
};

int print_commands() {
  set_log_level(LogLevel::kError);
  const EmptyGame folder;
  if (folder.failed()) return fail(Error{fmt::format("a folder for an empty game: {}", folder.failed().message())});
  GameOptions options = folder.options();
  auto game = Game::assemble(options);
  if (!game) return fail(game.error());
  options.dedicated = true;
  options.network = {.ipv4 = false, .ipv6 = false};
  auto dedicated = assemble_dedicated(options);
  if (!dedicated) return fail(dedicated.error());
  for (const con::Console* console : {&(*game)->console(), &std::as_const((*dedicated)->console())}) {
    const auto names = con::names_without_help(*console);
    if (!names.empty()) return fail(Error{fmt::format("{} has no help text", names.front())});
  }
  fmt::print("{}", con::commands_page((*game)->console(), (*dedicated)->console()));
  return 0;
}

}  // namespace

LabCommand add_commands_command(CLI::App& app) {
  return {app.add_subcommand("commands",
                             "prints the game's commands and cvars as the manual has them (Misc/docs/commands.md)"),
          print_commands};
}

LabCommand add_settings_command(CLI::App& app) {
  return {app.add_subcommand("settings",
                             "prints the renderer's settings and debug views as the manual has them "
                             "(Misc/docs/settings.md)"),
          [] {
            fmt::print("{}", render::settings_page());
            return 0;
          }};
}

}  // namespace fb::host
