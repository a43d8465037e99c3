// Keys' commands: bind, unbind, and what a key does when it goes down and up. Keys are numbers here; their names come
// from whoever knows keyboards.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "console/console.h"

namespace fb::con {

class Bindings {
 public:
  using KeyFromName = std::function<int(std::string_view)>;  // 0: no such key
  using KeyName = std::function<std::string(int)>;

  // Registers bind, unbind, unbindall and bindlist, and the section of config.cfg; lives as long as the console.
  Bindings(Console& console, KeyFromName key_from_name, KeyName key_name);
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

  void bind(int key, std::string command);  // an empty command unbinds
  const std::string& command(int key) const;

  // Appends what the key is bound to. A command "+name" is a button: it gets "+name <key>" when the key goes down and
  // "-name <key>" when it comes up, so that two keys of one button are told apart. Repeats are not for here.
  void key_event(int key, bool down);
  // Lets go of every button that is down: the console opened, or the window lost the keyboard.
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
