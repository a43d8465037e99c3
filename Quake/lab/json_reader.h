// Reads JSON files that people write: every member is asked for by name, what nobody asks for is an error, and errors
// name the file and the line.
#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "lab/json.h"

namespace fb::lab {

// What the library says of a fault, without its code, "[json.exception.parse_error.101] ".
std::string sentence_of(const std::exception& fault);

// A file's contents, and where in it each member stands.
class JsonFile {
 public:
  // Fails with "FILE: line N: ..." where the text is no JSON, or an object holds a key twice.
  static Result<JsonFile> read(const std::string& path);
  static Result<JsonFile> parse(std::string_view text, std::string path);

  const Json& json() const { return *json_; }
  const std::string& path() const { return path_; }
  // Of a member of an object of this file; 0 if it has none of that name.
  int line(const Json& object, const std::string& key) const;
  int line(const Json& object) const;  // where it begins

 private:
  std::shared_ptr<Json> json_;  // addresses of its parts are keys below
  std::string path_;
  std::map<const Json*, std::map<std::string, int>> members_;
  std::map<const Json*, int> objects_;
};

// Reads one object's members. The first error stays.
class JsonReader {
 public:
  // `place`: what the object is, for errors: "views[2]".
  JsonReader(const JsonFile& file, const Json& object, std::string place = {})
      : file_(file), object_(object), place_(std::move(place)) {
    if (!object.is_object()) fail("an object in { } is wanted");
  }

  std::string text(const std::string& key);
  bool boolean(const std::string& key, bool otherwise = false);
  double number(const std::string& key, double low, double high, double otherwise);
  std::uint64_t whole(const std::string& key, std::uint64_t low, std::uint64_t high, std::uint64_t otherwise);
  // The same of a value that was taken as `key`.
  double number_of(const Json& value, const std::string& key, double low, double high);
  std::uint64_t whole_of(const Json& value, const std::string& key, std::uint64_t high);
  // {"cvar": value, ...} as "cvar=value".
  std::vector<std::string> settings(const std::string& key);
  // Null if the member is missing.
  const Json* take(const std::string& key);
  void fail(std::string_view what) { fail_at(0, what); }
  void fail(const std::string& key, std::string_view what) { fail_at(file_.line(object_, key), what); }
  // Of a part that another reader read, whose sentence names its place.
  void fail_with(const std::string& sentence) {
    if (error_.empty()) error_ = sentence;
  }
  bool failed() const { return !error_.empty(); }
  // An error if one of the above found one, or if there is a member that nobody asked for.
  Status end();

 private:
  void fail_at(int line, std::string_view what);

  const JsonFile& file_;
  const Json& object_;
  std::string place_, error_;
  std::vector<std::string> taken_;
};

}  // namespace fb::lab
