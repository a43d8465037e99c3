// fullbright: the game.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "host/base_game.h"
#include "host/dedicated.h"
#include "host/device_list.h"
#include "host/game.h"
#include "host/guarded_main.h"

namespace fb::host {
namespace {

constexpr const char* kProgram = "fullbright";

// How a game ended.
struct End {
  std::vector<std::string> next_start;  // the arguments with which the program begins anew, if it does
  bool at_once = false;                 // no destructor may run any more
};

int run_once(const std::vector<std::string>& arguments, End& end) {
  const auto options = parse_game_options(with_base_game(arguments));
  if (!options) {
    fmt::print(stderr, "fullbright: {}\n", options.error().message);
    return 2;
  }
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
    const auto status = run_dedicated(*options);
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
  end.next_start = (*game)->next_start().value_or(std::vector<std::string>());
  end.at_once = end.at_once || !(*game)->settled();
  return status;
}

int run_program(std::vector<std::string> arguments, bool& at_once) {
  End end;
  while (true) {
    end.next_start.clear();
    const int status = run_once(arguments, end);
    at_once = end.at_once;
    if (end.next_start.empty() || stop_wanted()) return status;
    arguments = std::move(end.next_start);
  }
}

}  // namespace
}  // namespace fb::host

int main(int argc, char** argv) {
  fb::stop_on_signals(fb::host::kProgram, fb::StopMode::kInSteps);
  bool at_once = false;
  const int status = fb::exit_status_or_signal(fb::host::guarded_main(fb::host::kProgram, [&] {
    return fb::host::run_program({argv + 1, argv + argc}, at_once);
  }));
  if (!at_once) return status;
  std::fflush(nullptr);
  std::_Exit(status);
}
