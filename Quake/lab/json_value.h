// JsonValue: JSON text (RFC 8259) read into a tree, for the laboratory's own small files; JsonWriter writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace fb::lab {

struct JsonMember;

struct JsonValue {
  enum class Kind { kNull, kBoolean, kNumber, kText, kArray, kObject };
  Kind kind = Kind::kNull;
  int line = 1;  // where it begins, from 1
  bool boolean = false;
  double number = 0;
  std::string text;                 // of kText, UTF-8; of kNumber, as it was written
  std::vector<JsonValue> items;     // of kArray
  std::vector<JsonMember> members;  // of kObject, in the file's order

  const JsonValue* find(std::string_view key) const;  // null if there is no such member
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

constexpr int kMaxJsonDepth = 32;

// `name` is the file, for the sentence of an error, which names the line. The same key twice is an error.
Result<JsonValue> parse_json(std::string_view text, std::string_view name);

}  // namespace fb::lab
