#include "console/history_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "console/args.h"
#include "console/input_line.h"
#include "fs/file.h"
#include "fs/obstacle.h"

namespace fb::con {
namespace {

void keep_newest(std::vector<std::string>& lines) {
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  if (lines.size() > InputLine::kMaxHistory) lines.erase(lines.begin(), lines.end() - InputLine::kMaxHistory);
}

}  // namespace

bool may_hold_password(std::string_view line) { return name_contains(line, "password"); }

Result<std::vector<std::string>> read_history(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  const fs::PathFacts facts = fs::look_at(path);
  if (facts.standing == fs::Standing::kAbsent) return lines;
  if (facts.standing != fs::Standing::kFile) return Error{fmt::format("{}: {}", path.string(), facts.cause)};
  const auto data = fs::read_whole_file(path);
  if (!data) return data.error();
  constexpr std::size_t kMost = InputLine::kMaxHistory * (InputLine::kMaxLength + 2);  // bytes that may matter
  std::string_view text = data->text();
  const bool cut = text.size() > kMost;
  if (cut) text.remove_prefix(text.size() - kMost);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (end > 0) lines.emplace_back(text.substr(0, std::min(end, InputLine::kMaxLength)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (cut && lines.size() > 1) lines.erase(lines.begin());  // may be the end of a line
  keep_newest(lines);
  return lines;
}

Status add_to_history(const std::filesystem::path& path, std::span<const std::string> entered) {
  auto lines = read_history(path);
  if (!lines) return lines.error();
  const std::size_t before = lines->size();
  std::ranges::copy_if(entered, std::back_inserter(*lines),
                       [](const std::string& line) { return !may_hold_password(line); });
  if (lines->size() == before) return ok_status();
  keep_newest(*lines);
  std::string text;
  for (const std::string& line : *lines) text += line + '\n';
  return fs::write_text_atomically(path, text);
}

}  // namespace fb::con
