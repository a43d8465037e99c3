// Which techniques a test goes through that is no row of the laboratory's table of bias.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "render/techniques/technique.h"

namespace fb::render {

enum class Whose { kAll, kUnbiased };

// One technique of each family (its name up to the first underscore): the last registered, whose shader has all steps
// of those before it. What a scene's media, panes and even light do with a path is the same code in all of a family;
// that each of them has its own steps right is asked by the suite Every (lab/ztest).
inline std::vector<std::string> one_of_each_family(Whose whose) {
  std::vector<std::string> names;
  std::map<std::string_view, std::size_t> places;
  for (const TechniqueInfo& technique : techniques()) {
    if (whose == Whose::kUnbiased && !technique.unbiased()) continue;
    const auto [place, is_new] = places.emplace(technique.name.substr(0, technique.name.find('_')), names.size());
    if (is_new) names.emplace_back();
    names[place->second] = technique.name;
  }
  return names;
}

}  // namespace fb::render
