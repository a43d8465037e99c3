// The player's eyes: where they are, how they sway, and what colours the picture (Quake's view.c with QuakeSpasm's
// additions). Works on the session alone; the world is asked only for what the eye stands in.
#pragma once

#include "client/session/session.h"
#include "formats/bsp.h"

namespace fb::cl {

struct View {
  vec3 origin{0.0f}, angles{0.0f};
  bool show_weapon = false;                       // the weapon in hand is there to be drawn
  vec3 weapon_origin{0.0f}, weapon_angles{0.0f};  // angles as an entity's: pitch is negated
  vec4 tint{0.0f};                                // sRGB colour 0..1 and its weight
  vec4 tint_without_contents{0.0f};               // the same without what the eyes are in
};

// What view.cpp remembers from frame to frame.
struct ViewMemory {
  float stair_height = 0.0f;  // z that the eye has climbed to
  vec3 punch{0.0f};           // v_gunkick 2
  bool fresh = true;          // nothing remembered yet
};

// The view at state.time. `seconds` have gone by since the last; map: the world, or null.
View calculate_view(Session& session, ViewMemory& memory, const formats::Bsp* map, double seconds);

// Horizontal field of view in degrees of a picture of this size (QuakeSpasm's Hor+ adaptation of a 4:3 angle).
float adapted_fov(float fov, bool adapt, int width, int height);

// Parts of it, for tests: degrees of roll; units of bob.
float calculate_roll(const Settings& settings, const vec3& angles, const vec3& velocity);
float calculate_bob(const Settings& settings, const vec3& velocity, double time);
// Colour and weight of all shifts together; of all but that of contents.
vec4 blend_shifts(const ClientState& state, const Settings& settings, bool contents = true);

}  // namespace fb::cl
