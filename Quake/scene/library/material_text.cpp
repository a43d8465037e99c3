#include "scene/library/material_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/number.h"
#include "base/text_mark.h"

namespace fb::scene {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";
constexpr double kLeastShare = 1e-4, kMostDistance = 1e6;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  line = line.substr(0, line.find("//"));
  for (std::size_t at = line.find_first_not_of(kBlanks); at != line.npos; at = line.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

// Fills `values` with the words behind the property's name.
Status read_numbers(std::string_view where, std::span<const std::string_view> words, double low, double high,
                    std::span<double> values) {
  if (words.size() != values.size() + 1)
    return Error{fmt::format("{}: {} has {} numbers, not {}", where, words[0], values.size(), words.size() - 1)};
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto value = number_in(fmt::format("{}: {}", where, words[0]), words[i + 1], low, high);
    if (!value) return value.error();
    values[i] = *value;
  }
  return ok_status();
}

}  // namespace

Result<MaterialText> parse_material_text(std::string_view text, std::string_view path) {
  std::array<double, 3> color{1, 1, 1};
  double index = 0, distance = 64, scatter = 0;
  text = without_byte_order_mark(text);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::vector<std::string_view> words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (words.empty()) continue;
    const std::string where = fmt::format("{}, line {}", path, number);
    Status read = ok_status();
    if (words[0] == "index") {
      read = read_numbers(where, words, 1.0, 4.0, std::span(&index, 1));
    } else if (words[0] == "color") {
      read = read_numbers(where, words, kLeastShare, 1.0, color);
    } else if (words[0] == "distance") {
      read = read_numbers(where, words, 1e-3, kMostDistance, std::span(&distance, 1));
    } else if (words[0] == "scatter") {
      read = read_numbers(where, words, 1e-3, kMostDistance, std::span(&scatter, 1));
    } else {
      return Error{fmt::format("{}: {}: index, color, distance or scatter is wanted", where, words[0])};
    }
    if (!read) return read.error();
  }
  if (index == 0) return Error{fmt::format("{}: it names no index of refraction", path)};
  MaterialText material;
  material.index = static_cast<float>(index);
  for (std::size_t i = 0; i < color.size(); ++i)
    material.absorption[static_cast<int>(i)] = static_cast<float>(-std::log(color[i]) / distance);
  if (scatter > 0) material.scattering = static_cast<float>(std::log(2.0) / scatter);
  return material;
}

}  // namespace fb::scene
