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
  void erase_before();
  void erase_at();
  void erase_word_before();
  void move(int characters);
  void move_word(int direction);  // -1 or 1
  void home() { cursor_ = 0; }
  void end() { cursor_ = text_.size(); }

  // Moves through the history: 1 to the line before, -1 to the line after; after the newest follows the line that was
  // being typed.
  void recall(int direction);
  // The history's lines, oldest first, to be kept between runs.
  const std::vector<std::string>& history() const { return history_; }
  void set_history(std::vector<std::string> lines);

  // Completes at the cursor; if that adds nothing, lists the candidates on the console.
  void complete(Console& console);
  // Prints the line, passes it to the console's buffer and starts a new one.
  void enter(Console& console);

 private:
  std::string text_, unfinished_;
  std::size_t cursor_ = 0;
  std::vector<std::string> history_;
  std::size_t recalled_ = 0;  // steps back in the history; 0: the line being typed
};

}  // namespace fb::con
