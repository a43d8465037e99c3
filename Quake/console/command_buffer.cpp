#include "console/command_buffer.h"

#include <algorithm>
#include <utility>

#include "console/args.h"

namespace fb::con {

bool CommandBuffer::append(std::string_view text) {
  if (bytes_ + text.size() > kMaxBytes) return false;
  if (text.empty()) return true;
  if (chunks_.empty() || chunks_.back().origin != Origin::kAppended) chunks_.emplace_back();
  chunks_.back().text += text;
  bytes_ += text.size();
  return true;
}

CommandBuffer::Inserted CommandBuffer::insert(std::string_view text, Source source) {
  if (in_ && in_->depth >= kMaxDepth) return Inserted::kTooDeep;
  if (bytes_ + text.size() + 1 > kMaxBytes) return Inserted::kBufferIsFull;
  Chunk chunk;
  chunk.text = std::string(text) + '\n';
  chunk.origin = source.origin;
  chunk.in = std::make_shared<const Text>(Text{std::move(source), in_, in_ ? in_->depth + 1 : 1});
  bytes_ += chunk.text.size();
  chunks_.push_front(std::move(chunk));
  return Inserted::kYes;
}

std::optional<std::string> CommandBuffer::next() {
  if (chunks_.empty()) return std::nullopt;
  Chunk& chunk = chunks_.front();
  const std::size_t end = command_end(chunk.text, chunk.position);
  std::string command = chunk.text.substr(chunk.position, end - chunk.position);
  const std::size_t after = std::min(end + 1, chunk.text.size());
  bytes_ -= after - chunk.position;
  chunk.position = after;
  in_ = chunk.in;
  origin_ = chunk.origin;
  if (chunk.position == chunk.text.size()) chunks_.pop_front();
  return command;
}

std::vector<const CommandBuffer::Text*> CommandBuffer::nesting() const {
  std::vector<const Text*> texts;
  for (const Text* text = in_.get(); text != nullptr; text = text->outer.get()) texts.push_back(text);
  std::reverse(texts.begin(), texts.end());
  return texts;
}

std::vector<std::string> CommandBuffer::names_from(Origin origin, std::string_view name) const {
  std::vector<std::string> names;
  for (const Text* text : nesting()) {
    if (!names.empty() || (text->source.origin == origin && same_name(text->source.name, name)))
      names.push_back(text->source.name);
  }
  return names;
}

std::optional<CommandBuffer::Source> CommandBuffer::drop_what_calls_itself() {
  const std::vector<const Text*> texts = nesting();
  for (auto text = texts.begin(); text != texts.end(); ++text) {
    const auto is_same = [&](const Text* other) {
      return other->source.origin == (*text)->source.origin && same_name(other->source.name, (*text)->source.name);
    };
    if (std::any_of(text + 1, texts.end(), is_same)) return drop(**text);
  }
  return std::nullopt;
}

std::optional<CommandBuffer::Source> CommandBuffer::drop_what_multiplies() {
  const std::vector<const Text*> texts = nesting();
  const auto is_alias = [](const Text* text) { return text->source.origin == Origin::kAlias; };
  if (const auto alias = std::find_if(texts.begin(), texts.end(), is_alias); alias != texts.end()) return drop(**alias);
  // One script alone is limited by its file's size.
  return texts.size() > 1 ? std::optional(drop(*texts[1])) : std::nullopt;
}

CommandBuffer::Source CommandBuffer::drop(const Text& dropped) {
  const Source source = dropped.source;
  const auto is_of_it = [&](const Chunk& chunk) {
    for (const Text* text = chunk.in.get(); text != nullptr; text = text->outer.get()) {
      if (text == &dropped) return true;
    }
    return false;
  };
  for (const Chunk& chunk : chunks_) {
    if (is_of_it(chunk)) bytes_ -= chunk.text.size() - chunk.position;
  }
  chunks_.erase(std::remove_if(chunks_.begin(), chunks_.end(), is_of_it), chunks_.end());
  return source;
}

void CommandBuffer::forget_nesting() {
  in_.reset();
  for (Chunk& chunk : chunks_) chunk.in.reset();
}

void CommandBuffer::clear() {
  chunks_.clear();
  bytes_ = 0;
  in_.reset();
}

std::string CommandBuffer::rest() const {
  std::string text;
  for (const Chunk& chunk : chunks_) text += chunk.text.substr(chunk.position);
  return text;
}

std::string commands_of_arguments(const std::vector<std::string>& arguments) {
  std::string commands;
  bool inside = false;
  for (const std::string& argument : arguments) {
    const auto starts = [&](char c) { return !argument.empty() && argument.front() == c; };
    const bool number = argument.size() > 1 && (argument[1] == '.' || (argument[1] >= '0' && argument[1] <= '9'));
    if (starts('+') && argument.size() > 1) {
      if (inside) commands += '\n';
      commands += argument.substr(1);
      inside = true;
    } else if (starts('-') && !number) {
      if (inside) commands += '\n';
      inside = false;
    } else if (inside) {
      const bool quote = argument.empty() || argument.find_first_of(" \t;") != argument.npos;
      const bool quotable = argument.find('"') == argument.npos;
      commands += quote && quotable ? " \"" + argument + '"' : ' ' + argument;
    }
  }
  if (inside) commands += '\n';
  return commands;
}

}  // namespace fb::con
