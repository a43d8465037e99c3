#include "client/sources/map_view.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/log.h"
#include "base/number.h"
#include "net/protocol.h"
#include "scene/library/light_sources.h"
#include "world/entity_lump.h"

namespace fb::cl {
namespace {

constexpr float kEyeHeight = 23.0f;  // the player spawns one unit up, and looks from 22 above its origin
constexpr int kSwitchableStyles = 32;

// The light styles that Quake's game code sets for every map.
constexpr std::array<std::string_view, 12> kStyles = {"m",
                                                      "mmnmmommommnonmmonqnmmo",
                                                      "abcdefghijklmnopqrstuvwxyzyxwvutsrqponmlkjihgfedcba",
                                                      "mmmmmaaaaammmmmaaaaaabcdefgabcdefg",
                                                      "mamamamamama",
                                                      "jklmnopqrstuvwxyzyxwvutsrqponmlkj",
                                                      "nmonqnmomnmomomno",
                                                      "mmmaaaabcdefgmmmmaaaammmaamm",
                                                      "mmmaaammmaaammmabcdefaaaammmmabcdefmmmaaaa",
                                                      "aaaaaaaazzzzzzzz",
                                                      "mmamammmmammamamaaamammma",
                                                      "abcdefghijklmnopqrrqponmlkjihgfedcba"};

struct Torch {
  std::string_view classname, model;
  int frame;
};
constexpr std::array<Torch, 4> kTorches = {{{"light_torch_small_walltorch", "progs/flame.mdl", 0},
                                            {"light_flame_large_yellow", "progs/flame2.mdl", 1},
                                            {"light_flame_small_yellow", "progs/flame2.mdl", 0},
                                            {"light_flame_small_white", "progs/flame2.mdl", 0}}};

Entity make_static(const world::Entity& source, int model, int frame) {
  Entity e;
  e.model = model;
  e.frame = frame;
  e.origin = e.drawn_origin = source.vector("origin").value_or(vec3(0.0f));
  if (source.has("alpha")) e.alpha = net::encode_alpha(glm::clamp(source.number("alpha", 1.0f), 0.0f, 1.0f));
  e.lerp_flags = kLerpResetAnim | kLerpResetMove;
  e.visible = true;
  return e;
}

Entity at_rest(Entity e, const world::Entity& source, const formats::Bsp& map, std::string_view model) {
  const auto index = parse_whole_number_unsigned(model.substr(1));
  if (!index || *index >= map.models.size()) return e;
  e.origin = e.drawn_origin = e.origin + scene::rest_offset(source, map.models[*index]);
  return e;
}

void place_camera(const std::vector<world::Entity>& entities, const scene::Model& world, View& view) {
  for (std::string_view start :
       {"info_player_start", "info_player_coop", "info_player_deathmatch", "testplayerstart"}) {
    for (const world::Entity& e : entities) {
      if (e.classname() != start) continue;
      view.origin = e.vector("origin").value_or(vec3(0.0f)) + vec3(0, 0, kEyeHeight);
      view.angles = e.vector("angles").value_or(vec3(0.0f, e.number("angle", 0.0f), 0.0f));
      return;
    }
  }
  view.origin = 0.5f * (world.mins + world.maxs);
}

}  // namespace

std::string map_path(std::string_view name) {
  std::string path(name);
  if (path.find('/') == std::string::npos) path.insert(0, "maps/");
  if (path.size() < 4 || path.substr(path.size() - 4) != ".bsp") path += ".bsp";
  return path;
}

void apply_worldspawn(std::string_view text, std::string_view map_name, const Settings& settings, ClientState& state) {
  const auto entities = world::parse_entity_lump(text, map_name);
  if (!entities.ok() || entities->empty()) return;
  const world::Entity& world = entities->front();
  for (std::string_view key : {"sky", "_sky", "skyname", "_skyname", "qlsky", "_qlsky"}) {
    if (!world.has(key)) continue;
    state.skybox = std::string(world.text(key));
    state.sky_changed = true;
  }
  for (std::string_view key : {"fog", "_fog"}) {
    const std::vector<float> numbers = world::parse_numbers(world.text(key), 4);
    if (numbers.empty()) continue;
    Fog fog;
    fog.density = std::max(0.0f, numbers[0]);
    if (numbers.size() == 4) fog.color = glm::clamp(vec3(numbers[1], numbers[2], numbers[3]), 0.0f, 1.0f);
    change_fog(state.fog, fog, 0.0, state.time);
  }
  for (std::string_view key : {"skyfog", "_skyfog"})
    if (world.has(key)) state.sky_fog = {world.number(key, 0.0f), settings.r_skyfog};
}

Status load_map_view(std::string_view name, scene::ModelLibrary& library, Session& session, View& view) {
  const std::string path = map_path(name);
  const Status loaded = library.load_map(path);
  if (!loaded.ok()) return loaded;
  session.clear();
  ClientState& state = session.state;
  state.have_server_info = true;
  state.signon = kSignons;
  state.time = state.old_time = 1.0;
  state.hud.map_name = std::string(name);
  state.model_names = {"", path};
  state.models = {nullptr, &library.model(path)};
  const auto model_index = [&](std::string_view model) {
    state.model_names.emplace_back(model);
    state.models.push_back(&library.model(model));
    return static_cast<int>(state.models.size()) - 1;
  };
  for (std::size_t i = 0; i < kStyles.size(); ++i) state.light_styles[i] = std::string(kStyles[i]);
  state.light_styles[63] = std::string(1, 'a');
  apply_worldspawn(library.map_entities(), path, session.settings, state);

  view = View{};
  auto parsed = world::parse_entity_lump(library.map_entities(), path);
  if (!parsed.ok()) {  // the library has said so
    view.origin = 0.5f * (state.models[1]->mins + state.models[1]->maxs);
    return ok_status();
  }
  for (const world::Entity& e : *parsed) {
    const std::string_view model = e.text("model");
    if (!model.empty() && model[0] == '*' && scene::shows_brush_model(e))
      state.statics.push_back(at_rest(make_static(e, model_index(model), 0), e, *library.map(), model));
    for (const Torch& torch : kTorches)
      if (e.classname() == torch.classname)
        state.statics.push_back(make_static(e, model_index(torch.model), torch.frame));
    // A switched lamp that starts dark.
    const int style = e.integer("style", 0);
    if (style >= kSwitchableStyles && style < net::kMaxLightStyles && (e.integer("spawnflags", 0) & 1) &&
        e.classname().substr(0, 5) == "light")
      state.light_styles[static_cast<std::size_t>(style)] = std::string(1, 'a');
  }
  place_camera(*parsed, *state.models[1], view);
  return ok_status();
}

}  // namespace fb::cl
