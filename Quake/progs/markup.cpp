#include "progs/markup.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace fb::progs {
namespace {

constexpr unsigned kGold = 128;
// ^0 to ^9 (Quake 3's).
constexpr std::array<std::array<float, 4>, 10> kColors = {{{0.0f, 0.0f, 0.0f, 1.0f},
                                                           {1.0f, 0.33f, 0.33f, 1.0f},
                                                           {0.0f, 1.0f, 0.33f, 1.0f},
                                                           {1.0f, 1.0f, 0.33f, 1.0f},
                                                           {0.33f, 0.33f, 1.0f, 1.0f},
                                                           {0.33f, 1.0f, 1.0f, 1.0f},
                                                           {1.0f, 0.33f, 1.0f, 1.0f},
                                                           {1.0f, 1.0f, 1.0f, 1.0f},
                                                           {1.0f, 1.0f, 1.0f, 0.5f},
                                                           {0.5f, 0.5f, 0.5f, 1.0f}}};

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return std::nullopt;
}

// Quake's code of a Unicode code point.
unsigned char quake_code(std::uint32_t point) {
  if (point >= 0xe000 && point <= 0xe0ff) return static_cast<unsigned char>(point & 0xffu);
  if (point >= 32 && point < 127) return static_cast<unsigned char>(point);
  return '?';
}

class MarkupReader {
 public:
  MarkupReader(std::string_view text, const vec4& color) : text_(text), plain_(color), color_(color) {
    if (!text_.empty() && (text_.front() == 1 || text_.front() == 2)) {  // Quake's mark of a golden line
      alphabet_ = kGold;
      text_.remove_prefix(1);
    }
  }

  std::vector<Letter> read() {
    letters_.reserve(text_.size());
    while (!text_.empty()) {
      if (text_.size() >= 2 && text_.front() == '^' && mark()) continue;
      put(static_cast<unsigned char>(static_cast<unsigned char>(text_.front()) | alphabet_));
      text_.remove_prefix(1);
    }
    return std::move(letters_);
  }

 private:
  void put(unsigned char code) { letters_.push_back({code, color_}); }

  // The number of `count` hexadecimal digits from `at` on.
  std::optional<std::uint32_t> number(std::size_t at, std::size_t count) const {
    if (text_.size() < at + count) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + count; ++i) {
      const auto digit = hex_digit(text_[i]);
      if (!digit) return std::nullopt;
      value = value * 16 + *digit;
    }
    return value;
  }

  // Takes the mark that the text begins with; false if it begins with none.
  bool mark() {
    const char kind = text_[1];
    std::size_t length = 2;
    if (kind >= '0' && kind <= '9') {
      const auto& c = kColors[static_cast<std::size_t>(kind - '0')];
      color_ = plain_ * vec4(c[0], c[1], c[2], c[3]);
    } else if (kind == '^') {
      put(static_cast<unsigned char>('^' | alphabet_));
    } else if (kind == 'd') {
      color_ = plain_;
      alphabet_ = 0;
    } else if (kind == 'm' || kind == 'a') {
      alphabet_ ^= kGold;
    } else if (kind == 'h') {
      color_.w = color_.w == plain_.w ? plain_.w * 0.5f : plain_.w;
    } else if (kind == 'b' || kind == 's' || kind == 'r') {
      // Blinking, and a stack of colours: not drawn here.
    } else if (const auto rgb = number(2, 3); kind == 'x' && rgb) {
      color_ = plain_ * vec4(vec3(*rgb >> 8u, *rgb >> 4u & 15u, *rgb & 15u) / 15.0f, 1.0f);
      length = 5;
    } else if (const auto point = number(2, 4); kind == 'U' && point) {
      put(quake_code(*point));
      length = 6;
    } else if (kind == '{') {
      const std::size_t end = text_.find('}');
      const auto code = end == text_.npos || end == 2 || end > 8 ? std::nullopt : number(2, end - 2);
      if (!code) return false;
      put(quake_code(*code));
      length = end + 1;
    } else {
      return false;
    }
    text_.remove_prefix(length);
    return true;
  }

  std::string_view text_;
  vec4 plain_, color_;
  unsigned alphabet_ = 0;
  std::vector<Letter> letters_;
};

}  // namespace

std::vector<Letter> marked_up(std::string_view text, const vec4& color) { return MarkupReader(text, color).read(); }

}  // namespace fb::progs
