// Completion of the typed line: of the last command's name, or of its last argument.
#include <algorithm>

#include "console/console.h"

namespace fb::con {
namespace {

std::size_t common_length(const std::string& a, const std::string& b) {
  std::size_t length = 0;
  while (length < std::min(a.size(), b.size()) && same_name(a.substr(length, 1), b.substr(length, 1))) ++length;
  return length;
}

// The start of a command's last word, at its quote if it has one that is not closed.
std::size_t last_word(std::string_view command) {
  if (std::ranges::count(command, '"') % 2 == 1) return command.rfind('"');
  const std::size_t space = command.find_last_of(" \t");
  return space == command.npos ? 0 : space + 1;
}

}  // namespace

Completion Console::complete(std::string_view line) const {
  // The start of the last command, then that of the last word.
  std::size_t command_start = 0;
  while (true) {
    const std::size_t end = command_end(line, command_start);
    if (end == line.size()) break;
    command_start = end + 1;
  }
  while (command_start < line.size() && line[command_start] == ' ') ++command_start;
  const std::string_view command = line.substr(command_start);
  const std::size_t word_start = command_start + last_word(command);
  std::string_view typed = line.substr(word_start);

  Completion result;
  result.line = std::string(line);
  result.word = word_start;
  if (word_start == command_start) {
    if (typed.empty()) return result;
    const auto add = [&](const auto& names, NameKind kind) {
      for (auto it = names.lower_bound(typed); it != names.end() && name_starts_with(it->first, typed); ++it)
        result.candidates.push_back({it->first, kind});
    };
    add(commands_, NameKind::kCommand);
    add(cvars_, NameKind::kCvar);
    add(aliases_, NameKind::kAlias);
  } else {
    const Args args(command);
    const auto found = commands_.find(args[0]);
    if (found == commands_.end() || !found->second.completer) return result;
    const bool quoted = typed.starts_with('"');
    if (quoted) typed.remove_prefix(1);
    for (std::string& text : found->second.completer(typed)) {
      if (!name_starts_with(text, typed)) continue;
      const bool one_word = !quoted && text.find_first_of(" ;") == text.npos;
      result.candidates.push_back({one_word ? std::move(text) : in_quotes(text), NameKind::kArgument});
    }
  }
  if (result.candidates.empty()) return result;
  std::sort(result.candidates.begin(), result.candidates.end(),
            [](const auto& a, const auto& b) { return NameLess()(a.text, b.text); });

  const std::string& first = result.candidates.front().text;
  std::size_t length = first.size();
  for (const auto& candidate : result.candidates) length = std::min(length, common_length(first, candidate.text));
  if (length >= typed.size()) result.line = std::string(line.substr(0, word_start)) + first.substr(0, length);
  if (result.candidates.size() == 1) result.line += ' ';
  return result;
}

}  // namespace fb::con
