// The console: commands, cvars, aliases and the buffer of commands that wait. No drawing (ui/console_view.h) and no
// keys. What it says goes to the log, and everybody's log lines come into its scrollback.
//
//   con::Console console;
//   con::Cvar& fov = console.add_cvar({"fov", "90", "width of the view, degrees", con::kCvarArchive, 10, 170});
//   console.add_command("playdemo", "playdemo <name>: play a recorded demo", [&](const con::Args& args) { ... });
//   console.append("exec quake.rc\n");
//   each frame: console.set_time(now); console.execute();
//
// One thread uses a Console; its scrollback alone may be written by several.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_data.h"
#include "base/result.h"
#include "console/args.h"
#include "console/command_buffer.h"
#include "console/cvar.h"
#include "console/localization.h"
#include "console/scrollback.h"

namespace fb::con {

// A command may throw std::bad_alloc if it runs out of memory: the console prints a message and continues with the next
// command.
using Handler = std::function<void(const Args&)>;
// Completion candidates of a command's argument, given its typed start.
using ArgumentCompleter = std::function<std::vector<std::string>(std::string_view typed)>;

enum class NameKind { kCommand, kCvar, kAlias, kArgument };

struct Completion {
  struct Candidate {
    std::string text;
    NameKind kind = NameKind::kCommand;
  };
  std::vector<Candidate> candidates;  // by name
  std::string line;                   // the typed line, completed as far as all candidates agree
  std::size_t word = 0;               // where the completed word begins in it
};

class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  // Commands. Using a name of another command or cvar twice is a fault of the program.
  void add_command(std::string name, std::string help, Handler handler);
  // For owners that may be destroyed before the console.
  void remove_command(std::string_view name);
  void set_argument_completer(std::string_view command, ArgumentCompleter completer);
  bool has_command(std::string_view name) const;
  bool has_alias(std::string_view name) const { return aliases_.contains(std::string(name)); }
  struct CommandInfo {
    std::string name, help;
  };
  std::vector<CommandInfo> commands() const;  // by name

  // Cvars. If the user has already `set` one of this name, or one without effect exists, its value is kept if it is
  // allowed.
  Cvar& add_cvar(CvarSpec spec);
  Cvar& add_cvar(std::string name, std::string default_value, std::string help, unsigned flags = kCvarPlain);
  Cvar* find_cvar(std::string_view name);
  const Cvar* find_cvar(std::string_view name) const;
  // The cvar must exist.
  Cvar& cvar(std::string_view name);
  const Cvar& cvar(std::string_view name) const;
  // Sets a cvar as the console does (with clamping and messages; read-only cvars do not change). Returns false if there
  // is no such cvar or the text was not accepted.
  bool set(std::string_view name, std::string_view text);
  std::vector<const Cvar*> cvars() const;  // by name

  // The buffer of commands. append: at the end; insert: at the front.
  void append(std::string_view text);
  void insert(std::string_view text);
  // Executes the buffer until it is empty, a `wait` delays the rest to the next call, or the program is told to end
  // (base/stop.h). A call from inside a command returns at once, and the outer call executes what was added.
  void execute();
  // append + newline, then execute().
  void execute(std::string_view text);
  // Executes one command at once, without the buffer.
  void execute_line(std::string_view line);
  bool buffer_empty() const;
  // Drops all commands in the buffer, because the program ends.
  void forget_commands() { buffer_.clear(); }
  // The commands in the buffer, for another console that goes on with them.
  std::string remaining_commands() const { return buffer_.rest(); }
  // The last execute() ended at a `wait`.
  bool waiting() const { return wait_; }

  // For commands that failed: logs the sentence as an error, and failed() returns true from then on. Programs without a
  // window then end with exit status 1.
  void fail(std::string_view sentence);
  void fail_unless(const Status& status);
  bool failed() const { return failed_; }

  // The source of `exec`'s scripts; without one `exec` finds none.
  void set_file_loader(FileLoader loader);
  // Commands that follow a script's own whenever it is run.
  void follow_script(const std::string& script, std::string commands) { followers_[script] = std::move(commands); }
  // Whether a script may contain unknown commands without a message; for a server, whose configuration is mostly a
  // player's.
  void set_scripts_may_name_nothing(bool may) { scripts_may_name_nothing_ = may; }
  // The program's arguments, without its name, for `stuffcmds`.
  void set_command_line(std::vector<std::string> arguments);

  // Completes the last word of the typed line: from names (first word) or by the command's own completer.
  Completion complete(std::string_view line) const;

  // What messages say in the player's language; empty until somebody reads files into it (host/game/language.h).
  Localization& localization() { return localization_; }
  const Localization& localization() const { return localization_; }

  Scrollback& scrollback() { return *scrollback_; }
  const Scrollback& scrollback() const { return *scrollback_; }
  void set_time(double seconds) { scrollback_->set_time(seconds); }

  // Text of config.cfg: first the sections (such as bindings), then every archived cvar. A section is text of complete
  // lines.
  void add_config_section(std::function<std::string()> section);
  std::string config_text() const;
  // A script by which another console gets this one's aliases, and all cvars that are not at their defaults.
  std::string session_text() const;
  // Replaces the file completely, or leaves it unchanged.
  Status write_config(const std::filesystem::path& path) const;

 private:
  struct Command {
    std::string help;
    Handler handler;
    ArgumentCompleter completer;
  };

  void add_builtins();       // builtins.cpp
  void add_cvar_builtins();  // cvar_builtins.cpp
  void run(const Args& args);
  void exec(const std::string& name);
  // Both return false, after a message, if the text is not accepted.
  bool insert(std::string_view text, CommandBuffer::Source source);
  bool insert_once(std::string_view text, CommandBuffer::Source source);  // not if it is already running
  void show_or_set(Cvar& cvar, const Args& args);
  // Logs a message if there is no such cvar.
  Cvar* cvar_or_sentence(const std::string& name);
  // As set(), for a cvar that was found.
  bool set_from_console(Cvar& cvar, std::string_view text);
  void set_user_cvar(const Args& args, bool archive);
  void list_names(std::string_view part, bool in_help_too) const;

  std::map<std::string, Command, NameLess> commands_;
  std::map<std::string, std::unique_ptr<Cvar>, NameLess> cvars_;
  std::map<std::string, std::string, NameLess> aliases_;
  CommandBuffer buffer_;
  std::map<std::string, std::string> followers_;  // by the script's name
  bool executing_ = false, wait_ = false, scripts_may_name_nothing_ = false, failed_ = false;
  FileLoader files_;
  std::vector<std::string> command_line_;
  std::vector<std::function<std::string()>> config_sections_;
  Localization localization_;
  std::shared_ptr<Scrollback> scrollback_;
  int log_listener_ = 0;
};

}  // namespace fb::con
