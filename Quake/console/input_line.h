// The line that is typed at the console: editing, history, completion. The host handles the keys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fb::con {

class Console;

class InputLine {
 public:
  static constexpr std::size_t kMaxLength = 1023;
  static constexpr std::size_t kMaxHistory = 64;

  const std::string& text() const { return text_; }
  std::size_t cursor() const { return cursor_; }  // 0 to text().size()
  void set_text(std::string_view text);

  void insert(std::string_view text);  // at the cursor; control characters are left out
  void type(std::string_view text);    // the same, or in the place of what is there while overwriting
  bool overwriting() const { return overwriting_; }
  void set_overwriting(bool on) { overwriting_ = on; }
  // Inserts the text's first line. Returns how many further ones, which are not empty, it has.
  std::size_t paste(std::string_view text);
  void erase_before();
  void erase_at();
  // Words end at spaces, semicolons and underscores, as in Ironwail.
  void erase_word_before();
  void erase_word_at();
  void move(int characters);
  void move_word(int direction);  // -1 or 1
  void home() { move_to(0); }
  void end() { move_to(text_.size()); }

  // Moves through the history: 1 to the line before, -1 to the line after; after the newest follows the line that was
  // being typed.
  void recall(int direction);
  // At the end, takes the next character from the history's newest line, as Quake's right arrow does; else as move(1).
  void move_or_repeat();
  // The history's lines, oldest first, to be kept between runs, and those of them that were entered in this one.
  const std::vector<std::string>& history() const { return history_; }
  const std::vector<std::string>& entered() const { return entered_; }
  void set_history(std::vector<std::string> lines);

  // Completes at the cursor as far as all candidates agree, and lists them on the console if they are several. From
  // then on, until something else is done, each call puts the next candidate there (step 1) or the one before (-1).
  void complete(Console& console, int step = 1);
  // Prints the line, passes it to the console's buffer and starts a new one.
  void enter(Console& console);
  // Prints the line and starts a new one.
  void abort();
  // Starts a new one.
  void clear();

 private:
  void move_to(std::size_t cursor);
  std::size_t word_end(int direction) const;
  void erase(std::size_t from, std::size_t to);
  void put_candidate(std::string_view candidate);

  std::string text_, unfinished_;
  std::size_t cursor_ = 0;
  bool overwriting_ = false;
  std::vector<std::string> history_, entered_;
  std::size_t recalled_ = 0;  // steps back in the history; 0: the line being typed
  // What complete() chooses from: candidates, the one that is chosen (their number: none) and where it begins.
  std::vector<std::string> candidates_;
  std::size_t chosen_ = 0, word_ = 0;
};

}  // namespace fb::con
