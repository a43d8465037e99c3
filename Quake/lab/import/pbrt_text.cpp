#include "lab/import/pbrt_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>

#include "fs/file.h"

namespace fb::lab {
namespace {

constexpr std::size_t kMostIncluded = 32;   // files in one another
constexpr std::size_t kMostFiles = 100000;  // all together

// How many names stand between a directive and its parameters.
struct Shape {
  std::string_view name;
  std::size_t least, most;
};
constexpr std::array kDirectives{Shape{"Accelerator", 1, 1},
                                 Shape{"ActiveTransform", 0, 0},
                                 Shape{"AreaLightSource", 1, 1},
                                 Shape{"Attribute", 1, 1},
                                 Shape{"AttributeBegin", 0, 0},
                                 Shape{"AttributeEnd", 0, 0},
                                 Shape{"Camera", 1, 1},
                                 Shape{"ColorSpace", 1, 1},
                                 Shape{"ConcatTransform", 0, 0},
                                 Shape{"CoordSysTransform", 1, 1},
                                 Shape{"CoordinateSystem", 1, 1},
                                 Shape{"Film", 1, 1},
                                 Shape{"Identity", 0, 0},
                                 Shape{"Import", 1, 1},
                                 Shape{"Include", 1, 1},
                                 Shape{"Integrator", 1, 1},
                                 Shape{"LightSource", 1, 1},
                                 Shape{"LookAt", 0, 0},
                                 Shape{"MakeNamedMaterial", 1, 1},
                                 Shape{"MakeNamedMedium", 1, 1},
                                 Shape{"Material", 1, 1},
                                 Shape{"MediumInterface", 1, 2},
                                 Shape{"NamedMaterial", 1, 1},
                                 Shape{"ObjectBegin", 1, 1},
                                 Shape{"ObjectEnd", 0, 0},
                                 Shape{"ObjectInstance", 1, 1},
                                 Shape{"Option", 0, 0},
                                 Shape{"PixelFilter", 1, 1},
                                 Shape{"ReverseOrientation", 0, 0},
                                 Shape{"Rotate", 0, 0},
                                 Shape{"Sampler", 1, 1},
                                 Shape{"Scale", 0, 0},
                                 Shape{"Shape", 1, 1},
                                 Shape{"Texture", 3, 3},
                                 Shape{"Transform", 0, 0},
                                 Shape{"TransformBegin", 0, 0},
                                 Shape{"TransformEnd", 0, 0},
                                 Shape{"TransformTimes", 0, 0},
                                 Shape{"Translate", 0, 0},
                                 Shape{"WorldBegin", 0, 0}};

bool is_directive(std::string_view text) {
  return std::ranges::find(kDirectives, text, &Shape::name) != kDirectives.end();
}

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool read_number(std::string_view text, float& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return false;
  value = static_cast<float>(number);
  return std::isfinite(value);
}

}  // namespace

const std::string& PbrtDirective::text(std::size_t i) const {
  static const std::string kNone;
  return i < texts.size() ? texts[i] : kNone;
}

const PbrtParameter* PbrtDirective::find(std::string_view wanted) const {
  asked.emplace(wanted);
  const auto found = std::ranges::find(parameters, wanted, &PbrtParameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

std::vector<std::string> PbrtDirective::unread() const {
  std::vector<std::string> sentences;
  const std::string kind = texts.empty() ? name : fmt::format("{} {}", name, texts.back());
  for (const PbrtParameter& p : parameters)
    if (!asked.contains(p.name)) sentences.push_back(fmt::format("{}: its {} is not read", kind, p.name));
  return sentences;
}

float PbrtDirective::number(std::string_view wanted, float otherwise) const {
  const PbrtParameter* p = find(wanted);
  return p == nullptr || p->numbers.empty() ? otherwise : p->numbers[0];
}

std::string PbrtDirective::word(std::string_view wanted, std::string_view otherwise) const {
  const PbrtParameter* p = find(wanted);
  return p == nullptr || p->texts.empty() ? std::string(otherwise) : p->texts[0];
}

vec3 PbrtDirective::vector(std::string_view wanted, const vec3& otherwise) const {
  const std::vector<vec3> all = vectors(wanted);
  return all.empty() ? otherwise : all[0];
}

std::vector<vec3> PbrtDirective::vectors(std::string_view wanted) const {
  std::vector<vec3> out;
  if (const PbrtParameter* p = find(wanted))
    for (std::size_t i = 0; i + 2 < p->numbers.size(); i += 3)
      out.emplace_back(p->numbers[i], p->numbers[i + 1], p->numbers[i + 2]);
  return out;
}

std::vector<vec2> PbrtDirective::pairs(std::string_view wanted) const {
  std::vector<vec2> out;
  if (const PbrtParameter* p = find(wanted))
    for (std::size_t i = 0; i + 1 < p->numbers.size(); i += 2) out.emplace_back(p->numbers[i], p->numbers[i + 1]);
  return out;
}

Result<PbrtText> PbrtText::open(const std::string& path) {
  PbrtText text;
  text.folder_ = std::filesystem::path(path).parent_path();
  if (auto status = text.push(path); !status) return status.error();
  return text;
}

Status PbrtText::push(const std::string& path) {
  if (files_.size() >= kMostIncluded) return error(fmt::format("files include each other {} deep", kMostIncluded));
  if (++included_ > kMostFiles) return error(fmt::format("more than {} files are included", kMostFiles));
  auto data = fs::read_whole_file(path);
  if (!data) return files_.empty() ? data.error() : error(data.error().message);
  File file;
  file.path = path;
  file.data = std::move(*data);
  if (file.data.text().starts_with("\xef\xbb\xbf")) file.at = 3;  // UTF-8's mark
  files_.push_back(std::move(file));
  return ok_status();
}

Error PbrtText::error(const std::string& what) const {
  if (files_.empty()) return Error{what};
  return Error{fmt::format("{}: line {}: {}", files_.back().path, files_.back().line, what)};
}

// A file's end is a token of its own: what includes it goes on with its next directive.
Result<PbrtText::Token> PbrtText::peek() {
  File& file = files_.back();
  if (file.has_next) return file.next;
  file.has_next = true;
  const std::string_view text = file.data.text();
  while (file.at < text.size()) {
    const char c = text[file.at];
    if (c == '#') {
      while (file.at < text.size() && text[file.at] != '\n') ++file.at;
    } else if (blank(c)) {
      if (c == '\n') ++file.line;
      ++file.at;
    } else {
      break;
    }
  }
  if (file.at >= text.size()) return file.next = {Kind::kEnd, {}};
  const std::size_t begin = file.at;
  const char c = text[file.at++];
  if (c == '[' || c == ']') return file.next = {c == '[' ? Kind::kOpen : Kind::kClose, {}};
  if (c == '"') {
    const std::size_t end = text.find_first_of("\"\n", file.at);
    if (end == std::string_view::npos || text[end] == '\n') return error("a string has no end");
    file.at = end + 1;
    return file.next = {Kind::kText, text.substr(begin + 1, end - begin - 1)};
  }
  while (file.at < text.size() && !blank(text[file.at]) &&
         std::string_view("[]\"#").find(text[file.at]) == std::string_view::npos)
    ++file.at;
  return file.next = {Kind::kWord, text.substr(begin, file.at - begin)};
}

// A value, or values in brackets. False where there is none.
Result<bool> PbrtText::read_values(PbrtParameter& parameter) {
  bool in_brackets = false, some = false;
  while (true) {
    const auto token = peek();
    if (!token) return token.error();
    if (token->kind == Kind::kEnd) {
      if (in_brackets) return error("a list has no end");
      return some;
    }
    if (token->kind == Kind::kOpen) {
      if (in_brackets) return error("a list within a list");
      in_brackets = true;
    } else if (token->kind == Kind::kClose) {
      if (!in_brackets) return error("a ] without its [");
      take();
      return true;
    } else if (token->kind == Kind::kText) {
      parameter.texts.emplace_back(token->text);
    } else if (token->text == "true" || token->text == "false") {
      parameter.texts.emplace_back(token->text);
    } else {
      float value = 0;
      if (!read_number(token->text, value)) {
        if (!in_brackets && !some) return false;
        return error(fmt::format("{} is no number", token->text));
      }
      parameter.numbers.push_back(value);
    }
    take();
    some = true;
    if (!in_brackets) return true;
  }
}

Result<bool> PbrtText::next(PbrtDirective& directive) {
  while (true) {
    const auto token = peek();
    if (!token) return token.error();
    take();
    if (token->kind == Kind::kEnd) {
      if (files_.size() == 1) return false;
      files_.pop_back();
      continue;
    }
    if (token->kind != Kind::kWord) return error("a directive's name is wanted");
    const auto known = std::ranges::find(kDirectives, token->text, &Shape::name);
    if (known == kDirectives.end()) return error(fmt::format("{} is no directive of pbrt-v4", token->text));
    directive = PbrtDirective();
    directive.name = token->text;
    directive.place = fmt::format("{}: line {}", files_.back().path, files_.back().line);
    while (true) {
      const auto part = peek();
      if (!part) return part.error();
      if (part->kind == Kind::kText && directive.texts.size() < known->most &&
          (directive.texts.size() < known->least || part->text.find(' ') == std::string_view::npos)) {
        directive.texts.emplace_back(part->text);
        take();
      } else if (part->kind == Kind::kText) {
        PbrtParameter parameter;
        const std::size_t first = part->text.find_first_of(" \t"), last = part->text.find_last_of(" \t");
        const bool bare = first == std::string_view::npos && directive.name == "Option";  // has no type
        if (!bare && (first == std::string_view::npos || first == 0 || last + 1 >= part->text.size()))
          return error(fmt::format("\"{}\" is no parameter's type and name", part->text));
        if (!bare) parameter.type = part->text.substr(0, first);
        parameter.name = bare ? part->text : part->text.substr(last + 1);
        take();
        const auto some = read_values(parameter);
        if (!some) return some.error();
        if (!*some) return error(fmt::format("\"{} {}\" has no value", parameter.type, parameter.name));
        directive.parameters.push_back(std::move(parameter));
      } else if (part->kind == Kind::kWord && directive.name == "ActiveTransform") {
        take();  // of which moments
        break;
      } else if (part->kind == Kind::kOpen || (part->kind == Kind::kWord && !is_directive(part->text))) {
        PbrtParameter own;
        const auto some = read_values(own);
        if (!some) return some.error();
        if (!*some) return error(fmt::format("{} is no directive of pbrt-v4, nor a number", part->text));
        directive.numbers.insert(directive.numbers.end(), own.numbers.begin(), own.numbers.end());
      } else if (part->kind == Kind::kClose) {
        return error("a ] without its [");
      } else {
        break;
      }
    }
    if (directive.texts.size() < known->least) return directive.error("its name is missing");
    if (directive.name != "Include" && directive.name != "Import") return true;
    if (auto status = push((folder_ / directive.text(0)).string()); !status) return status.error();
  }
}

}  // namespace fb::lab
