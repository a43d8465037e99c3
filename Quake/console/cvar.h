// Cvars: named settings. Reading one is a load; setting one checks it against its range and tells who wants to know.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fb::con {

enum CvarFlags : unsigned {
  kCvarPlain = 0,
  kCvarArchive = 1,  // goes into config.cfg
  kCvarRom = 2,      // the console shows it and does not set it
  kCvarUser = 4,     // made by `set` at the console, not by the program
  // Another engine's: nothing listens to it. Archived, it is in config.cfg only where it is not at its default, so that
  // a configuration that engines share loses nothing and one's own holds no strangers.
  kCvarNoEffect = 8,
};

class Cvar;

struct CvarSpec {
  std::string name;
  std::string default_value;
  std::string help;
  unsigned flags = kCvarPlain;
  // Where either is given (or `integer`), the value must be a number: anything else leaves the cvar as it was, in one
  // sentence, and a number outside is brought to the nearest one inside, in one sentence.
  std::optional<float> min = std::nullopt, max = std::nullopt;
  bool integer = false;  // rounded to the nearest
  std::function<void(const Cvar&)> on_change = nullptr;
  // Where 0 means something else than a very small number does: numbers between the two are brought to this one.
  std::optional<float> least_above_zero = std::nullopt;
};

// Lives as long as its Console and stays where it is: keep a reference and read it every frame.
class Cvar {
 public:
  explicit Cvar(CvarSpec spec);
  Cvar(const Cvar&) = delete;
  Cvar& operator=(const Cvar&) = delete;

  const std::string& name() const { return spec_.name; }
  const std::string& string() const { return string_; }
  float value() const { return value_; }    // C's atof of the string: 0 where it is no number
  int integer() const { return integer_; }  // the value cut to a whole number, inside int's range
  bool on() const { return value_ != 0.0f; }
  const std::string& default_string() const { return spec_.default_value; }
  const CvarSpec& spec() const { return spec_; }
  bool has_range() const { return spec_.min || spec_.max || spec_.integer; }
  bool archived() const { return (spec_.flags & kCvarArchive) != 0; }
  bool has_effect() const { return (spec_.flags & kCvarNoEffect) == 0; }
  // "1 to 4096", "at least 0", "any whole number"; empty where anything goes.
  std::string range_text() const;

  // Sets it and calls on_change and the listeners if that changed it. Returns a sentence for the user where the text
  // was not taken as it is, else "". `kCvarRom` is the console's business, not this function's.
  std::string set(std::string_view text);
  std::string set(float value);
  std::string reset() { return set(default_string()); }
  // Called after each change, with the cvar as it is then.
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
