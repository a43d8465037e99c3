// FrameSnapshot: what there is to see this frame, and where all of it was in the previous one. Filled by the client
// (or by a function, for the laboratory's exact cases), read by the renderer. A snapshot needs no map file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/maths.h"
#include "scene/assets.h"
#include "shared/kinds.h"

namespace fb::scene {

struct Camera {
  vec3 position{0.0f};
  vec3 angles{0.0f};    // pitch, yaw, roll in degrees (angle_vectors gives the axes)
  float fov_x = 90.0f;  // degrees, horizontal, of the whole image
  float fov_y = 0.0f;   // degrees, vertical; 0: from fov_x and the image's aspect, square pixels
};

// position = lerp(pose a, pose b, t)
struct PoseBlend {
  std::uint32_t a = 0, b = 0;
  float t = 0.0f;
  bool operator==(const PoseBlend&) const = default;
};

enum Visibility : std::uint32_t {
  kSeenByCamera = shared::kMaskCamera,
  kSeenByIndirect = shared::kMaskIndirect,  // bounces, shadows
  kSeenByAll = shared::kMaskCamera | shared::kMaskIndirect,
};

enum InstanceFlags : std::uint32_t {
  kInstanceAlternate = 1u << 0,  // the materials' alternate frames (entity frame != 0)
  kInstanceColor = 1u << 1,      // `color` and `emission` replace the material's
  kInstanceViewModel = 1u << 2,  // moves with the camera; may be drawn closer to the eye
  kInstanceNew = 1u << 3,        // was not there in the previous frame: its motion means nothing
  kInstanceSpot = 1u << 5,       // shines about its x axis alone: color.x and .y are cosines where it ends and is whole
  kInstanceFallShift = 6,        // three bits, of a spot: its law of distance (shared/spot.h), of the scale color.z
  kInstanceShareTime = 1u << 4,  // animation time is FrameSnapshot::time, not time - time_offset
};

struct Instance {
  std::uint32_t id = 0;    // stable from frame to frame; 0 is the world. Unique in a frame. See InstanceIds.
  std::uint32_t mesh = 0;  // Assets::meshes
  mat4x3 transform{1.0f}, prev_transform{1.0f};  // object to world, affine
  PoseBlend pose, prev_pose;                     // posed meshes only
  std::uint32_t visibility = kSeenByAll;
  std::uint32_t flags = 0;
  std::uint32_t material_base = 0;  // added to each triangle's material
  float alpha = 1.0f;               // coverage of the whole instance
  float time_offset = 0.0f;         // seconds, of groups that start at random
  vec3 color{1.0f};                 // kInstanceColor: linear reflectance
  vec3 emission{0.0f};  // kInstanceColor: radiance factor; else even light of its own, as FrameSnapshot::ambient
};

// Ranges of Instance::id, so that ids of different kinds never meet. An entity with several meshes is not a thing of
// Quake's; a beam has many segments.
enum InstanceIds : std::uint32_t {
  kIdWorld = 0,
  kIdEntity = 1,           // + entity number, up to 65535
  kIdStatic = 0x00010000,  // + index of the static entity
  kIdViewModel = 0x00020000,
  kIdBeam = 0x00030000,          // + beam * 256 + segment
  kIdParticle = 0x00100000,      // + particle's serial number modulo 2^20
  kIdDynamicLight = 0x00200000,  // + slot
  kIdEntityLight = 0x00210000,   // + index of the light
};

enum class SkyMode : std::uint32_t {
  kBlack = shared::kSkyBlack,
  kConstant = shared::kSkyConstant,
  kLayers = shared::kSkyLayers,
  kBox = shared::kSkyBox,
};
struct Sun {
  vec3 direction{0, 0, 1};      // towards the sun, unit
  vec3 irradiance{0.0f};        // on a surface that faces it, linear
  float angular_radius = 1.0f;  // degrees
};
struct Sky {
  SkyMode mode = SkyMode::kBlack;
  vec3 color{0.0f};                            // kConstant: radiance; other modes: factor on the texels
  std::uint32_t solid = kNone, alpha = kNone;  // kLayers: images; `alpha` scrolls twice as fast over `solid`
  std::array<std::uint32_t, 6> box{kNone, kNone, kNone, kNone, kNone, kNone};  // rt bk lf ft up dn
  vec3 even{0.0f};                 // radiance that it has besides for what it lights, not for the camera
  std::vector<Sun> suns;           // seen through surfaces with EmissionKind::kSky only
  bool beyond_everything = false;  // a ray that leaves the scene sees the sky too (else black)
};

// What fills the space between surfaces.
struct Medium {
  float extinction = 0.0f;  // 1/unit; 0: there is none
  vec3 albedo{0.0f};        // share of what it takes from light that it scatters, linear
  float g = 0.0f;           // of Draine's phase function (Shaders/shared/phase.h): -0.999 behind, 0.999 ahead
  float alpha = 0.0f;       // the same: 0 is Henyey and Greenstein's
  float sky = 1.0f;         // share of the sky's light that the camera sees through it
  float before_sky = 1.0f;  // factor on what it scatters to the camera where that sees the sky behind it
  // Quake's fog, where its author has seen it so: the camera sees what is left by a law of the square (1/unit^2,
  // Shaders/shared/medium.h, Haze), no light is lost elsewhere, and besides what it scatters the fog has light of its
  // own: radiance where it hides all, and a factor on it before the sky. 0: none of this.
  float square = 0.0f;
  vec3 glow{0.0f};
  float glow_before_sky = 1.0f;
  bool scatters() const { return extinction > 0.0f; }
};

// How opaque the player wants liquids, of maps that do not say it themselves: a factor on what they absorb and scatter,
// 0 to 1. Of lava and teleporters it is the share of the surface that glows and hides what is below, too.
struct LiquidOpacity {
  float water = 1.0f, slime = 1.0f, lava = 1.0f, teleport = 1.0f;
  bool operator==(const LiquidOpacity&) const = default;
};
float opacity_of(const Material& material, const LiquidOpacity& opacity);  // 1: as the map has it

// Whether a surface is an interface that light passes, into what is behind it: of glass, water or slime, or of what
// glows where the map or the player wants it less than opaque.
bool lets_light_in(const Material& material, const LiquidOpacity& opacity);

// Of such a surface, the share that is opaque and glows; 0: all of it is an interface.
float opaque_share(const Material& material, const LiquidOpacity& opacity);

// The gain field of a map's baked light (authored/gain_field.h): a box of cells, their factors in the texels of an
// image.
struct GainTable {
  std::uint32_t image = kNone;  // kNone: there is none
  vec3 origin{0.0f};
  float side = 1.0f;
  std::uint32_t width = 0, depth = 0, height = 0;
};

// Baked light for the view of it (shared/baked_words.h).
struct BakedTable {
  std::uint32_t image = kNone;  // kNone: there is none
  std::uint32_t faces = 0;
  std::array<float, 64> styles{};  // factors as they are now
};

constexpr std::array<float, 64> all_styles_of_one() {
  std::array<float, 64> styles{};
  styles.fill(1.0f);
  return styles;
}

struct FrameSnapshot {
  std::shared_ptr<const Assets> assets;
  double time = 0.0, prev_time = 0.0;  // seconds: animation, warps, sky
  std::uint64_t frame = 0;             // counts up; restarts never
  bool cut = false;                    // no history: a teleport, a new map, a new demo
  Camera camera, prev_camera;
  std::vector<Instance> instances;  // [0] is the world if there is one
  Sky sky;
  bool authored = false;  // Material::cast and `gains` count
  GainTable gains;
  std::array<float, 64> light_styles = all_styles_of_one();  // factors on light, of Material::cast_style
  BakedTable baked;
  vec3 ambient{0.0f};  // radiance from everywhere: what the camera sees reflects it, unoccluded and only once
  Medium medium;
  LiquidOpacity liquid_opacity;
  std::uint32_t camera_liquid = kNone;            // material (kMaterialDielectric) of the liquid that the camera is in
  bool in_liquid = false, was_in_liquid = false;  // camera, prev_camera: in water, slime or lava
  vec4 screen_tint{0.0f};                         // colour and its weight: damage, pickup, liquid
  vec4 tint_in_liquid{0.0f};  // the same where light is absorbed by camera_liquid itself: not the liquid's
};

}  // namespace fb::scene
