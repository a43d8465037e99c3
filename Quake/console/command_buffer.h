// Text that waits to be executed, with Quake's order: what is appended comes last, what a running command inserts (an
// alias's body, a script's text) comes next. Text goes by lines and, outside quotes, semicolons.
//
// Inserted text has a name, and knows in which text the command stood that inserted it. So what calls itself without
// end can be told from what only stands around it, and is dropped alone.
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
  // Inserted text that inserts text that inserts text ... without a wait between.
  static constexpr int kMaxDepth = 128;

  // kFile: a script's own text; kScript: what else is inserted.
  enum class Origin { kAppended, kFile, kScript, kAlias };
  enum class Inserted { kYes, kBufferIsFull, kTooDeep };
  struct Source {
    Origin origin = Origin::kAppended;
    std::string name;
  };

  // False where the buffer is full; then nothing is taken.
  // Text without a newline at its end goes on in what is appended next, as in Quake.
  bool append(std::string_view text);
  // Before everything, as a line of its own. Takes nothing where it says why not: see drop_what_calls_itself().
  Inserted insert(std::string_view text, Source source);
  // Takes the next command off; nullopt when there is none.
  std::optional<std::string> next();

  // About the command that next() gave last. Where it came from:
  Origin origin() const { return origin_; }
  // The names of the texts that it stands in, from the text of that name (in any case) inwards; empty where it stands
  // in none of that name.
  std::vector<std::string> names_from(Origin origin, std::string_view name) const;
  // Drops what a text still had to do, and what came of it. Gives that text; nullopt, having dropped nothing, where
  // there is none. Of what calls itself the outermost; of what only multiplies the outermost alias, else what the
  // outermost script called.
  std::optional<Source> drop_what_calls_itself();
  std::optional<Source> drop_what_multiplies();

  // After `wait`, nesting starts anew: an alias that waits may call itself for ever.
  void forget_nesting();
  void clear();
  bool empty() const { return bytes_ == 0; }

 private:
  struct Text {
    Source source;
    std::shared_ptr<const Text> outer;  // null: of a command that was appended, or waited
    int depth = 1;
  };
  struct Chunk {
    std::string text;
    std::size_t position = 0;
    Origin origin = Origin::kAppended;
    std::shared_ptr<const Text> in;  // null where it was appended, or waited
  };
  // From the outermost inwards.
  std::vector<const Text*> nesting() const;
  Source drop(const Text& text);

  std::deque<Chunk> chunks_;
  std::size_t bytes_ = 0;
  Origin origin_ = Origin::kAppended;
  std::shared_ptr<const Text> in_;
};

// The commands of a command line, each in a line of its own: what stands between an argument that begins with '+' and
// the next that begins with '+' or '-'. A '-' before a digit or a point is a number and no option. Arguments that hold
// white space or a semicolon are quoted, as the shell's user quoted them.
std::string commands_of_arguments(const std::vector<std::string>& arguments);

}  // namespace fb::con
