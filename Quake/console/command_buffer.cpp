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

bool CommandBuffer::insert(std::string_view text, Origin origin) {
  if (depth_ >= kMaxDepth || bytes_ + text.size() + 1 > kMaxBytes) return false;
  Chunk chunk;
  chunk.text = std::string(text) + '\n';
  chunk.depth = depth_ + 1;
  chunk.origin = origin;
  bytes_ += chunk.text.size();
  chunks_.push_front(std::move(chunk));
  return true;
}

std::optional<std::string> CommandBuffer::next() {
  if (chunks_.empty()) return std::nullopt;
  Chunk& chunk = chunks_.front();
  const std::size_t end = command_end(chunk.text, chunk.position);
  std::string command = chunk.text.substr(chunk.position, end - chunk.position);
  const std::size_t after = std::min(end + 1, chunk.text.size());
  bytes_ -= after - chunk.position;
  chunk.position = after;
  depth_ = chunk.depth;
  origin_ = chunk.origin;
  if (chunk.position == chunk.text.size()) chunks_.pop_front();
  return command;
}

void CommandBuffer::forget_depth() {
  depth_ = 0;
  for (Chunk& chunk : chunks_) chunk.depth = 0;
}

void CommandBuffer::drop(Origin origin) {
  const auto dropped = [&](const Chunk& chunk) {
    return chunk.origin == Origin::kAlias || (origin == Origin::kScript && chunk.origin != Origin::kAppended);
  };
  for (const Chunk& chunk : chunks_) {
    if (dropped(chunk)) bytes_ -= chunk.text.size() - chunk.position;
  }
  chunks_.erase(std::remove_if(chunks_.begin(), chunks_.end(), dropped), chunks_.end());
}

void CommandBuffer::clear() {
  chunks_.clear();
  bytes_ = 0;
  depth_ = 0;
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
