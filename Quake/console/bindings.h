// Key bindings: bind, unbind, and the commands that run when a key goes down and up. Keys are numbers here; the caller
// supplies their names.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "console/console.h"

namespace fb::con {

class Bindings {
 public:
  using KeyFromName = std::function<int(std::string_view)>;  // 0: no such key
  using KeyName = std::function<std::string(int)>;

  // Registers bind, unbind, unbindall and bindlist, and the section of config.cfg. Must live as long as the console.
  Bindings(Console& console, KeyFromName key_from_name, KeyName key_name);
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

  void bind(int key, std::string command);  // an empty command unbinds
  const std::string& command(int key) const;
  // The keys of a command, by their number, and all commands that have a key, each once.
  std::vector<int> keys_of(std::string_view command) const;
  std::vector<std::string> bound_commands() const;

  // Appends the key's command to the buffer. A command "+name" is a button: it gets "+name <key>" when the key goes
  // down and "-name <key>" when it comes up, so that two keys for one button can be told apart. Do not pass key
  // repeats.
  void key_event(int key, bool down);
  // Releases every button that is down: when the console opens, or the window loses the keyboard.
  void release_all();

 private:
  std::string config_text() const;

  Console& console_;
  KeyFromName key_from_name_;
  KeyName key_name_;
  std::map<int, std::string> commands_;
  std::map<int, std::string> down_;  // buttons, by the key that holds them
};

}  // namespace fb::con
