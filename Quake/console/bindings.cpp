#include "console/bindings.h"

#include <set>
#include <utility>

#include "base/log.h"

namespace fb::con {

Bindings::Bindings(Console& console, KeyFromName key_from_name, KeyName key_name)
    : console_(console), key_from_name_(std::move(key_from_name)), key_name_(std::move(key_name)) {
  console_.add_command("bind", "bind <key> [command]: show or set the command that a key runs",
                       [this](const Args& args) {
                         if (args.size() < 2) {
                           log_info("bind <key> [command] : attach a command to a key");
                           return;
                         }
                         const int key = key_from_name_(args[1]);
                         if (key == 0)
                           log_info("\"{}\" isn't a valid key", args[1]);
                         else if (args.size() > 2)
                           bind(key, args.joined(2));
                         else if (command(key).empty())
                           log_info("\"{}\" is not bound", args[1]);
                         else
                           log_info("\"{}\" = \"{}\"", args[1], command(key));
                       });
  console_.add_command("unbind", "unbind <key>: remove a key's command", [this](const Args& args) {
    if (args.size() != 2)
      log_info("unbind <key> : remove commands from a key");
    else if (const int key = key_from_name_(args[1]); key == 0)
      log_info("\"{}\" isn't a valid key", args[1]);
    else
      bind(key, "");
  });
  console_.add_command("unbindall", "unbindall: remove the commands of all keys",
                       [this](const Args&) { commands_.clear(); });
  console_.add_command("bindlist", "bindlist: list the keys and their commands", [this](const Args&) {
    for (const auto& [key, text] : commands_) log_info("   {} \"{}\"", key_name_(key), text);
    log_info("{} bindings", commands_.size());
  });
  console_.add_config_section([this] { return config_text(); });
}

void Bindings::bind(int key, std::string command) {
  if (command.empty())
    commands_.erase(key);
  else
    commands_[key] = std::move(command);
}

const std::string& Bindings::command(int key) const {
  static const std::string none;
  const auto found = commands_.find(key);
  return found == commands_.end() ? none : found->second;
}

std::vector<int> Bindings::keys_of(std::string_view command) const {
  std::vector<int> keys;
  for (const auto& [key, text] : commands_) {
    if (same_name(text, command)) keys.push_back(key);
  }
  return keys;
}

std::vector<std::string> Bindings::bound_commands() const {
  std::set<std::string> commands;
  for (const auto& [key, text] : commands_) commands.insert(text);
  return {commands.begin(), commands.end()};
}

void Bindings::key_event(int key, bool down) {
  if (!down) {
    // Release the button that this key pressed, even if the key is bound to something else by now.
    if (const auto held = down_.find(key); held != down_.end()) {
      console_.append(fmt::format("-{} {}\n", held->second.substr(1), key));
      down_.erase(held);
    }
    return;
  }
  const std::string& text = command(key);
  if (text.empty()) return;
  if (text.front() == '+') {
    console_.append(fmt::format("{} {}\n", text, key));
    down_[key] = text;
  } else {
    console_.append(text + "\n");
  }
}

void Bindings::release_all() {
  while (!down_.empty()) key_event(down_.begin()->first, false);
}

std::string Bindings::config_text() const {
  std::string text = "unbindall\n";
  for (const auto& [key, command] : commands_) {
    const std::string name = key_name_(key);
    if (!name.empty()) text += fmt::format("bind {} {}\n", in_quotes(name), in_quotes(command));
  }
  return text;
}

}  // namespace fb::con
