#include "lab/json.h"

#include <fmt/format.h>

#include <cmath>

#include "base/check.h"

namespace fb::lab {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

void JsonWriter::begin(std::string_view key) {
  if (!first_) out_ += ',';
  first_ = false;
  if (!closing_.empty()) out_ += '\n' + std::string(2 * closing_.size(), ' ');
  if (!key.empty()) out_ += quoted(key) + ": ";
}

JsonWriter& JsonWriter::open(std::string_view key, char opening, char closing) {
  begin(key);
  out_ += opening;
  closing_ += closing;
  first_ = true;
  return *this;
}

JsonWriter& JsonWriter::close() {
  FB_CHECK(!closing_.empty());
  const char closing = closing_.back();
  closing_.pop_back();
  if (!first_) out_ += '\n' + std::string(2 * closing_.size(), ' ');
  out_ += closing;
  first_ = false;
  if (closing_.empty()) out_ += '\n';
  return *this;
}

JsonWriter& JsonWriter::raw(std::string_view key, std::string_view value) {
  begin(key);
  out_ += value;
  return *this;
}

JsonWriter& JsonWriter::number(std::string_view key, double value) {
  return raw(key, std::isfinite(value) ? fmt::format("{}", value) : "null");
}

JsonWriter& JsonWriter::text(std::string_view key, std::string_view value) { return raw(key, quoted(value)); }

JsonWriter& JsonWriter::estimate(std::string_view key, const Estimate& e) {
  open_object(key).number("value", e.value);
  return open_array("interval95").number("", e.interval.low).number("", e.interval.high).close().close();
}

const std::string& JsonWriter::str() const {
  FB_CHECK(closing_.empty());
  return out_;
}

}  // namespace fb::lab
