// fullbright: the game.
#include <fmt/format.h>

#include <cstdio>

#include "host/base_game.h"
#include "host/dedicated.h"
#include "host/device_list.h"
#include "host/game.h"

int main(int argc, char** argv) {
  using namespace fb;
  const auto options = host::parse_game_options(host::with_base_game({argv + 1, argv + argc}));
  if (!options) {
    fmt::print(stderr, "fullbright: {}\n", options.error().message);
    return 2;
  }
  if (options->help) {
    fmt::print("{}", host::game_help());
    return 0;
  }
  if (options->version) {
    fmt::print("{}\n", host::version_text());
    return 0;
  }
  if (options->list_devices) return host::print_devices(options->device);
  if (options->dedicated) {
    const auto status = host::run_dedicated(*options);
    if (!status) fmt::print(stderr, "fullbright: {}\n", status.error().message);
    return status ? *status : 1;
  }
  auto game = host::Game::create(*options);
  if (!game) {
    fmt::print(stderr, "fullbright: {}\n", game.error().message);
    return 1;
  }
  return (*game)->run();
}
