// The console's own commands, except those about cvars (cvar_builtins.cpp).
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "base/text_mark.h"
#include "console/console.h"

namespace fb::con {
namespace {

constexpr std::size_t kMaxAliasName = 31;  // QuakeSpasm's

}  // namespace

void Console::add_builtins() {
  add_command("wait", "wait: delay the commands that follow to the next frame", [this](const Args&) { wait_ = true; });
  add_command("echo", "echo <text>: print a text", [](const Args& args) { log_info("{}", args.joined(1)); });
  add_command("clear", "clear: clear the console", [this](const Args&) { scrollback_->clear(); });

  add_command("exec", "exec <file>: run a script of console commands", [this](const Args& args) {
    if (args.size() == 2)
      exec(args[1]);
    else
      log_info("exec <filename> : execute a script file");
  });
  add_command("stuffcmds", "stuffcmds: run the command line's console commands (such as +map start)",
              [this](const Args&) {
                const std::string commands = commands_of_arguments(command_line_);
                if (!commands.empty()) insert_once(commands, {CommandBuffer::Origin::kScript, "The command line"});
              });

  add_command("alias", "alias [name [commands]]: list aliases, show one, or name a list of commands",
              [this](const Args& args) {
                if (args.size() == 1) {
                  for (const auto& [name, body] : aliases_) log_info("   {}: {}", name, body);
                  log_info("{} alias commands", aliases_.size());
                } else if (args.size() == 2) {
                  const auto found = aliases_.find(args[1]);
                  if (found == aliases_.end())
                    log_info("There is no alias \"{}\".", args[1]);
                  else
                    log_info("   {}: {}", found->first, found->second);
                } else if (args[1].size() > kMaxAliasName) {
                  log_info("Alias \"{}\": the name is longer than {} characters.", args[1], kMaxAliasName);
                } else {
                  aliases_[args[1]] = args.joined(2);
                }
              });
  add_command("unalias", "unalias <name>: delete an alias", [this](const Args& args) {
    const auto found = aliases_.find(args[1]);
    if (args.size() != 2)
      log_info("unalias <name> : delete alias");
    else if (found == aliases_.end())
      log_info("There is no alias \"{}\".", args[1]);
    else
      aliases_.erase(found);
  });
  add_command("unaliasall", "unaliasall: delete all aliases", [this](const Args&) { aliases_.clear(); });

  add_command("cmdlist", "cmdlist [prefix]: list the commands", [this](const Args& args) {
    std::size_t count = 0;
    for (const auto& [name, command] : commands_) {
      if (!name_starts_with(name, args[1])) continue;
      log_info("   {}", name);
      ++count;
    }
    if (args.size() > 1)
      log_info("{} commands beginning with \"{}\"", count, args[1]);
    else
      log_info("{} commands", count);
  });

  const auto apropos = [this](const Args& args) {
    if (args.size() == 2)
      list_names(args[1], true);
    else
      log_info("{} <text> : search the names and help of commands and cvars", args[0]);
  };
  add_command("apropos", "apropos <text>: search the names and help of commands and cvars", apropos);
  add_command("find", "find <text>: the same as apropos", apropos);

  add_command("help", "help <name>: explain a command or cvar", [this](const Args& args) {
    if (args.size() == 1 && has_command("menu_help")) {  // as QuakeSpasm's key F1
      insert("menu_help\n");
    } else if (args.size() != 2) {
      log_info("help <name> : explain a command or cvar; cmdlist, cvarlist and apropos <text> find names");
    } else if (const auto command = commands_.find(args[1]); command != commands_.end()) {
      log_info("{}", command->second.help);
    } else if (const auto alias = aliases_.find(args[1]); alias != aliases_.end()) {
      log_info("{} is an alias: {}", alias->first, alias->second);
    } else if (const Cvar* cvar = find_cvar(args[1])) {
      const std::string range = cvar->range_text();
      log_info("{}: {}", cvar->name(), cvar->spec().help.empty() ? "(set at the console)" : cvar->spec().help);
      const char* kept = !cvar->archived()    ? ""
                         : cvar->has_effect() ? ", kept in config.cfg"
                                              : ", kept in config.cfg where it is not at its default";
      log_info("   is \"{}\", default \"{}\"{}{}{}", cvar->string(), cvar->default_string(),
               range.empty() ? "" : ", " + range, kept, (cvar->spec().flags & kCvarRom) != 0 ? ", read-only" : "");
    } else {
      log_info("There is no command, alias or cvar \"{}\".", args[1]);
    }
  });
}

void Console::exec(const std::string& name) {
  std::string found = name;
  std::optional<FileData> script;
  if (files_) {
    script = files_(found);
    if (!script) script = files_(found = name + ".cfg");
  }
  if (!script) {
    // A missing script is an error only on the command line. Scripts may name others that do not exist, as quake.rc
    // does.
    if (executing_ && buffer_.origin() == CommandBuffer::Origin::kScript)
      return fail(fmt::format("couldn't exec {}", name));
    log_info("couldn't exec {}", name);
    return;
  }
  if (script->size() > CommandBuffer::kMaxBytes)
    return log_warning("exec {}: a script of {} bytes; at most {} are taken", name, script->size(),
                       CommandBuffer::kMaxBytes);
  // Old editors end a file with a zero or ^Z, and new ones begin it with a byte order mark.
  std::string text(without_byte_order_mark(script->text()));
  std::replace(text.begin(), text.end(), '\0', ' ');
  if (const auto follower = followers_.find(found); follower != followers_.end())
    text += "\n" + follower->second + "\n";
  if (insert_once(text, {CommandBuffer::Origin::kFile, found})) log_info("execing {}", name);
}

// A text that executes itself would do so for ever, since nothing between the two executions can stop it, except a
// changed alias.
bool Console::insert_once(std::string_view text, CommandBuffer::Source source) {
  const std::vector<std::string> names = buffer_.names_from(source.origin, source.name);
  if (names.empty()) return insert(text, std::move(source));
  log_warning("{} runs itself without a wait ({}, {}): that line is passed over.", source.name, fmt::join(names, ", "),
              source.name);
  return false;
}

void Console::list_names(std::string_view part, bool in_help_too) const {
  std::size_t count = 0;
  const auto matches = [&](const std::string& name, const std::string& help) {
    return name_contains(name, part) || (in_help_too && name_contains(help, part));
  };
  for (const auto& [name, command] : commands_) {
    if (!matches(name, command.help)) continue;
    log_info("   {}", command.help.empty() ? name : command.help);
    ++count;
  }
  for (const auto& [name, cvar] : cvars_) {
    if (!matches(name, cvar->spec().help)) continue;
    log_info("   {} \"{}\": {}", name, cvar->string(), cvar->spec().help);
    ++count;
  }
  log_info("{} commands and cvars with \"{}\" in their name or help", count, part);
}

}  // namespace fb::con
