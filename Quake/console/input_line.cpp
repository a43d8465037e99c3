#include "console/input_line.h"

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "console/console.h"

namespace fb::con {
namespace {

bool separates_words(char c) { return c == ' ' || c == ';' || c == '_'; }

// Appends, but not what is there already, and keeps the newest.
void remember(std::vector<std::string>& lines, const std::string& line) {
  if (!lines.empty() && lines.back() == line) return;
  lines.push_back(line);
  if (lines.size() > InputLine::kMaxHistory) lines.erase(lines.begin());
}

}  // namespace

void InputLine::set_text(std::string_view text) {
  text_.clear();
  cursor_ = 0;
  insert(text);
}

void InputLine::insert(std::string_view text) {
  candidates_.clear();
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ' || text_.size() >= kMaxLength) continue;
    text_.insert(text_.begin() + static_cast<std::ptrdiff_t>(cursor_++), c);
  }
}

void InputLine::type(std::string_view text) {
  if (overwriting_) erase(cursor_, std::min(cursor_ + text.size(), text_.size()));
  insert(text);
}

std::size_t InputLine::paste(std::string_view text) {
  constexpr std::string_view kBreaks = "\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBreaks), text.size()));
  insert(text.substr(0, text.find_first_of(kBreaks)));
  std::size_t further = 0;
  while (true) {
    text.remove_prefix(std::min(text.find_first_of(kBreaks), text.size()));
    text.remove_prefix(std::min(text.find_first_not_of(kBreaks), text.size()));
    if (text.empty()) return further;
    ++further;
  }
}

void InputLine::erase(std::size_t from, std::size_t to) {
  candidates_.clear();
  text_.erase(from, to - from);
  cursor_ = from;
}

void InputLine::erase_before() {
  if (cursor_ > 0) erase(cursor_ - 1, cursor_);
}

void InputLine::erase_at() {
  if (cursor_ < text_.size()) erase(cursor_, cursor_ + 1);
}

void InputLine::erase_word_before() { erase(word_end(-1), cursor_); }
void InputLine::erase_word_at() { erase(cursor_, word_end(1)); }

void InputLine::move_to(std::size_t cursor) {
  candidates_.clear();
  cursor_ = cursor;
}

void InputLine::move(int characters) {
  const auto wanted = static_cast<std::ptrdiff_t>(cursor_) + characters;
  move_to(static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, static_cast<std::ptrdiff_t>(text_.size()))));
}

void InputLine::move_word(int direction) { move_to(word_end(direction)); }

std::size_t InputLine::word_end(int direction) const {
  std::size_t at = cursor_;
  if (direction < 0) {
    while (at > 0 && separates_words(text_[at - 1])) --at;
    while (at > 0 && !separates_words(text_[at - 1])) --at;
  } else {
    while (at < text_.size() && !separates_words(text_[at])) ++at;
    while (at < text_.size() && separates_words(text_[at])) ++at;
  }
  return at;
}

void InputLine::recall(int direction) {
  if (recalled_ == 0) unfinished_ = text_;
  if (direction > 0 && recalled_ < history_.size())
    ++recalled_;
  else if (direction < 0 && recalled_ > 0)
    --recalled_;
  else
    return;
  set_text(std::string(recalled_ == 0 ? unfinished_ : history_[history_.size() - recalled_]));
}

void InputLine::move_or_repeat() {
  if (cursor_ == text_.size() && !history_.empty() && cursor_ < history_.back().size())
    insert(std::string_view(history_.back()).substr(cursor_, 1));
  else
    move(1);
}

void InputLine::set_history(std::vector<std::string> lines) {
  if (lines.size() > kMaxHistory) lines.erase(lines.begin(), lines.end() - kMaxHistory);
  history_ = std::move(lines);
  entered_.clear();
  recalled_ = 0;
}

// In the place of what is between the word's start and the cursor.
void InputLine::put_candidate(std::string_view candidate) {
  const std::string after = text_.substr(cursor_);
  set_text(text_.substr(0, word_) + std::string(candidate));
  const std::size_t place = cursor_;
  insert(after);
  cursor_ = place;
}

void InputLine::complete(Console& console, int step) {
  if (!candidates_.empty()) {
    std::vector<std::string> candidates = std::move(candidates_);
    const std::size_t count = candidates.size();
    chosen_ = step > 0 ? (chosen_ + 1 < count ? chosen_ + 1 : 0) : (chosen_ > 0 ? chosen_ : count) - 1;
    put_candidate(candidates[chosen_]);
    candidates_ = std::move(candidates);
    return;
  }
  const Completion completion = console.complete(std::string_view(text_).substr(0, cursor_));
  if (completion.candidates.empty()) return;
  word_ = completion.word;
  const bool single = completion.candidates.size() == 1;
  std::vector<std::string> candidates;
  if (!single) {
    log_info("]{}", text_);
    for (const auto& candidate : completion.candidates) {
      const Cvar* cvar = candidate.kind == NameKind::kCvar ? console.find_cvar(candidate.text) : nullptr;
      if (cvar != nullptr)
        log_info("   {} \"{}\"", candidate.text, cvar->string());
      else
        log_info("   {}", candidate.text);
      candidates.push_back(candidate.text);
    }
  }
  const std::string_view common = std::string_view(completion.line).substr(word_);
  put_candidate(single && cursor_ < text_.size() && common.ends_with(' ') ? common.substr(0, common.size() - 1)
                                                                          : common);
  chosen_ = static_cast<std::size_t>(std::ranges::find(candidates, common) - candidates.begin());
  candidates_ = std::move(candidates);
}

void InputLine::enter(Console& console) {
  log_info("]{}", text_);
  console.append(text_ + "\n");
  if (!text_.empty()) {
    remember(history_, text_);
    remember(entered_, text_);
  }
  clear();
}

void InputLine::abort() {
  log_info("]{}", text_);
  clear();
}

void InputLine::clear() {
  recalled_ = 0;
  set_text("");
}

}  // namespace fb::con
