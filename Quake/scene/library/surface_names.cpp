#include "scene/library/surface_names.h"

#include <algorithm>
#include <string>

#include "scene/library/asset_builder.h"

namespace fb::scene {
namespace {

struct LookRow {
  std::string_view part;  // of the lower-case name
  SurfaceLook look;
};
// First match counts. All are dielectric coats over the painted texture, whose colour already holds what a bare
// metal would reflect; values are modest, since the textures were painted with highlights.
constexpr LookRow kLooks[] = {
    {"*water", {0.25f, 0.02f}},  // F0 of water
    {"*slime", {0.35f, 0.02f}}, {"glass", {0.3f, 0.04f}},  {"window", {0.4f, 0.04f}}, {"chrome", {0.35f, 0.06f}},
    {"met", {0.6f, 0.05f}},  // met_, metal, cmet, wmet of id's and LibreQuake's sets
    {"steel", {0.6f, 0.05f}},   {"copper", {0.6f, 0.05f}}, {"tile", {0.55f, 0.04f}},  {"marble", {0.5f, 0.04f}},
};

}  // namespace

LiquidKind liquid_kind(std::string_view texture) {
  if (texture.empty() || texture.front() != '*') return LiquidKind::kNone;
  const std::string name = lower_case(texture);
  if (name.starts_with("*lava")) return LiquidKind::kLava;
  if (name.starts_with("*slime")) return LiquidKind::kSlime;
  if (name.starts_with("*tele")) return LiquidKind::kTeleport;
  return LiquidKind::kWater;
}

bool is_sky_texture(std::string_view texture) { return lower_case(texture.substr(0, 3)) == "sky"; }
bool is_alpha_texture(std::string_view texture) { return texture.starts_with('{'); }

bool is_tool_texture(std::string_view texture) {
  static constexpr std::string_view kTools[] = {"skip",      "hint",       "hintskip",  "clip",       "trigger",
                                                "origin",    "null",       "nodraw",    "caulk",      "*waterskip",
                                                "*lavaskip", "*slimeskip", "*teleskip", "ladder_skip"};
  return std::ranges::find(kTools, lower_case(texture)) != std::end(kTools);
}

std::optional<AnimatedName> animated_name(std::string_view texture) {
  if (texture.size() < 2 || texture[0] != '+') return std::nullopt;
  const char c = texture[1];
  const std::string_view base = texture.substr(2);
  if (c >= '0' && c <= '9') return AnimatedName{base, c - '0', false};
  if (c >= 'a' && c <= 'j') return AnimatedName{base, c - 'a', true};
  if (c >= 'A' && c <= 'J') return AnimatedName{base, c - 'A', true};
  return std::nullopt;
}

SurfaceLook surface_look(std::string_view texture) {
  const std::string name = lower_case(texture);
  for (const LookRow& row : kLooks)
    if (name.find(row.part) != std::string::npos) return row.look;
  return {};
}

}  // namespace fb::scene
