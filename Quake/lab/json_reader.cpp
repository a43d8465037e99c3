#include "lab/json_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <set>

#include "fs/file.h"

namespace fb::lab {
namespace {

constexpr int kDeepest = 64;

// Goes through a text and counts the lines that were left behind.
class LineCounter {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  LineCounter(const char* at, int* lines) : at_(at), lines_(lines) {}
  reference operator*() const { return *at_; }
  LineCounter& operator++() {
    if (*at_ == '\n') ++*lines_;
    ++at_;
    return *this;
  }
  LineCounter operator++(int) {
    LineCounter before = *this;
    ++*this;
    return before;
  }
  bool operator==(const LineCounter& other) const { return at_ == other.at_; }
  bool operator!=(const LineCounter& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  int* lines_;
};

// How many letters must be put in, left out or replaced.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string sentence_of(const std::exception& fault) {
  const std::string_view what = fault.what();
  const std::size_t end = what.starts_with('[') ? what.find("] ") : what.npos;
  return std::string(end == what.npos ? what : what.substr(end + 2));
}

Result<JsonFile> JsonFile::read(const std::string& path) {
  const auto bytes = fs::read_whole_file(path);
  if (!bytes) return bytes.error();
  return parse(bytes->text(), path);
}

Result<JsonFile> JsonFile::parse(std::string_view text, std::string path) {
  struct Seen {
    int line;
    std::string key;  // empty: an object begins
  };
  std::vector<Seen> seen;  // in the text's order
  std::vector<std::set<std::string>> keys;
  int line = 1;
  std::string wrong;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kDeepest && wrong.empty()) wrong = fmt::format("line {}: too many brackets in brackets", line);
    if (event == Json::parse_event_t::object_start) {
      keys.emplace_back();
      seen.push_back({line, {}});
    }
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key) {
      const auto key = parsed.get<std::string>();
      if (!keys.back().insert(key).second && wrong.empty())
        wrong = fmt::format("line {}: the key \"{}\" is there twice", line, key);
      seen.push_back({line, key});
    }
    return true;
  };
  JsonFile file;
  file.path_ = std::move(path);
  try {
    file.json_ = std::make_shared<Json>(
        Json::parse(LineCounter(text.data(), &line), LineCounter(text.data() + text.size(), &line), watch));
  } catch (const Json::exception& error) {
    return Error{fmt::format("{}: {}", file.path_, sentence_of(error))};
  }
  if (!wrong.empty()) return Error{fmt::format("{}: {}", file.path_, wrong)};
  // The same walk again, over what was made.
  auto next = seen.begin();
  const auto walk = [&](const auto& self, const Json& value) -> void {
    if (value.is_object()) {
      file.objects_[&value] = (next++)->line;
      for (const auto& [key, member] : value.items()) {
        file.members_[&value][key] = (next++)->line;
        self(self, member);
      }
    } else if (value.is_array()) {
      for (const Json& member : value) self(self, member);
    }
  };
  walk(walk, file.json());
  return file;
}

int JsonFile::line(const Json& object, const std::string& key) const {
  const auto found = members_.find(&object);
  if (found == members_.end()) return 0;
  const auto member = found->second.find(key);
  return member == found->second.end() ? line(object) : member->second;
}

int JsonFile::line(const Json& object) const {
  const auto found = objects_.find(&object);
  return found == objects_.end() ? 0 : found->second;
}

void JsonReader::fail_at(int line, std::string_view what) {
  if (!error_.empty()) return;
  if (line == 0) line = file_.line(object_);
  error_ = file_.path() + ": ";
  if (line != 0) error_ += fmt::format("line {}: ", line);
  if (!place_.empty()) error_ += place_ + ": ";
  error_ += what;
}

const Json* JsonReader::take(const std::string& key) {
  taken_.push_back(key);
  if (!object_.is_object()) return nullptr;
  const auto found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

std::string JsonReader::text(const std::string& key) {
  const Json* value = take(key);
  if (value == nullptr) return {};
  if (!value->is_string()) return fail(key, fmt::format("\"{}\": a text is wanted", key)), std::string();
  return value->get<std::string>();
}

bool JsonReader::boolean(const std::string& key, bool otherwise) {
  const Json* value = take(key);
  if (value == nullptr) return otherwise;
  if (!value->is_boolean()) return fail(key, fmt::format("\"{}\": true or false is wanted", key)), otherwise;
  return value->get<bool>();
}

double JsonReader::number(const std::string& key, double low, double high, double otherwise) {
  const Json* value = take(key);
  return value == nullptr ? otherwise : number_of(*value, key, low, high);
}

std::uint64_t JsonReader::whole(const std::string& key, std::uint64_t low, std::uint64_t high,
                                std::uint64_t otherwise) {
  const Json* value = take(key);
  if (value == nullptr) return otherwise;
  const std::uint64_t number = whole_of(*value, key, high);
  if (number < low) fail(key, fmt::format("\"{}\": a whole number from {} to {} is wanted", key, low, high));
  return number;
}

double JsonReader::number_of(const Json& value, const std::string& key, double low, double high) {
  if (value.is_number() && value.get<double>() >= low && value.get<double>() <= high) return value.get<double>();
  fail(key, low == high ? fmt::format("\"{}\": it can only be {} here", key, low)
                        : fmt::format("\"{}\": a number from {} to {} is wanted", key, low, high));
  return low;
}

std::uint64_t JsonReader::whole_of(const Json& value, const std::string& key, std::uint64_t high) {
  const double number = number_of(value, key, 0, static_cast<double>(high));
  if (number != std::floor(number)) fail(key, fmt::format("\"{}\": a whole number is wanted", key));
  return static_cast<std::uint64_t>(number);
}

std::vector<std::string> JsonReader::settings(const std::string& key) {
  std::vector<std::string> sets;
  const Json* object = take(key);
  if (object == nullptr) return sets;
  if (!object->is_object()) return fail(key, fmt::format("\"{}\": {{\"cvar\": value}} is wanted", key)), sets;
  for (const auto& [cvar, value] : object->items()) {
    if (!value.is_number() && !value.is_string()) {
      fail(key, fmt::format("\"{}\": a number or a text is wanted", cvar));
      return sets;
    }
    sets.push_back(cvar + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
  return sets;
}

Status JsonReader::end() {
  if (object_.is_object()) {
    for (const auto& [key, value] : object_.items()) {
      if (std::find(taken_.begin(), taken_.end(), key) != taken_.end()) continue;
      const auto nearest = std::ranges::min_element(
          taken_, {}, [&wrong = key](const std::string& known) { return distance(known, wrong); });
      if (nearest != taken_.end() && distance(*nearest, key) <= 2)
        fail(key, fmt::format("\"{}\" is no key here; \"{}\" is", key, *nearest));
      else
        fail(key, fmt::format("\"{}\" is no key here; there are {}", key, fmt::join(taken_, ", ")));
    }
  }
  return error_.empty() ? ok_status() : Status(Error{error_});
}

}  // namespace fb::lab
