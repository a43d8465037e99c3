// What the compiled shaders must not hold.
#include "render/passes/shader_code.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace fb::render {
namespace {

// Loads of whole arrays whose length is a constant (SPIR-V, sections 2.3 and 3.49), by length.
std::map<std::uint32_t, int> array_copies(std::span<const std::uint32_t> words) {
  constexpr std::uint32_t kHeader = 5, kTypeArray = 28, kConstant = 43, kLoad = 61;
  std::map<std::uint32_t, std::uint32_t> constants, lengths;  // by id
  std::map<std::uint32_t, int> copies;
  for (std::size_t at = kHeader; at < words.size(); at += words[at] >> 16u) {
    const std::uint32_t operation = words[at] & 0xffffu;
    if (operation == kConstant) constants[words[at + 2]] = words[at + 3];
    if (operation == kTypeArray && constants.contains(words[at + 3])) lengths[words[at + 1]] = constants[words[at + 3]];
    if (operation == kLoad && lengths.contains(words[at + 1])) ++copies[lengths[words[at + 1]]];
  }
  return copies;
}

// A function that takes the traversal's stack copies it, and NVIDIA's compiler leaves the copies in: the G-buffer took
// eight times as long. (The lobes of path guiding, whose number is a specialisation constant, it does find.)
TEST(ShaderCode, NoTraversalCopiesItsStack) {
  for (const std::string name :
       {"gbuffer", "trace_rays", "pt", "pt_medium", "nee", "nee_medium", "mcpg", "mcpg_medium", "mcpg_nee",
        "mcpg_nee_medium", "mcpg_tail", "mcpg_tail_medium", "mcpg_nee_tail", "mcpg_nee_tail_medium"})
    for (const bool by_address : {false, true})
      for (const auto& [length, times] : array_copies(shader_code(name, false, by_address)))
        ADD_FAILURE() << fmt::format("{} copies an array of {} {} times", name, length, times);
}

}  // namespace
}  // namespace fb::render
