// The renderer's settings. Shaders/shared/settings.h has the rows: the fields here, the console's cvars
// (register_render_cvars) and the laboratory's --set come from them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "console/console.h"
#include "scene/assets.h"
#include "estimators/techniques.h"
#include "shared/settings.h"

// The last step's, which the host alone reads: rows as in Shaders/shared/settings.h.
// clang-format off
#define FB_LAST_STEP_SETTINGS(X) \
  X(int, host_present, "r_host_present", -1, -1, 1, "who scales the picture up to the window's pixels and draws over it: 1 the host, where the device is a CPU, 0 the device; -1: 1 where it can") \
  X(float, taa_scale, "r_taa_scale", -1, -1, 8, "width and height at which the picture is anti-aliased over time, relative to the rendered one's, at most the window's, to which a filter scales it up; 0: the window's; -1: 1 where the device is a CPU, else 0") \
  X(float, sharpness, "r_sharpness", 0.8f, 0, 1, "how sharp the filter is that scales up (C of a cubic with B = 0): 0.5 is Catmull and Rom's")
// clang-format on

#define FB_PICTURE_SETTINGS(X) \
  FB_FRAME_SETTINGS(X)         \
  FB_RENDERER_SETTINGS(X)      \
  FB_LAST_STEP_SETTINGS(X)

// Groups of rows, for manual, panel and menu: G(title, rows, X), X being what is made of each row.
#define FB_SETTING_GROUPS(G, X)                 \
  G("Picture", FB_PICTURE_SETTINGS, X)          \
  G("Denoiser", FB_DENOISER_SETTINGS, X)        \
  G("Emission", FB_EMISSION_SETTINGS, X)        \
  G("Sampling of lights", FB_LIGHT_SETTINGS, X) \
  FB_TECHNIQUE_SETTINGS(G, X)

#define FB_ROWS_OF_GROUP(title, rows, X) rows(X)
#define FB_RENDER_SETTINGS(X) FB_SETTING_GROUPS(FB_ROWS_OF_GROUP, X)

namespace fb::render {

enum class Intersector { kAuto, kQuery, kBvh };
enum class ArrayAccess { kAuto, kBound, kAddress };
enum class Lanes { kAuto, kProcessor, kGpu };

struct RenderSettings {
#define FB_FIELD(type, field, cvar, value, low, high, help) type field = value;
  FB_RENDER_SETTINGS(FB_FIELD)
#undef FB_FIELD
  std::string estimator = "pt";
  Intersector intersector = Intersector::kAuto;
  ArrayAccess arrays = ArrayAccess::kAuto;
  Lanes lanes = Lanes::kAuto;
  bool operator==(const RenderSettings&) const = default;
};

// Copies each setting that a uniform block has a field for; what the block's reader resolves is its own to set after.
template <typename Block>
void copy_settings(const RenderSettings& settings, Block& block) {
#define FB_COPY(type, field, cvar, value, low, high, help) \
  if constexpr (requires { block.field; }) block.field = settings.field;
  FB_RENDER_SETTINGS(FB_COPY)
#undef FB_COPY
}

// Paths of a pixel in a frame, at most: with the denoiser a frame without a past has r_first_spp times as many.
std::uint64_t most_samples(const RenderSettings& settings);

// What emission of each kind is multiplied by (r_emit_*).
using EmissionScales = std::array<float, static_cast<std::size_t>(scene::EmissionKind::kCount)>;
EmissionScales emission_scales(const RenderSettings& settings);

// Registers a cvar for every row, r_estimator, r_intersector, r_arrays and r_lanes.
void register_render_cvars(con::Console& console);
// The rows' cvars in their groups.
struct SettingGroup {
  std::string_view title;
  std::vector<std::string_view> cvars;
};
const std::vector<SettingGroup>& setting_groups();
// The manual's page of all rows and of the debug views, in Markdown.
std::string settings_page();
// The cvars' values now.
RenderSettings read_render_settings(const con::Console& console);
// What the game does where a setting leaves it to the program (-1): the denoiser, local exposure and bloom are on, and
// water is where there is a GPU; where it is not, the picture in a liquid is distorted.
RenderSettings as_in_game(RenderSettings settings, bool on_cpu);

}  // namespace fb::render
