// A line of the console, cut into words as Quake cuts it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fb::con {

// Words end at white space; "quoted words" may hold it (there is no escape for the quote itself, and one that never
// closes reaches to the end); `//` before a word makes the rest a comment, `/* */` one up to its end. Each of { } ( ) '
// is a word of its own, also in the middle of one (QuakeSpasm's rule: a colon is too, but only where a word begins).
class Args {
 public:
  Args() = default;
  explicit Args(std::string_view line);

  std::size_t size() const { return words_.size(); }
  bool empty() const { return words_.empty(); }
  // Word 0 is the command. Past the end: "".
  const std::string& operator[](std::size_t i) const { return i < words_.size() ? words_[i] : nothing(); }
  // What follows the command as it was written, quotes and all (Quake's Cmd_Args): for say, cmd and the like.
  const std::string& rest() const { return rest_; }
  // The words from i on, with a space between.
  std::string joined(std::size_t i) const;
  // As C's atof has it: the number that the word begins with, else 0.
  float number(std::size_t i) const;
  int integer(std::size_t i) const;

 private:
  static const std::string& nothing();

  std::vector<std::string> words_;
  std::string rest_;
};

// Where the command that starts at `start` ends: at its newline, at a semicolon outside quotes and comments, or at the
// text's end. The character there, if any, belongs to no command.
std::size_t command_end(std::string_view text, std::size_t start);

// The text as one quoted word. Quake has no escape for a quote or a newline inside one: they become ' and a space.
std::string in_quotes(std::string_view text);

// Names of commands and cvars are compared without regard to case.
struct NameLess {
  using is_transparent = void;
  bool operator()(std::string_view a, std::string_view b) const;
};
bool same_name(std::string_view a, std::string_view b);
bool name_starts_with(std::string_view name, std::string_view prefix);
bool name_contains(std::string_view name, std::string_view part);

}  // namespace fb::con
