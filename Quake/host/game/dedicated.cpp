#include "host/game/dedicated.h"

#include <fmt/format.h>

#include <utility>

#include "base/log.h"
#include "base/log_budget.h"
#include "base/stop.h"
#include "platform/clock.h"

namespace fb::host {
namespace {

void register_commands(con::Console& console) {
  console.add_cvar(
      {"sys_ticrate", "0.05", "length of a dedicated server's tick, seconds", con::kCvarPlain, 0.001f, 0.1f});
  // A player's configuration may name these; a server ignores them.
  for (const char* name : {"bind", "unbind", "unbindall", "startdemos", "vid_restart"})
    console.add_command(name, fmt::format("{}: no effect: a dedicated server has no keys, window or demos", name),
                        [](const con::Args&) {});
}

}  // namespace

Result<std::unique_ptr<Engine>> assemble_dedicated(const GameOptions& options) {
  EngineOptions wanted = engine_options(options);
  wanted.client = false;
  wanted.dedicated = true;
  wanted.autosaves = false;
  auto made = Engine::create(options.arguments, wanted);
  if (made) register_commands((*made)->console());
  return made;
}

Result<int> run_dedicated(const GameOptions& options, TerminalLines& terminal, std::optional<NextStart>& next) {
  const LogBudget budget;
  auto made = assemble_dedicated(options);
  if (!made) return made.error();
  Engine& engine = **made;
  con::Console& console = engine.console();

  bool quit = false;
  console.add_command("quit", "quit: end the program", [&](const con::Args&) {
    quit = true;
    console.forget_commands();
  });
  register_game(console, engine.files(), options, [&](NextStart wanted) {
    next = std::move(wanted);
    quit = true;
  });
  console.set_scripts_may_name_nothing(true);
  engine.queue_configuration(options);

  FrameTimer timer;
  double last = platform::now_seconds();
  while (!quit && !stop_wanted()) {
    while (const auto line = terminal.next()) console.append(*line + "\n");
    engine.execute_commands(platform::now_seconds());
    if (quit) break;
    TimeSettings settings = read_time_settings(console);
    settings.max_fps = FrameTimer::kFastestInStep;  // each frame is a tick, of sys_ticrate
    const double now = platform::now_seconds();
    engine.frame(timer.plan(now - last, settings), vec2(0.0f), now);
    last = now;
    const double next_tick = now + static_cast<double>(console.cvar("sys_ticrate").value());
    if (console.buffer_empty() || console.waiting()) platform::sleep_seconds(next_tick - platform::now_seconds());
  }
  engine.server().shutdown();
  return engine.went_wrong() ? 1 : 0;
}

}  // namespace fb::host
