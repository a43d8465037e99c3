#include "scene/library/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <new>
#include <tuple>
#include <utility>
#include <system_error>

#include "base/check.h"
#include "base/log.h"
#include "base/out_of_memory.h"
#include "base/text_mark.h"
#include "scene/animation.h"
#include "scene/library/alias_mesh.h"
#include "scene/library/asset_builder.h"
#include "scene/library/brush_mesh.h"
#include "scene/library/enhanced_model.h"
#include "scene/library/light_sources.h"
#include "scene/library/lightmaps.h"
#include "scene/library/lights.h"
#include "scene/library/lit_map.h"
#include "scene/library/map_materials.h"
#include "scene/library/sky_images.h"
#include "scene/library/sprite_mesh.h"
#include "scene/shapes.h"
#include "world/entity_lump.h"

namespace fb::scene {
namespace {

std::string with_extension(std::string_view path, std::string_view extension) {
  return std::string(path.substr(0, path.find_last_of('.'))) + std::string(extension);
}

bool lies_within(const Bounds& bounds, float limit) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(bounds.min[axis] > -limit && bounds.max[axis] < limit)) return false;
  return true;
}

void log_all(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) log_warning("{}", warning);
}

LiquidAlphas liquid_alphas(const std::vector<world::Entity>& entities) {
  LiquidAlphas alphas;
  if (entities.empty()) return alphas;
  const auto read = [&](std::string_view key, std::optional<float>& value) {
    const world::Entity& world = entities.front();
    const float read = world.number(fmt::format("_{}", key), world.number(key, 0.0f));
    if (read > 0.0f) value = std::min(read, 1.0f);  // QuakeSpasm takes 0 for "not said"
  };
  read("wateralpha", alphas.water);
  read("lavaalpha", alphas.lava);
  read("slimealpha", alphas.slime);
  read("telealpha", alphas.teleport);
  return alphas;
}

Model brush_model(const formats::Bsp& bsp, std::uint32_t index, std::string name, std::uint32_t mesh) {
  Model model;
  model.kind = ModelKind::kBrush;
  model.name = std::move(name);
  model.mesh = mesh;
  model.mins = bsp.models[index].mins;
  model.maxs = bsp.models[index].maxs;
  model.bounds.min = model.mins;
  model.bounds.max = model.maxs;
  return model;
}

std::uint32_t add_brush_mesh(AssetBuilder& builder, const formats::Bsp& bsp, std::uint32_t index,
                             MapMaterials& materials, const std::string& name) {
  Mesh mesh = make_brush_mesh(bsp, index, materials, name);
  return mesh.triangles.empty() ? kNone : builder.add_mesh(std::move(mesh));
}

Model alias_model(AssetBuilder& builder, const formats::Mdl& mdl, const std::string& name) {
  Model model;
  model.kind = ModelKind::kAlias;
  model.name = name;
  Mesh mesh = make_alias_mesh(mdl, name);
  model.bounds = mesh.bounds;
  if (!lies_within(mesh.bounds, formats::kMaxBspCoordinate)) {
    log_warning("{}: its scale and origin put vertices more than {} units away", name, formats::kMaxBspCoordinate);
    return {};
  }
  if (!mesh.triangles.empty()) model.mesh = builder.add_mesh(std::move(mesh));
  model.flags = mdl.flags;
  model.random_start = mdl.sync_type == 1;
  for (const formats::MdlFrame& frame : mdl.frames)
    model.frames.push_back({frame.name, frame.first_pose, frame.pose_count, frame.end_times});
  model.skin_materials = make_skin_materials(builder, mdl, name);
  return model;
}

Model sprite_model(AssetBuilder& builder, const formats::Spr& spr, const std::string& name) {
  Model model;
  model.kind = ModelKind::kSprite;
  model.name = name;
  model.orientation = spr.orientation;
  model.random_start = spr.sync_type == 1;
  model.sprite_frames = make_sprite_frames(builder, spr, name);
  const float width = 0.5f * static_cast<float>(spr.max_width), height = 0.5f * static_cast<float>(spr.max_height);
  model.bounds.min = vec3(-width, -width, -height);
  model.bounds.max = vec3(width, width, height);
  return model;
}

}  // namespace

struct ModelLibrary::Impl {
  FileLoader loader;
  FileRank rank;
  std::uint64_t most_texel_bytes;
  bool enhanced = true;
  std::unique_ptr<AssetBuilder> builder;
  std::map<std::string, Model, std::less<>> models;
  std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> translated;

  std::string map_path;
  std::shared_ptr<formats::Bsp> map;
  std::vector<std::uint32_t> map_meshes;  // a submodel; kNone: nothing to draw
  std::vector<EntityLight> lights, darkening;
  AmbientLight ambient;
  Sky sky;
  std::vector<std::uint32_t> map_materials;  // of the map's textures
  std::vector<SurfaceLight> texture_lights;  // that its _surface lights give
  std::shared_ptr<const Lightmaps> lightmaps;
  std::vector<Submodel> submodels;         // that entities show
  std::vector<std::uint32_t> unshadowed;   // light_sources.h
  std::vector<std::uint32_t> lit_through;  // let_light_through
  std::map<std::uint32_t, vec3> even;      // likewise

  std::uint32_t sphere = kNone, tetrahedron = kNone;
  std::uint32_t particle = kNone, dynamic_light = kNone, entity_light = kNone;

  Impl(FileLoader file_loader, FileRank file_rank, std::uint64_t most)
      : loader(std::move(file_loader)), rank(std::move(file_rank)), most_texel_bytes(most) {
    builder = std::make_unique<AssetBuilder>(loader, rank, most_texel_bytes);
  }

  void take_map(const std::string& path, formats::Bsp bsp, const std::vector<world::Entity>& entities,
                const std::optional<FileData>& lit_file, bool of_base_game);
  LitMap lit_map() const;
  void forget_map();
  Model load_model(const std::string& name);
  bool glows(std::uint32_t mesh) const;
  Model load_submodel(const std::string& name);
  Model with_glow(Model model) const;
  std::uint32_t instance_colored(std::uint32_t& index, const char* name, EmissionKind kind);
};

ModelLibrary::ModelLibrary(FileLoader loader, FileRank rank)
    : impl_(std::make_shared<Impl>(std::move(loader), std::move(rank), kUsualTexelBytes)) {}

void ModelLibrary::clear() {
  const bool enhanced = impl_->enhanced;
  *impl_ = Impl(impl_->loader, impl_->rank, impl_->most_texel_bytes);
  impl_->enhanced = enhanced;
}

void ModelLibrary::set_enhanced_models(bool enhanced) { impl_->enhanced = enhanced; }

void ModelLibrary::set_most_texel_bytes(std::uint64_t most) {
  impl_->most_texel_bytes = most;
  impl_->builder->set_most_texel_bytes(most);
}

Status ModelLibrary::load_map(std::string_view bsp_path) {
  return within_memory([&] { return load_map_file(bsp_path); });
}

Status ModelLibrary::load_map_file(std::string_view bsp_path) {
  const std::string path(bsp_path), map_name(stem_of(bsp_path));
  const auto load = [&](const std::string& file) { return impl_->loader ? impl_->loader(file) : std::nullopt; };
  const auto load_beside = [&](const std::string& file) {
    return impl_->rank && impl_->rank(file) < impl_->rank(path) ? std::nullopt : load(file);
  };
  const std::optional<FileData> bytes = load(path);
  if (!bytes) return Error{path + ": no such file"};
  auto bsp = formats::parse_bsp(*bytes, path);
  if (!bsp) return bsp.error();
  if (bsp->models.empty()) return Error{path + ": a map without models"};
  log_all(bsp->warnings);

  const std::string vis_path = with_extension(path, ".vis");
  if (const std::optional<FileData> vis = load_beside(vis_path)) {
    auto record = formats::parse_vis(*vis, vis_path, map_name + ".bsp", *bsp);
    if (!record) {
      log_warning("{}", record.error().message);
    } else if (*record) {
      bsp->visibility = std::move((*record)->visibility);
      bsp->leafs = std::move((*record)->leafs);
    }
  }
  std::string entities_name = path;
  for (const std::string& ent_path :
       {with_extension(path, fmt::format("@{:04x}.ent", bsp->entities_crc)), with_extension(path, ".ent")}) {
    const std::optional<FileData> ent = load_beside(ent_path);
    if (!ent) continue;
    if (const Status fits = formats::check_entity_text(ent->size(), ent_path); !fits) {
      log_warning("{}", fits.error().message);
      continue;
    }
    bsp->entities = without_byte_order_mark(ent->text());
    entities_name = ent_path;
    break;
  }
  std::vector<world::Entity> entities;
  if (auto parsed = world::parse_entity_lump(bsp->entities, entities_name))
    entities = std::move(*parsed);
  else
    log_warning("{}; the map's entities count for nothing", parsed.error().message);

  // Nothing can fail from here on but for want of memory. The former map stays whole until this one is.
  const auto fresh = impl_->map ? std::make_unique<Impl>(impl_->loader, impl_->rank, impl_->most_texel_bytes) : nullptr;
  Impl& impl = fresh ? *fresh : *impl_;
  std::erase_if(impl.models, [](const auto& entry) { return entry.second.kind == ModelKind::kMissing; });
  try {
    impl.take_map(path, std::move(*bsp), entities, load_beside(with_extension(path, ".lit")),
                  own_files_ && own_files_(path));
  } catch (const std::bad_alloc& failure) {
    if (!fresh) impl.forget_map();
    return Error{fmt::format("{}: {}", path, sentence_of(failure))};
  }
  if (fresh) *impl_ = std::move(*fresh);
  return ok_status();
}

void ModelLibrary::Impl::take_map(const std::string& path, formats::Bsp bsp, const std::vector<world::Entity>& entities,
                                  const std::optional<FileData>& lit_file, bool of_base_game) {
  map_path = path;
  map = std::make_shared<formats::Bsp>(std::move(bsp));
  builder->assets().map = map;
  lightmaps = std::make_shared<const Lightmaps>(*map, lit_file);
  if (!lightmaps->lit_error().empty())
    log_warning("{}: {}; the map's own light is used", with_extension(path, ".lit"), lightmaps->lit_error());
  for (const std::string& error : lightmaps->errors()) log_warning("{}: {}", path, error);
  const SurfaceLights glowing = surface_lights(entities, *map);
  MapMaterials materials(*builder, *map, path, liquid_alphas(entities), glowing);
  for (std::uint32_t i = 0; i < map->models.size(); ++i)
    map_meshes.push_back(add_brush_mesh(*builder, *map, i, materials, i == 0 ? path : fmt::format("*{}", i)));
  lights = scene::entity_lights(entities, *map);
  darkening = darkening_lights(entities, *map);
  const auto faces_up = [&](const formats::BspFace& face) {
    const std::uint32_t texture = map->texinfos[face.texinfo].texture;
    const float up = map->planes[face.plane].normal.z * (face.back_side ? -1.0f : 1.0f);
    return up > 0.0f && texture < map->textures.size() && is_sky_texture(map->textures[texture].name);
  };
  // The base game's domes were set by what white ones give.
  sky = make_layered_sky(*builder, *map,
                         of_base_game ? vec3(white_dome_radiance(entities))
                                      : dome_radiance(entities, std::ranges::any_of(map->faces, faces_up)));
  sky.suns = suns(entities);
  ambient.radiance = ambient_radiance(entities);
  if (ambient.radiance == vec3(0.0f) && !has_light_source(builder->assets(), map_meshes, entities, lights, sky))
    ambient = {vec3(1.0f), true};
  for (std::uint32_t t = 0; t < map->textures.size(); ++t) {
    map_materials.push_back(materials.known(t));
    const auto lit = glowing.find(lower_case(map->textures[t].name));
    texture_lights.push_back(lit != glowing.end() ? lit->second : SurfaceLight());
  }
  // Where there is baked light r_authored decides; elsewhere gloss that nobody authored never counts.
  if (!of_base_game && lightmaps->empty()) drop_gloss_by_name(builder->assets());
  submodels = shown_submodels(entities, *map);
  unshadowed = unshadowed_submodels(entities, map->models.size());
  even = even_light_of_submodels(entities, map->models.size());
}

LitMap ModelLibrary::Impl::lit_map() const {
  std::vector<LitSurface> surfaces = lit_surfaces(builder->assets(), map_materials);
  for (std::size_t t = 0; t < surfaces.size(); ++t) {
    surfaces[t].style = texture_lights[t].style;
    surfaces[t].fall_scale = texture_lights[t].fall_scale;
  }
  return {
      *map,     std::move(surfaces), lights, sky.suns, mean_of_sky(builder->assets(), sky), ambient.radiance, darkening,
      submodels};
}

void ModelLibrary::Impl::forget_map() {
  map.reset();
  builder->assets().map.reset();
  map_path.clear();
  map_meshes.clear();
  lights.clear();
  darkening.clear();
  sky = {};
  ambient = {};
  map_materials.clear();
  texture_lights.clear();
  submodels.clear();
  unshadowed.clear();
  lit_through.clear();
  even.clear();
  lightmaps.reset();
}

const formats::Bsp* ModelLibrary::map() const { return impl_->map.get(); }
const std::string& ModelLibrary::map_entities() const {
  static const std::string kEmpty;
  return impl_->map ? impl_->map->entities : kEmpty;
}
const std::vector<EntityLight>& ModelLibrary::entity_lights() const { return impl_->lights; }
std::shared_ptr<const formats::Bsp> ModelLibrary::shared_map() const { return impl_->map; }
std::shared_ptr<const Lightmaps> ModelLibrary::lightmaps() const { return impl_->lightmaps; }
bool ModelLibrary::of_base_game() const { return own_files_ && own_files_(impl_->map_path); }
LitMap ModelLibrary::lit_map() const { return impl_->lit_map(); }
void ModelLibrary::set_cast(std::uint32_t material, const vec3& cast, float fall, int style) {
  Material& m = impl_->builder->assets().materials[material];
  m.cast = cast;
  m.cast_fall = fall;
  m.cast_style = style;
}
void ModelLibrary::let_light_through(const std::vector<std::uint32_t>& submodels) {
  impl_->lit_through = submodels;
  for (const std::uint32_t index : submodels)
    if (const auto known = impl_->models.find(fmt::format("*{}", index)); known != impl_->models.end())
      known->second.shadowless = known->second.mesh != kNone;
}
std::uint32_t ModelLibrary::add_words(const std::vector<std::uint32_t>& words) {
  constexpr std::size_t kRow = 4096;  // the last row is filled up
  const std::size_t rows = (words.size() + kRow - 1) / kRow;
  Image image{"words", ImageEncoding::kWords, static_cast<int>(kRow), static_cast<int>(rows), {}};
  image.texels.resize(rows * kRow * sizeof(std::uint32_t));
  std::memcpy(image.texels.data(), words.data(), words.size() * sizeof(std::uint32_t));
  return impl_->builder->add_image(std::move(image));
}
const AmbientLight& ModelLibrary::map_ambient() const { return impl_->ambient; }
const Sky& ModelLibrary::map_sky() const { return impl_->sky; }
Sky ModelLibrary::make_skybox(std::string_view name, const Sky& fallback) {
  return make_box_sky(*impl_->builder, name, fallback);
}

const Model& ModelLibrary::model(std::string_view name) {
  const auto known = impl_->models.find(name);
  if (known != impl_->models.end()) return known->second;
  const std::string key(name);
  Model model = impl_->load_model(key);
  model.name = key;
  return impl_->models.emplace(key, std::move(model)).first->second;
}

bool ModelLibrary::Impl::glows(std::uint32_t mesh) const {
  const Assets& assets = builder->assets();
  return std::ranges::any_of(assets.meshes[mesh].triangles, [&](const MeshTriangle& triangle) {
    return assets.materials[triangle.material].emission_kind != EmissionKind::kNone;
  });
}

Model ModelLibrary::Impl::load_submodel(const std::string& name) {
  const bool world = name == map_path;
  std::uint32_t index = 0;
  if (!world) {
    const char* const end = name.data() + name.size();
    const auto [rest, code] = std::from_chars(name.data() + 1, end, index);
    if (code != std::errc() || rest != end || !map || index >= map->models.size()) {
      log_warning("{}: the map has no such submodel", name);
      return {};
    }
  }
  Model model = brush_model(*map, index, name, map_meshes[index]);
  if (const auto own = even.find(index); own != even.end()) model.even = own->second;
  model.shadowless = model.mesh != kNone && (std::ranges::binary_search(lit_through, index) ||
                                             (std::ranges::binary_search(unshadowed, index) && !glows(model.mesh)));
  return model;
}

Model ModelLibrary::Impl::with_glow(Model model) const {
  for (const std::uint32_t first : model.skin_materials)
    for (std::uint32_t m = first; m < first + model.surface_count; ++m)
      model.glows |= builder->assets().materials[m].emission_kind != EmissionKind::kNone;
  return model;
}

Model ModelLibrary::Impl::load_model(const std::string& name) {
  if (name.empty()) return {};
  if (name[0] == '*' || (map && name == map_path)) return load_submodel(name);
  const std::optional<FileData> bytes = loader ? loader(name) : std::nullopt;
  if (!bytes) {
    log_warning("{}: no such file", name);
    return {};
  }
  const auto refuse = [](const Error& error) {
    log_warning("{}", error.message);
    return Model{};
  };
  // Quake goes by what the file says of itself, not by its name.
  const std::string_view magic = bytes->text().substr(0, 4);
  if (magic == "IDPO") {
    auto mdl = formats::parse_mdl(*bytes, name);
    if (!mdl) return refuse(mdl.error());
    log_all(mdl->warnings);
    std::optional<Model> better = enhanced ? enhanced_model(*builder, loader, rank, *mdl, name) : std::nullopt;
    return with_glow(better ? *std::move(better) : alias_model(*builder, *mdl, name));
  }
  if (magic == "IDP3" || magic == "MD5V") {
    auto posed = read_posed_model(loader, name);
    auto model = posed ? make_posed_model(*builder, *posed, name) : Result<Model>(posed.error());
    return model ? with_glow(*std::move(model)) : refuse(model.error());
  }
  if (magic == "IDSP") {
    auto spr = formats::parse_spr(*bytes, name);
    if (!spr) return refuse(spr.error());
    log_all(spr->warnings);
    return sprite_model(*builder, *spr, name);
  }
  auto bsp = formats::parse_bsp(*bytes, name);
  if (!bsp) return refuse(bsp.error());
  if (bsp->models.empty()) return refuse({name + ": a map without models"});
  log_all(bsp->warnings);
  MapMaterials materials(*builder, *bsp, name, {}, {});
  return brush_model(*bsp, 0, name, add_brush_mesh(*builder, *bsp, 0, materials, name));
}

std::uint32_t ModelLibrary::translated_skin(const Model& model, std::uint32_t skin, int top, int bottom) {
  if (model.skin_materials.empty()) return kNone;
  const std::uint32_t source = model.skin_materials[skin < model.skin_materials.size() ? skin : 0];
  constexpr int kShirt = 1, kTrousers = 6;  // the rows that a player's skin is painted in
  top = std::clamp(top, 0, 13);
  bottom = std::clamp(bottom, 0, 13);
  if (top == kShirt && bottom == kTrousers) return source;
  const auto [known, added] = impl_->translated.try_emplace({source, top, bottom}, source);
  if (!added) return known->second;

  std::array<std::uint8_t, 256> table;
  for (int i = 0; i < 256; ++i) table[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i);
  const auto translate = [&](int from, int to) {
    for (int i = 0; i < 16; ++i)  // rows from 8 on run from bright to dark
      table[static_cast<std::size_t>(from * 16 + i)] = static_cast<std::uint8_t>(to * 16 + (to < 8 ? i : 15 - i));
  };
  translate(kShirt, top);
  translate(kTrousers, bottom);
  AssetBuilder& builder = *impl_->builder;
  for (std::uint32_t surface = 0; surface < model.surface_count; ++surface) {
    Material material = builder.assets().materials[source + surface];
    material.name += fmt::format(" {} {}", top, bottom);
    for (TextureSet& set : material.frames) {
      if (builder.assets().images[set.base].encoding != ImageEncoding::kPalette) continue;  // a file's image stays
      Image image = builder.assets().images[set.base];
      image.name = material.name;
      for (std::uint8_t& i : image.texels) i = table[i];
      set.base = builder.add_image(std::move(image));
    }
    const std::uint32_t added_material = builder.add_material(std::move(material));
    if (surface == 0) known->second = added_material;
  }
  return known->second;
}

std::uint32_t ModelLibrary::sphere_mesh() {
  if (impl_->sphere == kNone) impl_->sphere = impl_->builder->add_mesh(make_sphere());
  return impl_->sphere;
}
std::uint32_t ModelLibrary::tetrahedron_mesh() {
  if (impl_->tetrahedron == kNone) impl_->tetrahedron = impl_->builder->add_mesh(make_tetrahedron());
  return impl_->tetrahedron;
}

std::uint32_t ModelLibrary::Impl::instance_colored(std::uint32_t& index, const char* name, EmissionKind kind) {
  if (index == kNone) {
    Material material;
    material.name = name;
    material.emission_kind = kind;
    material.emission = vec3(1.0f);
    index = builder->add_material(std::move(material));
  }
  return index;
}
std::uint32_t ModelLibrary::particle_material() {
  return impl_->instance_colored(impl_->particle, "particle", EmissionKind::kParticle);
}
std::uint32_t ModelLibrary::dynamic_light_material() {
  return impl_->instance_colored(impl_->dynamic_light, "dynamic light", EmissionKind::kDynamicLight);
}
std::uint32_t ModelLibrary::entity_light_material() {
  return impl_->instance_colored(impl_->entity_light, "entity light", EmissionKind::kEntityLight);
}

std::shared_ptr<const Assets> ModelLibrary::assets() const { return impl_->builder->shared_assets(); }

std::uint32_t pose_at(const Model& model, std::uint32_t frame, double time) {
  if (model.frames.empty()) return 0;
  const Model::Frame& f = model.frames[frame < model.frames.size() ? frame : 0];
  return f.first_pose + static_cast<std::uint32_t>(frame_of_group(f.end_times, f.pose_count, time));
}

}  // namespace fb::scene
