// The words of pbrt-v4's scene files (Pharr, Jakob, Humphreys: pbrt-v4 Input File Format): directives with their
// numbers, names and parameters. What they mean is pbrt_import's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_data.h"
#include "base/maths.h"
#include "base/result.h"

namespace fb::lab {

// "TYPE NAME" VALUES
struct PbrtParameter {
  std::string type, name;
  std::vector<float> numbers;
  std::vector<std::string> texts;  // of strings and truth values
};

struct PbrtDirective {
  std::string name;
  std::vector<float> numbers;
  std::vector<std::string> texts;
  std::vector<PbrtParameter> parameters;
  std::string place;  // "FILE: line N", for errors
  mutable std::set<std::string, std::less<>> asked;

  Error error(const std::string& what) const { return Error{place + ": " + name + ": " + what}; }
  const std::string& text(std::size_t i) const;  // empty if there are fewer
  const PbrtParameter* find(std::string_view name) const;
  // A sentence for each parameter that nobody has asked for.
  std::vector<std::string> unread() const;
  float number(std::string_view name, float otherwise) const;
  std::string word(std::string_view name, std::string_view otherwise) const;
  vec3 vector(std::string_view name, const vec3& otherwise) const;
  // Numbers by threes or twos; what is left over is dropped.
  std::vector<vec3> vectors(std::string_view name) const;
  std::vector<vec2> pairs(std::string_view name) const;
};

// Reads directives one after the other; files that Include or Import name are read in their place, from the first
// file's folder.
class PbrtText {
 public:
  static Result<PbrtText> open(const std::string& path);
  // False at the end. Fails on text that is no directive.
  Result<bool> next(PbrtDirective& directive);
  const std::filesystem::path& folder() const { return folder_; }

 private:
  enum class Kind : std::uint8_t { kEnd, kWord, kText, kOpen, kClose };
  struct Token {
    Kind kind = Kind::kEnd;
    std::string_view text;
  };
  struct File {
    std::string path;
    FileData data;
    std::size_t at = 0;
    int line = 1;
    Token next;  // looked at and not taken
    bool has_next = false;
  };

  Status push(const std::string& path);
  Result<Token> peek();
  void take() { files_.back().has_next = false; }
  Result<bool> read_values(PbrtParameter& parameter);
  Error error(const std::string& what) const;

  std::filesystem::path folder_;
  std::vector<File> files_;
  std::size_t included_ = 0;  // files, all together
};

}  // namespace fb::lab
