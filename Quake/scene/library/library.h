// ModelLibrary: turns maps, alias models and sprites into meshes and materials of one Assets, each once.
// The client asks it by precache name; it knows no entities.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_data.h"
#include "base/result.h"
#include "formats/bsp.h"
#include "formats/mdl.h"
#include "formats/spr.h"
#include "scene/assets.h"
#include "scene/snapshot.h"

namespace fb::scene {

enum class ModelKind { kMissing, kBrush, kAlias, kSprite };

// What the client must know of a precached model.
// Instance::material_base: 0 for brush models, whose triangles name their materials; for everything else triangles say
// 0, or their surface's number, and material_base is the material itself (a skin's, a sprite image's,
// particle_material() and so on).
struct Model {
  ModelKind kind = ModelKind::kMissing;
  std::string name;
  std::uint32_t mesh = kNone;  // kNone: nothing to draw (missing, a sprite, a brush model of tool textures alone)
  Bounds bounds;               // of the frame-independent model
  std::uint32_t flags = 0;     // MdlFlags (trails, rotation)
  bool random_start = false;   // sync_type
  // Alias: frames and skins. pose_at gives what to blend.
  struct Frame {
    std::string name;
    std::uint32_t first_pose = 0, pose_count = 1;
    std::vector<float> end_times;  // seconds; empty for one pose
  };
  std::vector<Frame> frames;
  std::vector<std::uint32_t> skin_materials;  // a material a skin (its own frames are the group's images)
  std::uint32_t surface_count = 1;  // of a skin's: those of a model's other surfaces follow (enhanced_model.h)
  // Sprite: orientation, and a mesh and material a frame's image group.
  formats::SpriteOrientation orientation = formats::SpriteOrientation::kParallel;
  struct SpriteFrame {
    // A quad in the plane x = 0, facing +x; the image's columns run along +y, its rows down from +z, so that it reads
    // rightly from the side of +x: Instance::transform's columns are (towards the viewer, the viewer's right, up,
    // origin). For Quake's oriented sprites these are (-forward, right, up) of the entity's angles. One mesh an image.
    std::vector<std::uint32_t> meshes;
    std::vector<float> end_times;
    std::uint32_t material = 0;  // of the first image; the k-th has material + k
  };
  std::vector<SpriteFrame> sprite_frames;
  // Brush: the submodel's contents-independent facts.
  vec3 mins{0.0f}, maxs{0.0f};
  bool shadowless = false;  // light tools let light through it, and it gives none (light_sources.h)
  bool glows = false;       // alias: a skin of it does
  vec3 even{0.0f};          // brush: the entity's own even light (_minlight), radiance from everywhere
};

class Lightmaps;
struct LitMap;

// A light from the entity lump, ready to become a sphere.
struct EntityLight {
  vec3 position;
  float radius;      // of the sphere, units
  vec3 power_color;  // radiance of the sphere at style brightness 1 and r_entlights scale 1
  int style;         // lightstyle index
  // A spot's axis, unit, and the cosines of half its cone's angle, where it begins to fade and where it ends; zero: it
  // shines all ways.
  vec3 axis{0.0f};
  // How its light falls off as the author had it (shared/spot.h), and the scale of that law, 1 / units.
  std::uint32_t fall = 0;
  float fall_scale = 0.0f;
  float full_cosine = -1.0f, least_cosine = -1.0f;
};

// An even light from everywhere, which nothing casts a shadow in.
struct AmbientLight {
  vec3 radiance{0.0f};   // 1 shows a texture as it was painted
  bool instead = false;  // the map has nothing that gives light: this is there in its place
};

// How near the player's own data a file is that is there, as fs::FileSystem::game_index_of. A map's .ent and .vis count
// if they rank no lower than the map. Images instead of a model's or map's own count from anywhere (packs of textures
// lie in id1, maps in mods), but for those of the base game (-1): they are drawn for its own models, and would not fit
// others of the same name.
using FileRank = std::function<int(std::string_view path)>;

class ModelLibrary {
 public:
  // Without `rank` all files rank alike.
  explicit ModelLibrary(FileLoader loader, FileRank rank = {});
  // Which files are this project's own; without it none is.
  void set_own_files(std::function<bool(std::string_view path)> own) { own_files_ = std::move(own); }
  // Forgets everything; Assets get a new generation.
  void clear();
  // Whether .md5mesh and .md3 stand in the place of .mdl (enhanced_model.h), of models that are asked for from now on.
  void set_enhanced_models(bool enhanced);
  // What all images together may take, as the device and the host have memory (texel_budget.h); now and for later maps.
  void set_most_texel_bytes(std::uint64_t most);
  // Loads a map: mesh of the world and of every submodel ("*1"...), textures with replacements from textures/
  // (<map>/<name> then <name>; .png .tga .pcx; _luma, _glow, _norm, _gloss), sky, entity lights, suns.
  // External maps/x@<crc>.ent or else x.ent, and x.vis, beside it are used, by their rank. On failure, also for want of
  // memory, nothing changes.
  Status load_map(std::string_view bsp_path);
  const formats::Bsp* map() const;
  const std::string& map_entities() const;
  const std::vector<EntityLight>& entity_lights() const;
  // What the map asks for (lights.h), or, where nothing gives light, what QuakeSpasm shows of a map without lightmaps.
  const AmbientLight& map_ambient() const;
  // The map, its baked light (with its .lit file's) and what light has to do with; for work that goes on beside the
  // library, which may load another map meanwhile. Null without a map; then there is no lit_map.
  std::shared_ptr<const formats::Bsp> shared_map() const;
  std::shared_ptr<const Lightmaps> lightmaps() const;
  LitMap lit_map() const;
  bool of_base_game() const;  // the map is this project's own
  // Material::cast and cast_fall of a material, and words for shaders as an image of their own (ImageEncoding::kWords).
  void set_cast(std::uint32_t material, const vec3& cast, float fall = 0.0f, int style = 0);
  // Submodels, ascending, that cast no shadow where authors' light counts, besides those that never move; what glows
  // among them gives no light of its own then.
  void let_light_through(const std::vector<std::uint32_t>& submodels);
  std::uint32_t add_words(const std::vector<std::uint32_t>& words);
  const Sky& map_sky() const;  // layers or black, suns; the client overrides by svc_skybox / "sky" key
  Sky make_skybox(std::string_view name, const Sky& fallback);  // gfx/env/<name>{rt,bk,lf,ft,up,dn}.{png,tga,pcx}

  // By precache name: "maps/x.bsp" (the loaded map or an item box such as maps/b_bh25.bsp), "*3", "progs/ogre.mdl",
  // "progs/s_explod.spr". Missing or malformed: a Model of kind kMissing after one logged sentence.
  const Model& model(std::string_view name);
  // A player's skin with translated colours (top, bottom rows 0..13 of the palette).
  std::uint32_t translated_skin(const Model& model, std::uint32_t skin, int top, int bottom);

  // Meshes that need no file, made once: sphere of radius 1 (80 triangles) for lights, a tetrahedron of circumradius 1
  // for particles, each with one material that takes its colour from the instance.
  std::uint32_t sphere_mesh();
  std::uint32_t tetrahedron_mesh();
  std::uint32_t particle_material();
  std::uint32_t dynamic_light_material();
  std::uint32_t entity_light_material();

  std::shared_ptr<const Assets> assets() const;

 private:
  Status load_map_file(std::string_view bsp_path);
  struct Impl;
  std::shared_ptr<Impl> impl_;
  std::function<bool(std::string_view path)> own_files_;
};

// The poses to blend for an alias frame: a group's poses play in a loop by their end times.
std::uint32_t pose_at(const Model& model, std::uint32_t frame, double time);

}  // namespace fb::scene
