#include "render/passes/settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/passes/debug_views.h"

namespace fb::render {
namespace {

constexpr float kLocalExposure = 0.35f, kBloom = 0.04f;  // in the game

con::CvarSpec number_spec(const char* group, const char* name, float value, float low, float high, bool integer,
                          const char* help) {
  con::CvarSpec spec;
  spec.name = name;
  spec.group = group;
  spec.default_value = con::number_text(value);
  spec.help = help;
  spec.flags = con::kCvarArchive;
  spec.min = low;
  spec.max = high;
  spec.integer = integer;
  if (spec.name == "r_debug")
    for (const DebugView& view : debug_views()) spec.words.emplace_back(view.name, static_cast<float>(view.number));
  return spec;
}

template <typename T>
T read_number(const con::Console& console, std::string_view name) {
  if constexpr (std::is_same_v<T, int>)
    return console.cvar(name).integer();
  else
    return console.cvar(name).value();
}

}  // namespace

void register_render_cvars(con::Console& console) {
  const char* group = "";
#define FB_REGISTER(type, field, cvar, value, low, high, help)                                  \
  console.add_cvar(number_spec(group, cvar, static_cast<float>(value), static_cast<float>(low), \
                               static_cast<float>(high), std::is_same_v<type, int>, help));
#define FB_REGISTER_GROUP(title, rows, X) \
  group = title;                          \
  rows(X)
  FB_SETTING_GROUPS(FB_REGISTER_GROUP, FB_REGISTER)
#undef FB_REGISTER_GROUP
#undef FB_REGISTER
  console.add_cvar("r_estimator", "mcpg_nee", "light transport estimator, one of: fullbright-lab estimators",
                   con::kCvarArchive);
  console.add_cvar("r_intersector", "auto",
                   "how rays are traced: query (VK_KHR_ray_query), bvh (traversal in the shader), auto (the faster "
                   "one, measured at the start where there are both); takes effect at the next start",
                   con::kCvarArchive);
  console.add_cvar("r_arrays", "auto",
                   "how shaders reach the scene's arrays: bound (descriptors), address (device addresses), auto (the "
                   "faster one for the driver); takes effect at the next start",
                   con::kCvarArchive);
  console.add_cvar(
      "r_lanes", "auto",
      "what shaders are written for: processor (branches and words fetched are dear), gpu (registers and code "
      "are), auto (as the device is); takes effect at the next start",
      con::kCvarArchive);
}

const std::vector<SettingGroup>& setting_groups() {
#define FB_NAME(type, field, cvar, value, low, high, help) cvar,
#define FB_GROUP(title, rows, X) {title, {rows(X)}},
  static const std::vector<SettingGroup> groups = {FB_SETTING_GROUPS(FB_GROUP, FB_NAME)};
#undef FB_GROUP
#undef FB_NAME
  return groups;
}

RenderSettings read_render_settings(const con::Console& console) {
  RenderSettings settings;
#define FB_READ(type, field, cvar, value, low, high, help) settings.field = read_number<type>(console, cvar);
  FB_RENDER_SETTINGS(FB_READ)
#undef FB_READ
  settings.estimator = console.cvar("r_estimator").string();
  const std::string& intersector = console.cvar("r_intersector").string();
  settings.intersector = intersector == "query" ? Intersector::kQuery
                         : intersector == "bvh" ? Intersector::kBvh
                                                : Intersector::kAuto;
  const std::string& arrays = console.cvar("r_arrays").string();
  settings.arrays = arrays == "bound"     ? ArrayAccess::kBound
                    : arrays == "address" ? ArrayAccess::kAddress
                                          : ArrayAccess::kAuto;
  const std::string& lanes = console.cvar("r_lanes").string();
  settings.lanes = lanes == "processor" ? Lanes::kProcessor : lanes == "gpu" ? Lanes::kGpu : Lanes::kAuto;
  return settings;
}

RenderSettings as_in_game(RenderSettings settings, bool on_cpu) {
  if (settings.denoise < 0) settings.denoise = 1;
  if (settings.local_exposure < 0) settings.local_exposure = kLocalExposure;
  if (settings.bloom < 0) settings.bloom = kBloom;
  if (settings.water < 0) settings.water = on_cpu ? 0 : 1;
  if (settings.water_warp < 0) settings.water_warp = settings.water > 0 ? 0 : 1;
  return settings;
}

std::uint64_t most_samples(const RenderSettings& settings) {
  const int first = settings.denoise > 0 ? std::max(settings.first_spp, 1) : 1;
  return static_cast<std::uint64_t>(std::max(settings.spp, 1)) * static_cast<std::uint64_t>(first);
}

EmissionScales emission_scales(const RenderSettings& s) {
  using Kind = scene::EmissionKind;
  EmissionScales scales{};
  const auto set = [&](Kind kind, float value) { scales[static_cast<std::size_t>(kind)] = value; };
  set(Kind::kFullbright, s.emit_fullbright);
  set(Kind::kLava, s.emit_lava);
  set(Kind::kSlime, s.emit_slime);
  set(Kind::kTeleport, s.emit_teleport);
  set(Kind::kSky, s.emit_sky);
  set(Kind::kSprite, s.emit_sprite);
  set(Kind::kParticle, s.emit_particle);
  set(Kind::kDynamicLight, s.emit_dlight);
  set(Kind::kEntityLight, s.emit_entlight);
  set(Kind::kConstant, 1.0f);
  return scales;
}

}  // namespace fb::render
