#include "host/game/mod_check.h"

#include <fmt/format.h>

#include "base/log.h"
#include "csqc/hud_context.h"
#include "progs/builtins/builtins.h"
#include "progs/mod_check.h"
#include "ui/atlas.h"

namespace fb::host {
namespace {

constexpr const char *kServerProgram = "progs.dat", *kBarProgram = "csprogs.dat";

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void check(const FileData& bytes, const char* name, const progs::ModHost& host) {
  const auto program = progs::load_program(bytes, name);
  if (!program) return log_info("{}: it cannot be run here", program.error().message);
  for (const std::string& warning : program->warnings) log_info("{}", warning);
  const auto sentences = progs::missing_here(*program, host);
  for (const std::string& sentence : sentences) log_info("{}.", sentence);
  const progs::ModNeeds needs = progs::needs_of(*program);
  const std::string asked =
      fmt::format("it uses {}, and asks for {} and {}", counted(needs.builtins.size(), "builtin", "builtins"),
                  counted(needs.extensions.size(), "extension", "extensions"),
                  counted(needs.cvars_read.size() + needs.cvars_set.size(), "cvar", "cvars"));
  if (sentences.empty())
    log_info("{}: nothing is missing here; {}.", name, asked);
  else
    log_info("{}: {} missing here; {}.", name,
             sentences.size() == 1 ? "one thing is" : fmt::format("{} things are", sentences.size()), asked);
}

void check_mod(con::Console& console, const fs::FileSystem& files, sv::Server& server) {
  progs::ModHost host{server.builtins(),
                      [&console](std::string_view name) { return console.find_cvar(name) != nullptr; },
                      progs::server_functions(), progs::server_functions_of_other_engines()};
  if (const auto bytes = files.read(kServerProgram))
    check(*bytes, kServerProgram, host);
  else
    log_info("The game has no progs.dat.");

  const auto bytes = files.read(kBarProgram);
  if (!bytes) return;
  ui::Atlas no_pictures;
  csqc::HudContext context(console, no_pictures);
  progs::BuiltinTable table = progs::standard_builtins({});
  csqc::add_hud_builtins(table, context);
  check(*bytes, kBarProgram, {table, host.has_cvar, {"CSQC_DrawHud"}, progs::client_functions_of_other_engines()});
}

}  // namespace

void register_modcheck(con::Console& console, const fs::FileSystem& files, sv::Server& server) {
  console.add_command("modcheck", "modcheck: say what the mod's progs.dat and csprogs.dat ask for that is missing here",
                      [&](const con::Args&) { check_mod(console, files, server); });
}

}  // namespace fb::host
