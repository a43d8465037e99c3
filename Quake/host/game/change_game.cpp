#include "host/game/change_game.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "base/log.h"
#include "fs/path.h"

namespace fb::host {
namespace {

bool is_game_folder(const fs::FileSystem& files, const std::string& name) {
  if (name.find_first_of("/\\:") != name.npos || name == "." || name == "..") return false;
  const fs::FsOptions& options = files.options();
  const auto user = options.user_dir ? *options.user_dir : fs::default_user_dir();
  std::error_code code;
  return std::filesystem::is_directory(options.base_dir / name, code) ||
         (!user.empty() && std::filesystem::is_directory(user / name, code));
}

std::string without_blanks(std::string commands) {
  return commands.find_first_not_of(" \t\r\n;") == commands.npos ? std::string() : commands;
}

}  // namespace

void register_game(con::Console& console, const fs::FileSystem& files, const GameOptions& options,
                   std::function<void(NextStart)> begin_anew) {
  const auto change = [&console, &files, arguments = options.arguments,
                       begin_anew = std::move(begin_anew)](const con::Args& args) {
    if (args.size() < 2) return log_info("\"game\" is \"{}\"", files.game());
    const std::string& folder = args[1];
    // Configurations may say `game`, too, and are read again.
    if (fs::lower_case(folder) == fs::lower_case(files.game()))
      return log_info("\"game\" is \"{}\" already", files.game());
    if (!is_game_folder(files, folder))
      return console.fail(fmt::format("game {}: there is no such game folder", folder));
    NextStart next{with_game(arguments, folder),
                   {console.session_text(), without_blanks(console.remaining_commands())}};
    console.forget_commands();
    begin_anew(std::move(next));
  };
  console.add_command("game", "game [folder]: show the game folder, or play another: the program starts anew with it",
                      change);
}

}  // namespace fb::host
