// JsonWriter: JSON text, member after member, indented; numbers with all their digits, those that JSON cannot say as
// null.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "lab/statistics.h"

namespace fb::lab {

class JsonWriter {
 public:
  // `key` is empty within arrays and at the top.
  JsonWriter& open_object(std::string_view key = {}) { return open(key, '{', '}'); }
  JsonWriter& open_array(std::string_view key = {}) { return open(key, '[', ']'); }
  JsonWriter& close();
  JsonWriter& number(std::string_view key, double value);
  template <std::integral T>
  JsonWriter& integer(std::string_view key, T value) {
    return raw(key, std::to_string(value));
  }
  JsonWriter& text(std::string_view key, std::string_view value);
  JsonWriter& estimate(std::string_view key, const Estimate& e);  // {"value": x, "interval95": [low, high]}
  JsonWriter& boolean(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
  // All that was written; everything that was opened must be closed.
  const std::string& str() const;

 private:
  JsonWriter& open(std::string_view key, char opening, char closing);
  JsonWriter& raw(std::string_view key, std::string_view value);
  void begin(std::string_view key);

  std::string out_, closing_;
  bool first_ = true;
};

}  // namespace fb::lab
