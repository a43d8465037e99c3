#include "world/entity_lump.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/text_mark.h"

namespace fb::world {
namespace {

bool is_blank(char c) { return static_cast<unsigned char>(c) <= ' '; }
bool stands_alone(char c) { return c == '{' || c == '}' || c == '(' || c == ')' || c == '\'' || c == ':'; }

// Quake's tokens: quoted strings without escapes (an unclosed one ends with the text), single punctuation marks, words;
// comments as in C++, of a line or of a block.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  struct Token {
    std::string_view text;
    bool quoted = false;
    std::size_t offset = 0;
    bool is_mark(char c) const { return !quoted && text.size() == 1 && text[0] == c; }
  };
  std::optional<Token> next() {
    skip_blanks_and_comments();
    if (at_ >= text_.size()) return std::nullopt;
    const std::size_t begin = at_;
    if (text_[begin] == '"') {
      const std::size_t close = std::min(text_.find('"', begin + 1), text_.size());
      at_ = std::min(close + 1, text_.size());
      return Token{text_.substr(begin + 1, close - begin - 1), true, begin};
    }
    ++at_;
    if (!stands_alone(text_[begin]))
      while (at_ < text_.size() && !is_blank(text_[at_]) && !stands_alone(text_[at_])) ++at_;
    return Token{text_.substr(begin, at_ - begin), false, begin};
  }
  std::size_t offset() const { return at_; }

 private:
  void skip_blanks_and_comments() {
    while (at_ < text_.size()) {
      if (is_blank(text_[at_])) {
        ++at_;
      } else if (text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        at_ = end == text_.npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<float> parse_numbers(std::string_view text, std::size_t most) {
  std::vector<float> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (numbers.size() < most) {
    while (at != end && is_blank(*at)) ++at;
    if (at != end && *at == '+') ++at;
    float value = 0.0f;
    const auto [rest, code] = std::from_chars(at, end, value);
    if (code != std::errc() || !std::isfinite(value)) break;
    numbers.push_back(value);
    at = rest;
  }
  return numbers;
}

std::string_view Entity::text(std::string_view key) const {
  const auto found = values.find(key);
  return found == values.end() ? std::string_view() : std::string_view(found->second);
}

float Entity::number(std::string_view key, float fallback) const {
  const std::vector<float> numbers = parse_numbers(text(key), 1);
  return numbers.empty() ? fallback : numbers[0];
}

int Entity::integer(std::string_view key, int fallback) const {
  const float value = number(key, static_cast<float>(fallback));
  return std::fabs(value) < 2e9f ? static_cast<int>(value) : fallback;
}

std::optional<vec3> Entity::vector(std::string_view key) const {
  const std::vector<float> numbers = parse_numbers(text(key), 3);
  if (numbers.size() < 3) return std::nullopt;
  return vec3(numbers[0], numbers[1], numbers[2]);
}

std::optional<vec3> Entity::color(std::string_view key) const {
  const std::optional<vec3> value = vector(key);
  if (!value) return std::nullopt;
  const vec3 positive = glm::max(*value, vec3(0.0f));
  const float largest = std::fmax(positive.x, std::fmax(positive.y, positive.z));
  return largest > 1.0f ? glm::min(positive / 255.0f, vec3(1.0f)) : positive;
}

Result<std::vector<Entity>> parse_entity_lump(std::string_view text, std::string_view name) {
  // A lump may include its terminating zero; bytes after it are not text.
  text = without_byte_order_mark(text.substr(0, text.find('\0')));
  const auto error = [&](std::size_t offset, std::string_view cause) {
    return Error{fmt::format("{}: entities: offset {}: {}", name, offset, cause)};
  };
  std::vector<Entity> entities;
  Tokens tokens(text);
  while (const auto open = tokens.next()) {
    if (!open->is_mark('{')) return error(open->offset, fmt::format("found \"{}\" where {{ should be", open->text));
    Entity entity;
    while (true) {
      const auto key = tokens.next();
      if (!key) return error(tokens.offset(), "the text ends inside an entity");
      if (key->is_mark('}')) break;
      const auto value = tokens.next();
      if (!value) return error(tokens.offset(), "the text ends inside an entity");
      if (value->is_mark('}')) return error(value->offset, fmt::format("key \"{}\" has no value", key->text));
      std::string_view trimmed = key->text;
      while (!trimmed.empty() && trimmed.back() == ' ') trimmed.remove_suffix(1);
      entity.values.insert_or_assign(std::string(trimmed), std::string(value->text));
    }
    entities.push_back(std::move(entity));
  }
  return entities;
}

}  // namespace fb::world
