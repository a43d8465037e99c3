#include "console/console.h"

#include <algorithm>
#include <new>
#include <utility>
#include <iterator>

#include "base/check.h"
#include "base/log.h"
#include "base/out_of_memory.h"
#include "base/stop.h"
#include "fs/file.h"

namespace fb::con {
namespace {

// Limit on commands in one execute(), against aliases that multiply without deep nesting.
constexpr int kMaxCommands = 100000;

// The name of a text in messages.
std::string name_of(const CommandBuffer::Source& source) {
  return source.origin == CommandBuffer::Origin::kAlias ? fmt::format("Alias \"{}\"", source.name) : source.name;
}

}  // namespace

Console::Console() : scrollback_(std::make_shared<Scrollback>()) {
  log_listener_ = add_log_listener(
      [scrollback = scrollback_](LogLevel level, std::string_view text) { scrollback->add(level, text); });
  add_builtins();
  add_cvar_builtins();
}

Console::~Console() { remove_log_listener(log_listener_); }

void Console::add_command(std::string name, std::string help, Handler handler) {
  FB_CHECK(!name.empty() && handler != nullptr);
  if (find_cvar(name) != nullptr) fatal(__FILE__, __LINE__, fmt::format("{} is a cvar already", name));
  Command command{std::move(help), std::move(handler), nullptr};
  if (!commands_.emplace(name, std::move(command)).second)
    fatal(__FILE__, __LINE__, fmt::format("there is a command {} already", name));
}

void Console::remove_command(std::string_view name) {
  if (const auto found = commands_.find(name); found != commands_.end()) commands_.erase(found);
}

void Console::set_argument_completer(std::string_view command, ArgumentCompleter completer) {
  const auto found = commands_.find(command);
  FB_CHECK(found != commands_.end());
  found->second.completer = std::move(completer);
}

bool Console::has_command(std::string_view name) const { return commands_.find(name) != commands_.end(); }

Cvar& Console::add_cvar(CvarSpec spec) {
  if (has_command(spec.name)) fatal(__FILE__, __LINE__, fmt::format("{} is a command already", spec.name));
  const auto known = cvars_.find(spec.name);
  if (known == cvars_.end()) {
    auto cvar = std::make_unique<Cvar>(std::move(spec));
    Cvar& reference = *cvar;
    cvars_.emplace(reference.name(), std::move(cvar));
    return reference;
  }
  // The user, or another engine's configuration, has created the cvar before. Its object stays, because others may hold
  // a reference to it, and takes the program's specification.
  Cvar& cvar = *known->second;
  if ((cvar.spec().flags & (kCvarUser | kCvarNoEffect)) == 0)
    fatal(__FILE__, __LINE__, fmt::format("there is a cvar {} already", spec.name));
  const bool users = (cvar.spec().flags & kCvarUser) != 0;
  const std::string wanted = users || cvar.string() != cvar.default_string() ? cvar.string() : spec.default_value;
  const bool archived = users && cvar.archived();
  Cvar fresh(std::move(spec));
  cvar.spec_ = std::move(fresh.spec_);
  std::move(fresh.listeners_.begin(), fresh.listeners_.end(), std::back_inserter(cvar.listeners_));
  if (archived) cvar.set_archived();
  cvar.assign(cvar.default_string());
  if ((cvar.spec().flags & kCvarRom) == 0) set_from_console(cvar, wanted);
  return cvar;
}

Cvar& Console::add_cvar(std::string name, std::string default_value, std::string help, unsigned flags) {
  CvarSpec spec;
  spec.name = std::move(name);
  spec.default_value = std::move(default_value);
  spec.help = std::move(help);
  spec.flags = flags;
  return add_cvar(std::move(spec));
}

const Cvar* Console::find_cvar(std::string_view name) const {
  const auto found = cvars_.find(name);
  return found == cvars_.end() ? nullptr : found->second.get();
}
Cvar* Console::find_cvar(std::string_view name) {
  return const_cast<Cvar*>(static_cast<const Console*>(this)->find_cvar(name));
}
const Cvar& Console::cvar(std::string_view name) const {
  const Cvar* found = find_cvar(name);
  if (found == nullptr) fatal(__FILE__, __LINE__, fmt::format("there is no cvar {}", name));
  return *found;
}
Cvar& Console::cvar(std::string_view name) { return const_cast<Cvar&>(static_cast<const Console*>(this)->cvar(name)); }

bool Console::set(std::string_view name, std::string_view text) {
  Cvar* cvar = cvar_or_sentence(std::string(name));
  return cvar != nullptr && set_from_console(*cvar, text);
}

std::vector<const Cvar*> Console::cvars() const {
  std::vector<const Cvar*> list;
  for (const auto& [name, cvar] : cvars_) list.push_back(cvar.get());
  return list;
}

void Console::fail(std::string_view sentence) {
  log_error("{}", sentence);
  failed_ = true;
}

void Console::fail_unless(const Status& status) {
  if (!status) fail(status.error().message);
}

void Console::append(std::string_view text) {
  if (!buffer_.append(text)) log_warning("The command buffer is full; {} bytes of commands are dropped.", text.size());
}

void Console::insert(std::string_view text) {
  insert(text, {CommandBuffer::Origin::kScript, std::string(text.substr(0, text.find('\n')))});
}

bool Console::insert(std::string_view text, CommandBuffer::Source source) {
  const std::string name = name_of(source);
  switch (buffer_.insert(text, std::move(source))) {
    case CommandBuffer::Inserted::kYes:
      return true;
    case CommandBuffer::Inserted::kBufferIsFull:
      log_warning("The command buffer is full; {} is dropped.", name);
      return false;
    case CommandBuffer::Inserted::kTooDeep:
      if (const auto dropped = buffer_.drop_what_calls_itself())
        log_warning("{} runs itself without a wait: it is stopped.", name_of(*dropped));
      else
        log_warning("{} is run {} deep by others, more than may be: it is passed over.", name,
                    CommandBuffer::kMaxDepth);
      return false;
  }
  return false;
}

void Console::execute() {
  if (executing_) return;
  // Also if something throws.
  struct Executing {
    explicit Executing(bool& flag) : flag_(flag) { flag_ = true; }
    ~Executing() { flag_ = false; }
    bool& flag_;
  } executing(executing_);
  wait_ = false;
  int commands = 0;
  while (!wait_ && !stop_wanted()) {
    const auto command = buffer_.next();
    if (!command) break;
    run(Args(*command));
    if (++commands < kMaxCommands) continue;
    commands = 0;
    if (const auto dropped = buffer_.drop_what_multiplies())
      log_warning("{} commands without a wait: what {} still had to do is dropped.", kMaxCommands, name_of(*dropped));
  }
  buffer_.forget_nesting();
}

void Console::execute(std::string_view text) {
  append(text);
  append("\n");
  execute();
}

void Console::execute_line(std::string_view line) { run(Args(line)); }

bool Console::buffer_empty() const { return buffer_.empty(); }

// Names are looked up in Quake's order: commands, aliases, cvars.
void Console::run(const Args& args) {
  if (args.empty()) return;
  const std::string& name = args[0];
  if (const auto command = commands_.find(name); command != commands_.end()) {
    const Handler handler = command->second.handler;  // it may replace itself
    try {
      handler(args);
    } catch (const std::bad_alloc& failure) {
      log_error("{}: {}", name, sentence_of(failure));
    }
    return;
  }
  if (const auto alias = aliases_.find(name); alias != aliases_.end()) {
    insert(alias->second, {CommandBuffer::Origin::kAlias, alias->first});
    return;
  }
  if (Cvar* cvar = find_cvar(name)) {
    show_or_set(*cvar, args);
    return;
  }
  const bool quiet = scripts_may_name_nothing_ && executing_ && buffer_.origin() == CommandBuffer::Origin::kFile;
  log_line(quiet ? LogLevel::kDebug : LogLevel::kInfo, fmt::format("Unknown command \"{}\"", name));
}

void Console::show_or_set(Cvar& cvar, const Args& args) {
  if (args.size() < 2)
    log_info("\"{}\" is \"{}\"", cvar.name(), cvar.string());
  else
    set_from_console(cvar, args[1]);
}

bool Console::set_from_console(Cvar& cvar, std::string_view text) {
  if ((cvar.spec().flags & kCvarRom) != 0) {
    log_info("\"{}\" is read-only.", cvar.name());
    return false;
  }
  const std::string sentence = cvar.set(text);
  if (!sentence.empty()) log_info("{}", sentence);
  return sentence.empty();
}

Cvar* Console::cvar_or_sentence(const std::string& name) {
  Cvar* cvar = find_cvar(name);
  if (cvar == nullptr) log_info("There is no cvar \"{}\".", name);
  return cvar;
}

void Console::set_file_loader(FileLoader loader) { files_ = std::move(loader); }
void Console::set_command_line(std::vector<std::string> arguments) { command_line_ = std::move(arguments); }

void Console::add_config_section(std::function<std::string()> section) {
  config_sections_.push_back(std::move(section));
}

std::vector<Console::CommandInfo> Console::commands() const {
  std::vector<CommandInfo> list;
  for (const auto& [name, command] : commands_) list.push_back({name, command.help});
  return list;
}

std::string Console::config_text() const {
  std::string text;
  for (const auto& section : config_sections_) {
    text += section();
    if (!text.empty() && text.back() != '\n') text += '\n';
  }
  for (const auto& [name, cvar] : cvars_) {
    if (!cvar->archived()) continue;
    if (!cvar->has_effect() && cvar->string() == cvar->default_string()) continue;
    // A cvar that the program does not know must be restored as the user's own.
    if ((cvar->spec().flags & kCvarUser) != 0) text += "seta ";
    text += name + ' ' + in_quotes(cvar->string()) + '\n';
  }
  return text;
}

// `set` also makes what the other console does not know.
std::string Console::session_text() const {
  std::string text;
  for (const auto& [name, cvar] : cvars_) {
    const unsigned flags = cvar->spec().flags;
    const bool user_made = (flags & kCvarUser) != 0;
    if ((flags & kCvarRom) != 0 || (cvar->string() == cvar->default_string() && !user_made)) continue;
    text += (user_made && cvar->archived() ? "seta " : "set ") + name + ' ' + in_quotes(cvar->string()) + '\n';
  }
  for (const auto& [name, body] : aliases_) text += "alias " + in_quotes(name) + ' ' + in_quotes(body) + '\n';
  return text;
}

Status Console::write_config(const std::filesystem::path& path) const {
  const std::string text = config_text();
  return fs::write_text_atomically(path, text);
}

}  // namespace fb::con
