// Alias tables in integers (Walker 1977; Vose 1991): a place of n is drawn evenly, and a random integer below `total`
// that is below its threshold chooses the place itself, else another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fb::render {

struct AliasPlace {
  std::uint32_t threshold, other;
};
// `weights` add up to `total`. Each place is chosen exactly as often as its weight says. Linear in their number.
std::vector<AliasPlace> make_alias_table(std::span<const std::uint32_t> weights, std::uint32_t total);

}  // namespace fb::render
