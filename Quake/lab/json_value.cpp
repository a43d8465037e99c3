#include "lab/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/number.h"

namespace fb::lab {
namespace {

// Every function leaves `at_` behind what it has read, or sets `error_` and returns.
class Parser {
 public:
  Parser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  Result<JsonValue> parse() {
    JsonValue value = read_value(0);
    skip_blanks();
    if (error_.empty() && at_ < text_.size()) fail("nothing is wanted behind the end");
    if (!error_.empty()) return Error{error_};
    return value;
  }

 private:
  void fail(std::string_view what) {
    if (error_.empty()) error_ = fmt::format("{}:{}: {}", name_, line_, what);
    at_ = text_.size();
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) {
    skip_blanks();
    if (peek() != c || at_ == text_.size()) return false;
    ++at_;
    return true;
  }
  void skip_blanks() {
    for (; at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos; ++at_)
      line_ += text_[at_] == '\n' ? 1 : 0;
  }

  JsonValue read_value(int depth) {
    skip_blanks();
    JsonValue value;
    value.line = line_;
    if (depth > kMaxJsonDepth) {
      fail("nested too deeply");
    } else if (take('{')) {
      value.kind = JsonValue::Kind::kObject;
      read_members(value, depth);
    } else if (take('[')) {
      value.kind = JsonValue::Kind::kArray;
      read_items(value, depth);
    } else if (peek() == '"') {
      value.kind = JsonValue::Kind::kText;
      value.text = read_text();
    } else {
      read_word(value);
    }
    return value;
  }

  void read_members(JsonValue& value, int depth) {
    if (take('}')) return;
    do {
      skip_blanks();
      if (peek() != '"') return fail("a key in quotes is wanted");
      std::string key = read_text();
      if (value.find(key) != nullptr) return fail(fmt::format("{} is there twice", key));
      if (!take(':')) return fail("a colon is wanted");
      JsonValue member = read_value(depth + 1);
      value.members.push_back({std::move(key), std::move(member)});
    } while (error_.empty() && take(','));
    if (!take('}')) fail("a comma or } is wanted");
  }

  void read_items(JsonValue& value, int depth) {
    if (take(']')) return;
    do {
      value.items.push_back(read_value(depth + 1));
    } while (error_.empty() && take(','));
    if (!take(']')) fail("a comma or ] is wanted");
  }

  void read_word(JsonValue& value) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(" \t\r\n,:]}[{\"").find(text_[at_]) == std::string_view::npos) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (word == "null") return;
    if (word == "true" || word == "false") {
      value.kind = JsonValue::Kind::kBoolean;
      value.boolean = word == "true";
      return;
    }
    const auto number = parse_number(word);
    if (!number) return fail("a value is wanted");
    value.kind = JsonValue::Kind::kNumber;
    value.number = *number;
    value.text = word;
  }

  std::string read_text() {
    std::string text;
    for (++at_; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        ++at_;
        return text;
      }
      if (static_cast<unsigned char>(c) < 0x20) break;
      if (c == '\\') {
        ++at_;
        if (!read_escape(text)) {
          fail("an unknown escape");
          return text;
        }
      } else {
        text += c;
      }
    }
    fail("a text does not end in its line");
    return text;
  }

  bool read_escape(std::string& text) {
    constexpr std::string_view kNames = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    if (peek() == 'u') return read_code(text);
    const std::size_t index = kNames.find(peek());
    if (at_ >= text_.size() || index == std::string_view::npos) return false;
    text += kMeanings[index];
    return true;
  }

  // \uXXXX of the basic plane, as UTF-8; surrogates, which no file of the laboratory needs, are refused.
  bool read_code(std::string& text) {
    std::uint32_t code = 0;
    for (int i = 0; i < 4; ++i) {
      ++at_;
      const std::size_t digit = std::string_view("0123456789abcdef").find(static_cast<char>(peek() | 0x20));
      if (at_ >= text_.size() || digit == std::string_view::npos) return false;
      code = code * 16 + static_cast<std::uint32_t>(digit);
    }
    if (code >= 0xd800 && code < 0xe000) return false;
    const auto tail = [](std::uint32_t bits) { return static_cast<char>(0x80 | (bits & 0x3f)); };
    if (code < 0x80) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += static_cast<char>(0xc0 | (code >> 6));
      text += tail(code);
    } else {
      text += static_cast<char>(0xe0 | (code >> 12));
      text += tail(code >> 6);
      text += tail(code);
    }
    return true;
  }

  std::string_view text_, name_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::string error_;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  const auto found = std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

Result<JsonValue> parse_json(std::string_view text, std::string_view name) { return Parser(text, name).parse(); }

}  // namespace fb::lab
