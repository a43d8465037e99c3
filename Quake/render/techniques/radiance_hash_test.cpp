// Which code tells one reference from another.
#include "render/techniques/radiance_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "render/techniques/technique.h"

namespace fb::render {
namespace {

constexpr std::array<std::uint32_t, 2> kOther{1, 2};

using VariantOfShader = std::span<const std::uint32_t> CompiledShader::*;

// The hash after one variant of a shader has changed.
std::uint64_t hash_with(std::string_view estimator, std::string_view changed, VariantOfShader variant) {
  std::vector<CompiledShader> shaders(compiled_shaders().begin(), compiled_shaders().end());
  const auto shader = std::ranges::find(shaders, changed, &CompiledShader::name);
  EXPECT_NE(shader, shaders.end()) << changed;
  if (shader != shaders.end()) (*shader).*variant = kOther;
  return radiance_hash(estimator, {.shaders = shaders});
}

bool counts(std::string_view estimator, std::string_view shader, VariantOfShader variant = &CompiledShader::bound) {
  return hash_with(estimator, shader, variant) != radiance_hash(estimator);
}

TEST(RadianceHash, HoldsWhatMakesTheLinearPicture) {
  for (const TechniqueInfo& technique : techniques()) {
    const std::string name(technique.name);
    const std::string fog = (name == "ddgi_restir" ? "ddgi_plus" : name) + "_medium";
    for (const std::string& shader :
         {name, fog, std::string("gbuffer"), std::string("gbuffer_water"), std::string("accumulate"),
          std::string("accumulate_medium"), std::string("pose"), std::string("fold_seen")})
      EXPECT_TRUE(counts(name, shader)) << name << ' ' << shader;
  }
  for (const char* name : {"mcpg", "mcpg_nee", "mcpg_tail"})
    for (const char* shader : {"mcpg_fold_cache", "mcpg_resolve_states"})
      EXPECT_TRUE(counts(name, shader)) << name << ' ' << shader << ", a pass of its folder";
  EXPECT_TRUE(counts("restir_guided", "mcpg_fold_cache")) << "a pass of the folder that it stands on";
  for (const char* name : {"restir_di", "restir_gi", "restir_guided"})
    EXPECT_TRUE(counts(name, "restir_spatial")) << name;
  for (const VariantOfShader variant : {&CompiledShader::bound, &CompiledShader::address, &CompiledShader::query})
    EXPECT_TRUE(counts("nee", "nee", variant));
}

TEST(RadianceHash, LeavesOutOtherTechniquesAndTheDisplay) {
  for (const char* shader : {"pt", "pt_medium", "mcpg", "mcpg_nee", "mcpg_nee_medium", "mcpg_tail", "mcpg_fold_cache",
                             "restir_spatial", "pstf_fold"})
    EXPECT_FALSE(counts("nee", shader)) << shader;
  EXPECT_FALSE(counts("restir_di", "mcpg_fold_cache"));
  for (const std::string_view shader : display_shaders()) EXPECT_FALSE(counts("nee", shader)) << shader;
}

TEST(RadianceHash, HoldsANewShader) {
  std::vector<CompiledShader> shaders(compiled_shaders().begin(), compiled_shaders().end());
  shaders.push_back({"new_pass", kOther, kOther, {}});
  for (const TechniqueInfo& technique : techniques())
    EXPECT_NE(radiance_hash(technique.name, {.shaders = shaders}), radiance_hash(technique.name)) << technique.name;
}

TEST(RadianceHash, HoldsTheVersionOfTheListOfLights) {
  EXPECT_NE(radiance_hash("nee", {.light_list = kLightListVersion + 1}), radiance_hash("nee"));
}

TEST(RadianceHash, OfEveryTechniqueIsItsOwn) {
  std::set<std::uint64_t> hashes;
  for (const TechniqueInfo& technique : techniques()) hashes.insert(radiance_hash(technique.name));
  EXPECT_EQ(hashes.size(), techniques().size());
}

}  // namespace
}  // namespace fb::render
