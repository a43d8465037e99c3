// What the client knows: the server's last words, and what has been made of them for the present moment. Plain data;
// parse.cpp writes what messages say, interpolate.cpp moves it in time, snapshot_builder.cpp reads it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "client/session/hud.h"
#include "client/session/items.h"
#include "net/server_messages.h"
#include "scene/library/library.h"

namespace fb::cl {

// How an entity's movement and animation are smoothed (QuakeSpasm's LERP_*).
enum LerpFlags : std::uint32_t {
  kLerpMoveStep = 1u << 0,    // moves in steps of a tenth of a second: placed by place_entity, not by relink
  kLerpResetAnim = 1u << 1,   // show the next pose at once
  kLerpResetAnim2 = 1u << 2,  // and the one after it too
  kLerpResetMove = 1u << 3,   // stand at the next place at once
  kLerpFinish = 1u << 4,      // lerp_finish says when the next step comes
};

enum EntityEffects : int {
  kEffectBrightField = 1,
  kEffectMuzzleFlash = 2,
  kEffectBrightLight = 4,
  kEffectDimLight = 8,
  kEffectQuadLight = 16,
  kEffectPentaLight = 32,
};

struct Entity {
  net::EntityState baseline;
  // From the last message.
  int model = 0;  // precache index, 0 none
  int frame = 0, colormap = 0, skin = 0, effects = 0;
  int alpha = net::kAlphaDefault, scale = net::kScaleDefault;
  double message_time = -1.0;
  std::array<vec3, 2> message_origins{}, message_angles{};  // [0] the latest
  bool force_link = false;                                  // no place before the latest: go there at once
  float sync_base = 0.0f;                                   // seconds: groups that start at random
  double lerp_finish = 0.0;
  std::uint32_t lerp_flags = 0;
  // Between messages.
  vec3 origin{0.0f}, angles{0.0f};
  std::uint64_t cut_frame = 0;  // the last advance() in which it jumped or appeared: no motion then
  // Animation: from one pose to the next since pose_start.
  std::uint32_t previous_pose = 0, current_pose = 0;
  double pose_start = 0.0, pose_interval = 0.1;
  // Steps: from one place to the next since move_start.
  vec3 previous_origin{0.0f}, current_origin{0.0f}, previous_angles{0.0f}, current_angles{0.0f};
  double move_start = 0.0;
  // What is drawn: set once an advance().
  vec3 drawn_origin{0.0f}, drawn_angles{0.0f};
  scene::PoseBlend drawn_pose;
  bool visible = false;
};

// A colour over the whole picture.
struct ColorShift {
  vec3 color{0.0f};  // 0..255
  float percent = 0.0f;
};
enum ColorShiftKind { kShiftContents, kShiftDamage, kShiftBonus, kShiftPowerup, kShiftCount };

struct FogState {
  Fog now, before;
  double fade_seconds = 0.0, fade_done = 0.0;
};

constexpr int kSignons = 4;  // signon stages until the first entity update

struct ClientState {
  net::Protocol protocol;
  bool have_server_info = false;
  int signon = 0;
  Hud hud;
  std::vector<std::string> model_names, sound_names;  // [0] is empty
  std::vector<const scene::Model*> models;            // beside model_names; null: nothing is known of it
  std::vector<std::string> late_precaches;            // what was stuffed of those that the level did not begin with

  double time = 0.0, old_time = 0.0;
  std::array<double, 2> message_times{};  // [0] the latest

  int view_entity = 0;
  int view_height = net::kDefaultViewHeight, ideal_pitch = 0;
  vec3 view_angles{0.0f};
  std::array<vec3, 2> message_view_angles{};
  vec3 velocity{0.0f};
  std::array<vec3, 2> message_velocities{};
  vec3 punch{0.0f};
  std::array<vec3, 2> punches{};  // [0] the latest value, [1] the one before it
  bool on_ground = false, in_water = false, on_elevator = false;

  std::vector<Entity> entities;  // by number; [0] is the world
  std::vector<Entity> statics;
  Entity view_model;

  std::array<std::string, net::kMaxLightStyles> light_styles;
  std::optional<std::string> skybox;  // svc_skybox or the "sky" key; empty: the map's own sky
  bool sky_changed = true;
  FogState fog;
  SkyFog sky_fog;
  MusicTracks music;
  std::array<ColorShift, kShiftCount> shifts{};
  ColorShift empty_shift{vec3(130, 80, 50), 0.0f};  // v_cshift's: what contents make when there are none
  // Kicks of damage, applied and decayed by view.cpp.
  float damage_time = 0.0f, damage_roll = 0.0f, damage_pitch = 0.0f;
  float jolt = 0.0f;  // the hardest of damage and recoil since it was asked for, 0 to 1

  const scene::Model* model(int index) const {
    return index > 0 && static_cast<std::size_t>(index) < models.size() ? models[static_cast<std::size_t>(index)]
                                                                        : nullptr;
  }
  // The entity of the player's eyes; null before it is known.
  Entity* view_entity_state() {
    return view_entity >= 0 && static_cast<std::size_t>(view_entity) < entities.size()
               ? &entities[static_cast<std::size_t>(view_entity)]
               : nullptr;
  }
};

// The brightness of a light style: letters change ten times a second, 'm' is 1, 'a' 0; an unset style is 1.
float light_style_value(const std::string& pattern, double time);

// Fog at a moment, fading from the fog before.
Fog fog_at(const FogState& fog, double time);
void change_fog(FogState& fog, const Fog& to, double fade_seconds, double time);

}  // namespace fb::cl
