// The console's commands about cvars: list, set, toggle, cycle, inc, reset.
#include <string>

#include "base/log.h"
#include "base/number.h"
#include "console/console.h"

namespace fb::con {
namespace {

// Whether a script can contain the name as one word: config.cfg names cvars without quotes.
bool is_plain_word(std::string_view name) {
  const Args words(name);
  return words.size() == 1 && words[0] == name && command_end(name, 0) == name.size() &&
         name.find('"') == std::string_view::npos;
}

}  // namespace

void Console::add_cvar_builtins() {
  add_command("cvarlist", "cvarlist [prefix]: list the cvars; * is saved in config.cfg, - has no effect in this engine",
              [this](const Args& args) {
                std::size_t count = 0;
                for (const auto& [name, cvar] : cvars_) {
                  if (!name_starts_with(name, args[1])) continue;
                  const char* mark = !cvar->has_effect() ? "-" : cvar->archived() ? "*" : " ";
                  log_info("{} {} \"{}\"", mark, name, cvar->string());
                  ++count;
                }
                if (args.size() > 1)
                  log_info("{} cvars beginning with \"{}\"", count, args[1]);
                else
                  log_info("{} cvars", count);
              });

  add_command("set", "set <cvar> <value>: set or create a cvar",
              [this](const Args& args) { set_user_cvar(args, false); });
  add_command("seta", "seta <cvar> <value>: set or create a cvar, and save it in config.cfg",
              [this](const Args& args) { set_user_cvar(args, true); });

  add_command("toggle", "toggle <cvar>: change 0 to 1, and any other value to 0", [this](const Args& args) {
    if (args.size() != 2) {
      log_info("toggle <cvar> : toggle cvar");
    } else if (Cvar* cvar = cvar_or_sentence(args[1])) {
      set_from_console(*cvar, cvar->on() ? "0" : "1");
    }
  });
  add_command("cycle", "cycle <cvar> <value> <value> ...: set the value that follows the current one in the list",
              [this](const Args& args) {
                if (args.size() < 3) {
                  log_info("cycle <cvar> <value list>: cycle cvar through a list of values");
                } else if (Cvar* cvar = cvar_or_sentence(args[1])) {
                  std::size_t next = 2;  // a cvar that has none of the values gets the first
                  for (std::size_t i = 2; i < args.size(); ++i) {
                    const auto number = parse_number(args[i]);
                    if (!(number ? static_cast<float>(*number) == cvar->value() : same_name(args[i], cvar->string())))
                      continue;
                    next = i + 1 < args.size() ? i + 1 : 2;
                    break;
                  }
                  set_from_console(*cvar, args[next]);
                }
              });
  add_command("inc", "inc <cvar> [amount]: add an amount (1) to a cvar", [this](const Args& args) {
    if (args.size() != 2 && args.size() != 3) {
      log_info("inc <cvar> [amount] : increment cvar");
    } else if (Cvar* cvar = cvar_or_sentence(args[1])) {
      const auto amount = number_of("inc", args.size() == 3 ? args[2] : "1");
      if (!amount) return fail(amount.error().message);
      set_from_console(*cvar, number_text(cvar->value() + static_cast<float>(*amount)));
    }
  });

  add_command("reset", "reset <cvar>: set a cvar to its default", [this](const Args& args) {
    if (args.size() != 2) {
      log_info("reset <cvar> : reset cvar to default");
    } else if (Cvar* cvar = cvar_or_sentence(args[1])) {
      set_from_console(*cvar, cvar->default_string());
    }
  });
  const auto reset_those = [this](bool archived_only) {
    for (const auto& [name, cvar] : cvars_) {
      const bool rom = (cvar->spec().flags & kCvarRom) != 0;
      if (!rom && (cvar->archived() || !archived_only)) cvar->reset();
    }
  };
  add_command("resetall", "resetall: set all cvars to their defaults",
              [reset_those](const Args&) { reset_those(false); });
  add_command("resetcfg", "resetcfg: set the cvars that config.cfg saves to their defaults",
              [reset_those](const Args&) { reset_those(true); });

  const auto cvar_names = [this](std::string_view typed) {
    std::vector<std::string> names;
    for (const auto& [name, cvar] : cvars_) {
      if (name_starts_with(name, typed)) names.push_back(name);
    }
    return names;
  };
  for (const char* command : {"set", "seta", "toggle", "cycle", "inc", "reset", "cvarlist"})
    set_argument_completer(command, cvar_names);
  set_argument_completer("help", [this, cvar_names](std::string_view typed) {
    std::vector<std::string> names = cvar_names(typed);
    for (const auto& [name, command] : commands_) {
      if (name_starts_with(name, typed)) names.push_back(name);
    }
    return names;
  });
}

void Console::set_user_cvar(const Args& args, bool archive) {
  if (args.size() != 3) {
    log_info("{} <cvar> <value>", args[0]);
    return;
  }
  Cvar* cvar = find_cvar(args[1]);
  if (cvar == nullptr) {
    if (has_command(args[1])) {
      log_info("\"{}\" is a command and cannot be a cvar.", args[1]);
      return;
    }
    if (!is_plain_word(args[1])) {
      log_info("\"{}\" cannot be a cvar: its name must be one word, without quotes or semicolons", args[1]);
      return;
    }
    cvar = &add_cvar(args[1], args[2], "", kCvarUser);
  } else {
    set_from_console(*cvar, args[2]);
  }
  if (archive) cvar->set_archived();
}

}  // namespace fb::con
