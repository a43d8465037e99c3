// Light entities as spheres, _surface lights as glowing textures, suns, and even light: from the entity lump as id's
// light and ericw-tools' light read it to the units of this renderer.
//
// Units. In Quake a lightmap value of 128 shows a texture as it was painted, and a light of value L makes the value
// L - d at distance d, facing it (wait 1, delay 0). Here a surface shows irradiance / pi * albedo, so a value v
// corresponds to irradiance / pi = v / 128. A sphere of radius r and radiance R gives R r^2 / d^2 of it. Physical
// falloff is not linear, so the two are made equal at one distance, where Quake's light has fallen to half:
//
//   delay 0 (L - wait d), at d = L / (2 wait):     R r^2 = L / 256 * (L / (2 wait))^2       [L = 300: r = 8: R = 412]
//   delay 1 (L * 128 / (wait d)), at d = 128/wait: R r^2 = L * 128 / wait^2
//   delay 2 (L * (128 / (wait d))^2), everywhere:  R r^2 = L * 128 / wait^2
//   delay 3 (no falloff), at d = 128:              R r^2 = L * 128
//   delay 4 (a minimum, not a light): dropped
//   delay 5 (L * (128 / (wait d + 128))^2), at d = 128/wait: R r^2 = L * 32 / wait^2
//
// _falloff F of a linear light is wait L / F; the world's _dist is a factor on all waits, its _range / 0.5 on all
// values.
//
// Where authored light counts, lamps keep their own law of distance instead (set_fall).
//
// Colours are what a white wall shows on screen, so they are taken as sRGB. A spot (mangle or target) is as bright as
// another light within its cone, 40 degrees unless angle says otherwise, and dark beyond it. Lights of negative value
// darken in Quake; they give none here, but what they took from baked light is known (darkening_lights).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/bsp.h"
#include "scene/library/library.h"
#include "scene/snapshot.h"
#include "world/entity_lump.h"

namespace fb::scene {

constexpr float kLightRadius = 8.0f;     // of the spheres, units, where there is room
constexpr float kMinLightRadius = 1.0f;  // in narrow places; the radiance then grows to keep the power

// R r^2 of the table above for one light (radiance times units^2); 0 for what gives no light.
float light_strength(float value, float wait, int delay);

// The same light's own law of distance (shared/spot.h), which authored light keeps: equal to the square's at the
// distances above.
void set_fall(EntityLight& light, float value, float wait, int delay);

// Spheres of all entities whose class begins with "light". Their centres are moved off walls by up to the radius, and
// a light inside of something solid is moved out of it, or dropped when there is no open space within 24 units.
std::vector<EntityLight> entity_lights(const std::vector<world::Entity>& entities, const formats::Bsp& bsp);
// The same of lights of negative value, which take light away in the tools: as if they gave it.
std::vector<EntityLight> darkening_lights(const std::vector<world::Entity>& entities, const formats::Bsp& bsp);

// Radiance by lower-case texture name that _surface lights give: ericw-tools puts a light on every 128 x 128 units of
// such faces; here the faces glow, with the same power over their area. Those that are off when the map begins
// (spawnflags 1 with a targetname) follow their style, where the tools have given them one that is switched (32 and
// up) and no other lights the texture; else they give none.
struct SurfaceLight {
  vec3 radiance{0.0f};
  int style = 0;            // of the last of a texture's lights
  float fall_scale = 0.0f;  // of its linear law of distance, 1 / units; 0: it has another
  bool switched = false;    // off when the map begins
};
using SurfaceLights = std::map<std::string, SurfaceLight>;
SurfaceLights surface_lights(const std::vector<world::Entity>& entities, const formats::Bsp& bsp);

// _sunlight (with _sun_mangle, _sunlight_mangle, _sun_angle or the same without underscore; _sunlight_color;
// _sunlight_penumbra, _anglescale), _sun2 (_sun2_mangle, _sun2_color), and light entities with "_sun" "1". Irradiance
// is pi * value / 128 on a surface that faces the sun.
std::vector<Sun> suns(const std::vector<world::Entity>& entities);

// _sunlight2 (a dome of light, from everywhere above; _sunlight2_color or _sunlight_color2) and light entities with
// "_sunlight2" "1": the mean radiance that the sky should have, value / 128; 0 without them. _sunlight3 is the same
// from below: where the map has skies there, what is more of both counts, since our sky is one.
vec3 dome_radiance(const std::vector<world::Entity>& entities, bool sky_below);
float white_dome_radiance(const std::vector<world::Entity>& entities);  // of the world's _sunlight2 without its colour

// _minlight or light of the worldspawn (_minlight_color, _mincolor): radiance from everywhere; zero without the keys.
// The tools' lightmaps hold half of the value (of _minlight 22, 11), which shows a white wall at value / 256 on screen
// and as light is much less (sRGB): 20 is 0.007. To the tools it is a minimum; here it comes on top, as light adds up.
vec3 ambient_radiance(const std::vector<world::Entity>& entities);
// The same of _minlight of any entity.
vec3 minimum_light(const world::Entity& entity);

}  // namespace fb::scene
