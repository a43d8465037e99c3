// The buffer of commands to be executed, in Quake's order: appended text comes last; text that a running command
// inserts (an alias's body, a script) comes next. Commands are separated by newlines and, outside quotes, by
// semicolons.
//
// Inserted text has a name, and refers to the text that contained the command which inserted it. So a text that calls
// itself endlessly can be told from the texts around it, and dropped alone.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fb::con {

class CommandBuffer {
 public:
  static constexpr std::size_t kMaxBytes = 8u << 20u;
  // Depth of inserted texts that insert further texts without a wait in between.
  static constexpr int kMaxDepth = 128;

  // kFile: the text of a script; kScript: any other inserted text.
  enum class Origin { kAppended, kFile, kScript, kAlias };
  enum class Inserted { kYes, kBufferIsFull, kTooDeep };
  struct Source {
    Origin origin = Origin::kAppended;
    std::string name;
  };

  // Returns false if the buffer is full, and takes nothing then. Text without a newline at its end continues in the
  // next appended text, as in Quake.
  bool append(std::string_view text);
  // Inserts before everything, as a line of its own. If it returns a reason (see drop_what_calls_itself()), it took
  // nothing.
  Inserted insert(std::string_view text, Source source);
  // Removes the next command and returns it; nullopt if there is none.
  std::optional<std::string> next();

  // About the last command that next() returned. Where it came from:
  Origin origin() const { return origin_; }
  // The names of the texts that contain it, from the text called `name` (in any case) inwards; empty if none of them
  // has that name.
  std::vector<std::string> names_from(Origin origin, std::string_view name) const;
  // Drops the rest of a text, and of all texts inserted by it, and returns that text; nullopt if there is nothing to
  // drop. Of texts that call themselves it is the outermost one; of texts that only multiply, the outermost alias, else
  // the outermost script that a script called.
  std::optional<Source> drop_what_calls_itself();
  std::optional<Source> drop_what_multiplies();

  // After `wait`, nesting starts again from zero: an alias that waits may call itself for ever.
  void forget_nesting();
  void clear();
  // What next() would return from now on, as a text that means the same.
  std::string rest() const;
  bool empty() const { return bytes_ == 0; }

 private:
  struct Text {
    Source source;
    std::shared_ptr<const Text> outer;  // null: the command was appended, or followed a wait
    int depth = 1;
  };
  struct Chunk {
    std::string text;
    std::size_t position = 0;
    Origin origin = Origin::kAppended;
    std::shared_ptr<const Text> in;  // null if it was appended, or followed a wait
  };
  // From the outermost text inwards.
  std::vector<const Text*> nesting() const;
  Source drop(const Text& text);

  std::deque<Chunk> chunks_;
  std::size_t bytes_ = 0;
  Origin origin_ = Origin::kAppended;
  std::shared_ptr<const Text> in_;
};

// The console commands of a command line, one per line: the arguments from one that begins with '+' to the next that
// begins with '+' or '-'. A '-' before a digit or a point is a number, not an option. Arguments that contain white
// space or a semicolon are quoted, as the user had quoted them for the shell.
std::string commands_of_arguments(const std::vector<std::string>& arguments);

}  // namespace fb::con
