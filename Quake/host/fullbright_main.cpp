// fullbright: the game.
#include <fmt/format.h>

#include <cstdio>
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

// `next_start`: the arguments with which the program begins anew, if it does.
int run_once(const std::vector<std::string>& arguments, std::vector<std::string>& next_start) {
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
  if (!(*game)->next_start()) return status;
  next_start = *(*game)->next_start();
  return status;
}

int run_program(std::vector<std::string> arguments) {
  while (true) {
    std::vector<std::string> next_start;
    const int status = run_once(arguments, next_start);
    if (next_start.empty() || stop_wanted()) return status;
    arguments = std::move(next_start);
  }
}

}  // namespace
}  // namespace fb::host

int main(int argc, char** argv) {
  fb::stop_on_signals(fb::host::kProgram, fb::StopMode::kInSteps);
  return fb::exit_status_or_signal(fb::host::guarded_main(fb::host::kProgram, [&] {
    return fb::host::run_program({argv + 1, argv + argc});
  }));
}
