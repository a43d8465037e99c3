// Text that waits to be executed, with Quake's order: what is appended comes last, what a running command inserts (an
// alias's body, a script's text) comes next. Text goes by lines and, outside quotes, semicolons.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fb::con {

class CommandBuffer {
 public:
  static constexpr std::size_t kMaxBytes = 8u << 20u;
  // Inserted text that inserts text that inserts text ... without a wait between.
  static constexpr int kMaxDepth = 128;

  // kFile: a script's own text; kScript: what else is inserted.
  enum class Origin { kAppended, kFile, kScript, kAlias };

  // Both return false, and take nothing, when the buffer is full.
  // Text without a newline at its end goes on in what is appended next, as in Quake.
  bool append(std::string_view text);
  // Before everything, as a line of its own. False, too, where inserting has nested too deep: see drop().
  bool insert(std::string_view text, Origin origin);
  // Takes the next command off; nullopt when there is none.
  std::optional<std::string> next();
  // Where the command came from that next() gave last.
  Origin origin() const { return origin_; }
  // After `wait`, nesting starts anew: an alias that waits may call itself for ever.
  void forget_depth();
  // Against what runs away: drops what aliases inserted (kAlias), or all that was inserted (kScript). What was appended
  // stays.
  void drop(Origin origin);
  void clear();
  bool empty() const { return bytes_ == 0; }

 private:
  struct Chunk {
    std::string text;
    std::size_t position = 0;
    int depth = 0;
    Origin origin = Origin::kAppended;
  };
  std::deque<Chunk> chunks_;
  std::size_t bytes_ = 0;
  int depth_ = 0;  // of the command that next() gave last
  Origin origin_ = Origin::kAppended;
};

// The commands of a command line, each in a line of its own: what stands between an argument that begins with '+' and
// the next that begins with '+' or '-'. A '-' before a digit or a point is a number and no option. Arguments that hold
// white space or a semicolon are quoted, as the shell's user quoted them.
std::string commands_of_arguments(const std::vector<std::string>& arguments);

}  // namespace fb::con
