#include "console/input_line.h"

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "console/console.h"

namespace fb::con {

void InputLine::set_text(std::string_view text) {
  text_.clear();
  cursor_ = 0;
  insert(text);
}

void InputLine::insert(std::string_view text) {
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ' || text_.size() >= kMaxLength) continue;
    text_.insert(text_.begin() + static_cast<std::ptrdiff_t>(cursor_++), c);
  }
}

void InputLine::erase_before() {
  if (cursor_ > 0) text_.erase(--cursor_, 1);
}

void InputLine::erase_at() {
  if (cursor_ < text_.size()) text_.erase(cursor_, 1);
}

void InputLine::erase_word_before() {
  const std::size_t end = cursor_;
  move_word(-1);
  text_.erase(cursor_, end - cursor_);
}

void InputLine::move(int characters) {
  const auto wanted = static_cast<std::ptrdiff_t>(cursor_) + characters;
  cursor_ = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, static_cast<std::ptrdiff_t>(text_.size())));
}

void InputLine::move_word(int direction) {
  if (direction < 0) {
    while (cursor_ > 0 && text_[cursor_ - 1] == ' ') --cursor_;
    while (cursor_ > 0 && text_[cursor_ - 1] != ' ') --cursor_;
  } else {
    while (cursor_ < text_.size() && text_[cursor_] != ' ') ++cursor_;
    while (cursor_ < text_.size() && text_[cursor_] == ' ') ++cursor_;
  }
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

void InputLine::set_history(std::vector<std::string> lines) {
  if (lines.size() > kMaxHistory) lines.erase(lines.begin(), lines.end() - kMaxHistory);
  history_ = std::move(lines);
  recalled_ = 0;
}

void InputLine::complete(Console& console) {
  const std::string before = text_.substr(0, cursor_), after = text_.substr(cursor_);
  const Completion completion = console.complete(before);
  if (completion.candidates.empty()) return;
  if (completion.line == before && completion.candidates.size() > 1) {
    log_info("]{}", text_);
    for (const auto& candidate : completion.candidates) {
      const Cvar* cvar = candidate.kind == NameKind::kCvar ? console.find_cvar(candidate.text) : nullptr;
      if (cvar != nullptr)
        log_info("   {} \"{}\"", candidate.text, cvar->string());
      else
        log_info("   {}", candidate.text);
    }
    return;
  }
  set_text(completion.line);
  const std::size_t place = cursor_;
  insert(after);
  cursor_ = place;
}

void InputLine::enter(Console& console) {
  log_info("]{}", text_);
  console.append(text_ + "\n");
  const bool repeats = !history_.empty() && history_.back() == text_;
  if (!text_.empty() && !repeats) history_.push_back(text_);
  if (history_.size() > kMaxHistory) history_.erase(history_.begin());
  recalled_ = 0;
  set_text("");
}

}  // namespace fb::con
