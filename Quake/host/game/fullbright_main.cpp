// fullbright: the game.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "base/system.h"
#include "fs/options.h"
#include "host/base_game.h"
#include "host/game/change_game.h"
#include "host/game/dedicated.h"
#include "host/device_list.h"
#include "host/game/game.h"
#include "host/guarded_main.h"
#include "host/game/terminal.h"

namespace fb::host {
namespace {

constexpr const char* kProgram = "fullbright";

// How a game ended.
struct End {
  std::optional<NextStart> next_start;  // if the program begins anew
  bool at_once = false;                 // no destructor may run any more
};

int run_once(const NextStart& start, TerminalLines& terminal, End& end) {
  auto options = parse_game_options(with_base_game(start.arguments));
  const auto asks = [](const GameOptions& o) { return o.help || o.version || o.list_devices; };
  if (options && !asks(*options) && !options->headless && !options->dedicated)
    options = parse_game_options(
        with_base_game(with_store_game(start.arguments, fs::find_store_games(fs::home_directory()), ".")));
  if (!options) {
    fmt::print(stderr, "fullbright: {}\n", options.error().message);
    return 2;
  }
  options->carried = start.carried;
  options->has_commands |= !start.carried.commands.empty();
  if (options->help) {
    fmt::print("{}", game_help());
    return 0;
  }
  if (options->version) {
    fmt::print("{}\n", version_text());
    return 0;
  }
  if (options->list_devices) return print_devices(options->device);
  if (options->dedicated) {
    const auto status = run_dedicated(*options, terminal, end.next_start);
    if (!status) fmt::print(stderr, "fullbright: {}\n", status.error().message);
    return status ? *status : 1;
  }
  if (!options->headless) stop_on_signals(kProgram, StopMode::kAsQuit);
  auto game = Game::create(*options);
  if (!game) {
    fmt::print(stderr, "fullbright: {}\n", game.error().message);
    return 1;
  }
  const int status = (*game)->run();
  end.next_start = (*game)->next_start();
  end.at_once = end.at_once || !(*game)->settled();
  return status;
}

// What fails in one of several starts is not forgotten.
int run_program(std::vector<std::string> arguments, bool& at_once) {
  NextStart start{std::move(arguments), {}};
  TerminalLines terminal;  // it may have read more than one start was given
  End end;
  int worst = 0;
  while (true) {
    end.next_start.reset();
    const int status = run_once(start, terminal, end);
    if (status != 0) worst = status;
    at_once = end.at_once;
    if (!end.next_start || stop_wanted()) return worst;
    start = std::move(*end.next_start);
  }
}

}  // namespace
}  // namespace fb::host

int main(int argc, char** argv) {
  fb::stop_on_signals(fb::host::kProgram, fb::StopMode::kInSteps);
  bool at_once = false;
  const int status = fb::exit_status_or_signal(fb::host::guarded_main(fb::host::kProgram, [&] {
    std::vector<std::string> arguments = fb::program_arguments(argc, argv);
    if (!arguments.empty()) arguments.erase(arguments.begin());
    return fb::host::run_program(std::move(arguments), at_once);
  }));
  if (!at_once) return status;
  std::fflush(nullptr);
  std::_Exit(status);
}
