// What a scene is made of and what outlives a frame: images, materials, meshes. The renderer uploads what is new when
// it sees a larger count, and everything anew when it sees another `generation`. Nothing here knows Vulkan or edicts.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "formats/image.h"
#include "shared/kinds.h"

namespace fb::formats {
struct Bsp;
}

namespace fb::scene {

constexpr std::uint32_t kNone = 0xffffffffu;

enum class ImageEncoding : std::uint8_t {
  kPalette = shared::kEncodingPalette,
  kSrgba = shared::kEncodingSrgba,
  kLinearRgba = shared::kEncodingLinear,
  kLinearGray = shared::kEncodingGray,
  kWords = shared::kEncodingWords,
};
constexpr std::size_t texel_bytes(ImageEncoding encoding) {
  return encoding == ImageEncoding::kPalette || encoding == ImageEncoding::kLinearGray ? 1 : 4;
}
struct Image {
  std::string name;
  ImageEncoding encoding = ImageEncoding::kPalette;
  int width = 0, height = 0;
  std::vector<std::uint8_t> texels;  // row-major, top first
};

// What makes a material's light; each kind is scaled by a cvar of its own in the renderer (r_emit_*).
// Shaders/shared/kinds.h says what each is.
enum class EmissionKind : std::uint32_t {
  kNone = shared::kEmissionNone,
  kFullbright = shared::kEmissionFullbright,
  kLava = shared::kEmissionLava,
  kSlime = shared::kEmissionSlime,
  kTeleport = shared::kEmissionTeleport,
  kSky = shared::kEmissionSky,
  kSprite = shared::kEmissionSprite,
  kParticle = shared::kEmissionParticle,
  kDynamicLight = shared::kEmissionDynamicLight,
  kEntityLight = shared::kEmissionEntityLight,
  kConstant = shared::kEmissionConstant,
  kCount = shared::kEmissionKinds,
};

// What r_emit_* are unless somebody sets them (Shaders/shared/settings.h; a test holds them equal).
constexpr float usual_emission(EmissionKind kind) {
  switch (kind) {
    case EmissionKind::kFullbright:
      return 6.0f;
    case EmissionKind::kLava:
    case EmissionKind::kSprite:
      return 8.0f;
    case EmissionKind::kTeleport:
      return 4.0f;
    default:
      return 1.0f;
  }
}

// By which of the player's opacities (FrameSnapshot::liquid_opacity) what fills a liquid is multiplied: by one where
// its map says nothing of it. kLava, kTeleport: the surface's as well, and below 1 only is it an interface.
enum class OpacityFrom : std::uint32_t { kItself, kWater, kSlime, kLava, kTeleport };

enum MaterialFlags : std::uint32_t {
  kMaterialAlphaTest = shared::kMaterialAlphaTest,
  kMaterialWarp = shared::kMaterialWarp,
  kMaterialLiquid = shared::kMaterialLiquid,
  kMaterialNoFullbright = shared::kMaterialNoFullbright,
  kMaterialClampTexture = shared::kMaterialClampTexture,
  kMaterialDielectric = shared::kMaterialDielectric,
};

// One texture of a material: base image and the images that go with it; kNone where absent.
struct TextureSet {
  std::uint32_t base = kNone;
  std::uint32_t luma = kNone;    // emission, sRGB; black is dark
  std::uint32_t normal = kNone;  // tangent space, linear
  std::uint32_t gloss = kNone;   // linear: red = gloss (1 - roughness)
};

struct Material {
  std::string name;
  // The frames of an animated texture, played at `frames_per_second`; alternate_frames (`+a..+j`) when the entity's
  // frame is not 0 (empty: same as frames). A plain texture has one. Empty `frames`: base_color alone.
  std::vector<TextureSet> frames;
  std::vector<TextureSet> alternate_frames;
  float frames_per_second = 5.0f;  // groups of skins and sprites have their own: end_times, then this is ignored
  std::vector<float> end_times;    // seconds, ascending, one a frame; empty: frames_per_second
  vec3 base_color{1.0f};           // linear reflectance factor, multiplies the texture
  vec3 emission{0.0f};             // kConstant: radiance; other kinds: factor on the texel's colour, usually 1
  EmissionKind emission_kind = EmissionKind::kFullbright;
  vec3 cast{1.0f};  // factor on what it lights: what its map's author saw it light (FrameSnapshot::authored); then it
                    // looks as painted
  int cast_style = 0;      // light style of that light (FrameSnapshot::light_styles)
  bool switched = false;   // it glows as that style has it, authored or not, and looks so
  float cast_fall = 0.0f;  // of that light, the scale of its linear law of distance (shared/spot.h), 1 / units; 0: none
  float roughness = 1.0f;  // GGX alpha = roughness^2; 1 with specular 0 is plain Lambert
  float specular = 0.0f;   // F0 of the dielectric coat: 0 none, 0.04 usual
  bool gloss_by_name =
      false;               // roughness and specular are what a texture's name suggests: not where authors' light counts
  float metalness = 0.0f;  // base_color becomes F0 as this goes to 1
  float alpha = 1.0f;      // coverage
  float index = 1.33f;     // kMaterialDielectric: of refraction, of what is behind the surface; water's
  vec3 absorption{0.0f};   // kMaterialDielectric: of the same, 1/unit
  float scattering = 0.0f;  // kMaterialDielectric: likewise what it scatters; with absorption this is extinction
  OpacityFrom opacity_from = OpacityFrom::kItself;  // kMaterialDielectric (snapshot.h, lets_light_in): of both
  std::uint32_t flags = 0;                          // MaterialFlags
};
// Which of a material's frames shows at a time. The one place that knows how Quake's textures animate.
const TextureSet& texture_at(const Material& material, double time, bool alternate);

// A vertex of a pose: position = pose_numbers * Mesh::pose_scale + Mesh::pose_origin; normal in octahedral coordinates,
// signed 16-bit normalised. 8 bytes; uploaded as it is.
struct PoseVertex {
  std::uint32_t position;  // x, y, z as shared::pack_pose_position has them
  std::int16_t normal_u, normal_v;
};
static_assert(sizeof(PoseVertex) == 8);

struct MeshTriangle {
  std::array<std::uint32_t, 3> vertices;
  std::uint32_t material;  // added to Instance::material_base
  std::array<vec2, 3> uv;  // in units of the texture's size: 1 is one repeat
  std::uint32_t liquid_in_front =
      0;                       // 1, kMaterialDielectric: the liquid is on the side that the triangle faces, not behind
  std::uint32_t face = kNone;  // of the map, formats::Bsp::faces
};
static_assert(sizeof(MeshTriangle) == 48, "hashed as bytes: no padding");

// Triangles face the side from which their vertices run counter-clockwise (right-handed coordinates).
// A rigid mesh has `positions` (and optionally `normals`); a posed one has `poses` instead: the renderer interpolates
// two of them on the device, and refits the mesh's tree.
struct Mesh {
  std::string name;
  std::vector<MeshTriangle> triangles;
  std::uint32_t vertex_count = 0;
  std::vector<vec3> positions;    // vertex_count, rigid only
  std::vector<vec3> normals;      // vertex_count or empty: flat
  std::vector<PoseVertex> poses;  // pose_count * vertex_count, pose-major
  std::uint32_t pose_count = 0;
  vec3 pose_scale{1.0f}, pose_origin{0.0f};
  Bounds bounds;  // of all poses
  bool posed() const { return pose_count > 0; }
};

struct Assets {
  std::uint64_t generation = 1;  // changes when indices lose their meaning (a new map)
  formats::Palette palette;
  std::vector<Image> images;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::shared_ptr<const formats::Bsp> map;  // whose tree divides the space about the world's mesh; null: nothing does
};

// A number no other Assets of this process has had as its generation.
std::uint64_t next_generation();

// Octahedral coding of a unit vector (Cigolle 2014), as Shaders/shared/packing.h has it.
// Whole numbers up to shared::kMostPoseX, Y and Z.
PoseVertex make_pose_vertex(std::uint32_t x, std::uint32_t y, std::uint32_t z, const vec3& normal);
vec3 pose_numbers(const PoseVertex& vertex);

}  // namespace fb::scene
