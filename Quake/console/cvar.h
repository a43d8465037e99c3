// Cvars: named settings. Reading one is a load. Setting one checks its range and notifies listeners.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fb::con {

enum CvarFlags : unsigned {
  kCvarPlain = 0,
  kCvarArchive = 1,  // goes into config.cfg
  kCvarRom = 2,      // the console shows it and does not set it
  kCvarUser = 4,     // made by `set` at the console, not by the program
  // A cvar of another engine, without effect here. If archived, it is written to config.cfg only if it is not at its
  // default, so that a configuration shared between engines loses nothing, and Fullbright's own has no foreign cvars.
  kCvarNoEffect = 8,
};

class Cvar;

struct CvarSpec {
  std::string name;
  std::string default_value;
  std::string help;
  unsigned flags = kCvarPlain;
  // If either is given (or `integer`), the value must be a number: any other text leaves the cvar unchanged, and a
  // number outside the range is clamped, each with a message.
  std::optional<float> min = std::nullopt, max = std::nullopt;
  bool integer = false;  // rounded to the nearest
  std::function<void(const Cvar&)> on_change = nullptr;
  // For cvars where 0 has a special meaning: a smaller number above 0 is raised to this one.
  std::optional<float> least_above_zero = std::nullopt;
  // Words that stand for numbers of the range; the cvar holds the number.
  std::vector<std::pair<std::string, float>> words = {};
  std::string group = {};  // under which menus list it; empty: by its name
};

// Lives as long as its Console and does not move: keep a reference and read it every frame.
class Cvar {
 public:
  explicit Cvar(CvarSpec spec);
  Cvar(const Cvar&) = delete;
  Cvar& operator=(const Cvar&) = delete;

  const std::string& name() const { return spec_.name; }
  const std::string& string() const { return string_; }
  float value() const { return value_; }    // the string as read by C's atof: 0 if it is not a number
  int integer() const { return integer_; }  // the value truncated, and clamped to int's range
  bool on() const { return value_ != 0.0f; }
  const std::string& default_string() const { return spec_.default_value; }
  const CvarSpec& spec() const { return spec_; }
  bool has_range() const { return spec_.min || spec_.max || spec_.integer; }
  bool archived() const { return (spec_.flags & kCvarArchive) != 0; }
  bool has_effect() const { return (spec_.flags & kCvarNoEffect) == 0; }
  // "1 to 4096", "at least 0", "any whole number"; empty if any text is allowed.
  std::string range_text() const;

  // Sets the value, and calls on_change and the listeners if it changed. Returns a message for the user if the text was
  // not accepted as it is, else "". Does not check `kCvarRom`, which the console does.
  std::string set(std::string_view text);
  std::string set(float value);
  std::string reset() { return set(default_string()); }
  // Called after each change, with the cvar's new value.
  void add_listener(std::function<void(const Cvar&)> listener) { listeners_.push_back(std::move(listener)); }
  void set_archived() { spec_.flags |= kCvarArchive; }

 private:
  friend class Console;
  void assign(std::string text);
  void notify();

  CvarSpec spec_;
  std::string string_;
  float value_ = 0.0f;
  int integer_ = 0;
  std::vector<std::function<void(const Cvar&)>> listeners_;
};

// The shortest text that reads back as this number: "1", "0.1", "-2.5".
std::string number_text(float value);

}  // namespace fb::con
