// What the names of Quake's textures mean: liquids, sky, holes, tools, animation; and how shiny a name suggests a
// surface to be.
#pragma once

#include <optional>
#include <string_view>

namespace fb::scene {

enum class LiquidKind { kNone, kWater, kLava, kSlime, kTeleport };
// By the letters after `*`, as QuakeSpasm: *lava..., *slime..., *tele..., all else is water.
LiquidKind liquid_kind(std::string_view texture);
bool is_sky_texture(std::string_view texture);    // sky...
bool is_alpha_texture(std::string_view texture);  // {...
// Textures of brushes that exist for tools and triggers: compilers leave most of them out, the rest are of entities
// that no server sends.
bool is_tool_texture(std::string_view texture);

// `+3wall` is frame 3 of "wall"; `+cwall` frame 2 of its alternate sequence.
struct AnimatedName {
  std::string_view base;
  int frame = 0;  // 0..9
  bool alternate = false;
};
std::optional<AnimatedName> animated_name(std::string_view texture);

struct SurfaceLook {
  float roughness = 1.0f, specular = 0.0f;
};
// One table of substrings; a `_gloss` image overrides the roughness. Names that it does not know are plain Lambert.
SurfaceLook surface_look(std::string_view texture);

}  // namespace fb::scene
