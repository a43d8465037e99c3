// Splits a console line into words by Quake's rules.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fb::con {

// Words end at white space. A "quoted word" may contain white space; a quote cannot be escaped, and a quote that is not
// closed extends to the end. `//` at the start of a word makes the rest a comment, `/* */` the text up to its end. Each
// of { } ( ) ' is a word of its own, even inside another; a colon only at the start of a word (QuakeSpasm's rule).
class Args {
 public:
  Args() = default;
  explicit Args(std::string_view line);

  std::size_t size() const { return words_.size(); }
  bool empty() const { return words_.empty(); }
  // Word 0 is the command. Past the end: "".
  const std::string& operator[](std::size_t i) const { return i < words_.size() ? words_[i] : nothing(); }
  // The text after the command as it was written, with its quotes (Quake's Cmd_Args), for say, cmd and the like.
  const std::string& rest() const { return rest_; }
  // The words from i on, with a space between.
  std::string joined(std::size_t i) const;
  // Read as by C's atof: the number at the word's start, else 0.
  float number(std::size_t i) const;
  int integer(std::size_t i) const;

 private:
  static const std::string& nothing();

  std::vector<std::string> words_;
  std::string rest_;
};

// The end of the command that starts at `start`: at its newline, at a semicolon outside quotes and comments, or at the
// text's end. The character at the end, if any, belongs to no command.
std::size_t command_end(std::string_view text, std::size_t start);

// The text as one quoted word. A quote or a newline cannot be escaped inside one; they become ' and a space.
std::string in_quotes(std::string_view text);

// Names of commands and cvars are compared ignoring case.
struct NameLess {
  using is_transparent = void;
  bool operator()(std::string_view a, std::string_view b) const;
};
bool same_name(std::string_view a, std::string_view b);
bool name_starts_with(std::string_view name, std::string_view prefix);
bool name_contains(std::string_view name, std::string_view part);

}  // namespace fb::con
