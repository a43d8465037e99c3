#include "console/manual.h"

#include <fmt/format.h>

#include <algorithm>

namespace fb::con {
namespace {

// As it stands in a table's cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

void write_command(std::string& page, const Console::CommandInfo& command) {
  // "map <name>: start ..." is how a command is used, then what it does.
  const std::size_t colon = command.help.find(": ");
  const bool has_usage = colon != std::string::npos && name_starts_with(command.help, command.name);
  std::string use = has_usage ? command.help.substr(0, colon) : command.name;
  std::ranges::replace(use, '|', '/');  // even in code it would end the cell
  page += fmt::format("| `{}` | {} |\n", use, cell(has_usage ? command.help.substr(colon + 2) : command.help));
}

std::string default_of(const Cvar& cvar) {
  if ((cvar.spec().flags & kCvarRom) != 0) return "";  // another on every machine
  return cvar.default_string().empty() ? "(empty)" : cell(cvar.default_string());
}

void write_cvar(std::string& page, const Cvar& cvar) {
  const char* kept = cvar.archived() ? "kept" : (cvar.spec().flags & kCvarRom) != 0 ? "read-only" : "";
  page += fmt::format("| `{}` | {} | {} | {} | {} |\n", cvar.name(), default_of(cvar), cell(cvar.range_text()), kept,
                      cell(cvar.spec().help));
}

constexpr std::string_view kCommandTable = "| command | what it does |\n| --- | --- |\n";
constexpr std::string_view kCvarTable =
    "| cvar | default | range | | what it does |\n| --- | --- | --- | --- | --- |\n";

}  // namespace

std::string commands_page(const Console& game, const Console& dedicated) {
  std::string page =
      "# Commands and cvars\n\n"
      "Written by `make settings-page` from what the game registers; a test holds them equal. In the console `help "
      "NAME`\n"
      "says the same, and `apropos WORD` finds names. \"kept\" is saved in config.cfg. More on the renderer's settings "
      "and\nits debug views: [settings.md](settings.md).\n\n## Commands\n\n";
  page += kCommandTable;
  for (const auto& command : game.commands()) write_command(page, command);
  page += "\n## Cvars\n\nAny text is allowed where no range is given.\n\n";
  page += kCvarTable;
  for (const Cvar* cvar : game.cvars())
    if (cvar->has_effect()) write_cvar(page, *cvar);
  std::string commands, cvars;
  for (const auto& command : dedicated.commands())
    if (!game.has_command(command.name)) write_command(commands, command);
  for (const Cvar* cvar : dedicated.cvars()) {
    const Cvar* same = game.find_cvar(cvar->name());
    if (cvar->has_effect() && !(same && same->has_effect())) write_cvar(cvars, *cvar);
  }
  if (!commands.empty() || !cvars.empty()) page += "\n## On a dedicated server alone\n";
  if (!commands.empty()) page += fmt::format("\n{}{}", kCommandTable, commands);
  if (!cvars.empty()) page += fmt::format("\n{}{}", kCvarTable, cvars);
  page +=
      "\n## Without effect\n\nCvars of QuakeSpasm and other engines, so that their configurations and mods find "
      "them. Kept in\nconfig.cfg where they are not at their default.\n\n| cvar | default | what it is there, and why "
      "not here |\n| --- | --- | --- |\n";
  for (const Cvar* cvar : game.cvars()) {
    if (cvar->has_effect()) continue;
    page += fmt::format("| `{}` | {} | {} |\n", cvar->name(), default_of(*cvar), cell(cvar->spec().help));
  }
  return page;
}

std::vector<std::string> names_without_help(const Console& console) {
  std::vector<std::string> names;
  for (const auto& command : console.commands())
    if (command.help.empty()) names.push_back(command.name);
  for (const Cvar* cvar : console.cvars())
    if (cvar->spec().help.empty()) names.push_back(cvar->name());
  return names;
}

}  // namespace fb::con
