#include "scene/library/enhanced_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/log.h"
#include "formats/bsp.h"
#include "scene/library/pose_normals.h"
#include "scene/shapes.h"
#include "shared/packing.h"

namespace fb::scene {
namespace {

using formats::PosedModel;
using formats::PosedSurface;

constexpr float kFlat = 1e-6f;         // of a triangle's area, relative to its longest side's square
constexpr float kLeastExtent = 1e-3f;  // of a model, units
constexpr std::uint32_t kMostSkins = 64, kMostSkinImages = 64;

std::string_view stem_of_file(std::string_view path) { return path.substr(0, path.find_last_of('.')); }
std::string_view name_of_file(std::string_view path) { return path.substr(path.find_last_of("/\\") + 1); }

bool ever_has_area(const PosedModel& model, const std::array<std::uint32_t, 3>& v) {
  for (std::size_t pose = 0; pose < model.pose_count; ++pose) {
    const vec3* const at = model.positions.data() + pose * model.vertex_count;
    const vec3 e1 = at[v[1]] - at[v[0]], e2 = at[v[2]] - at[v[0]], e3 = e2 - e1;
    const float longest = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3)});
    if (glm::length(glm::cross(e1, e2)) > kFlat * longest) return true;
  }
  return false;
}

std::string_view without_extension(std::string_view path) {
  return name_of_file(path).find('.') == std::string_view::npos ? path : stem_of_file(path);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == text.npos ? std::string_view() : text.substr(first, last - first + 1);
}

// What a text of a model's skin says: a line names a surface and, behind a comma, its image; of several lines of a
// surface the images play in a loop.
class SkinText {
 public:
  SkinText(const AssetBuilder& builder, std::string_view owner, std::uint32_t skin) {
    for (const std::string& path :
         {fmt::format("{}_{}.skin", owner, skin), fmt::format("{}_{}.skin", stem_of_file(owner), skin)}) {
      const std::optional<FileData> bytes = builder.load(path);
      if (!bytes) continue;
      read(bytes->text());
      break;
    }
  }
  // Empty: nothing is said of it.
  std::string image_of(std::string_view surface, std::uint32_t image) const {
    const auto found = images_.find(surface);
    return found == images_.end() || image >= found->second.size() ? std::string() : found->second[image];
  }

 private:
  void read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      const std::size_t comma = line.find(',');
      if (comma == line.npos) continue;
      const std::string_view image = trimmed(line.substr(comma + 1));
      if (!image.empty()) images_[std::string(trimmed(line.substr(0, comma)))].emplace_back(without_extension(image));
    }
  }
  std::map<std::string, std::vector<std::string>, std::less<>> images_;
};

// Stems of the files that may hold an image of a skin.
std::vector<std::string> image_stems(const PosedSurface& surface, std::string_view owner, std::uint32_t skin,
                                     std::uint32_t image) {
  std::vector<std::string> bases;
  for (const std::string& named : {surface.shader, surface.name}) {
    if (named.empty()) continue;
    const std::string_view plain = without_extension(named);
    bases.emplace_back(plain);
    bases.push_back(fmt::format("progs/{}", name_of_file(plain)));
    bases.push_back(fmt::format("textures/{}", name_of_file(plain)));
  }
  bases.emplace_back(stem_of_file(owner));
  std::vector<std::string> stems;
  for (const std::string& base : bases) {
    stems.push_back(fmt::format("{}_{:02}_{:02}", base, skin, image));
    stems.push_back(fmt::format("{}_{}_{}", base, skin, image));
    if (image > 0) continue;
    stems.push_back(fmt::format("{}_{:02}", base, skin));
    stems.push_back(fmt::format("{}_{}", base, skin));
    if (skin == 0) stems.push_back(base);
  }
  return stems;
}

// Of one image of a skin; without a base there is none.
TextureSet skin_image(AssetBuilder& builder, const PosedSurface& surface, const SkinText& text, std::string_view owner,
                      std::uint32_t skin, std::uint32_t image) {
  std::vector<std::string> stems = image_stems(surface, owner, skin, image);
  if (std::string said = text.image_of(surface.name, image); !said.empty()) stems = {std::move(said)};
  for (const std::string& stem : stems) {
    TextureSet set = builder.replacement({stem}, owner);
    if (set.base == kNone) set = builder.picture(stem, owner);
    if (set.base != kNone) return set;
  }
  return {};
}

// Of one surface in one skin; without images there is none.
std::optional<Material> skin_material(AssetBuilder& builder, const PosedSurface& surface, const SkinText& text,
                                      std::string_view owner, std::uint32_t skin) {
  Material material;
  material.name = fmt::format("{}_{}", owner, skin);
  material.emission = vec3(1.0f);
  material.frames_per_second = 10.0f;
  bool glows = false;
  for (std::uint32_t image = 0; image < kMostSkinImages; ++image) {
    const TextureSet set = skin_image(builder, surface, text, owner, skin, image);
    if (set.base == kNone) break;
    const Image& base = builder.assets().images[set.base];
    glows |=
        set.luma != kNone || (base.encoding == ImageEncoding::kPalette && has_fullbright(base.texels, /*holes=*/false));
    if (set.gloss != kNone) material.specular = 0.04f;
    material.frames.push_back(set);
  }
  if (material.frames.empty()) return std::nullopt;
  material.emission_kind = glows ? EmissionKind::kFullbright : EmissionKind::kNone;
  builder.refract(material, {material.name}, owner);
  return material;
}

std::vector<Model::Frame> frames_of(const PosedModel& posed, const formats::Mdl* mdl) {
  std::vector<Model::Frame> frames;
  if (mdl != nullptr && posed.pose_count == mdl->pose_count) {
    for (const formats::MdlFrame& f : mdl->frames) frames.push_back({f.name, f.first_pose, f.pose_count, f.end_times});
    return frames;
  }
  const bool named = mdl != nullptr && posed.pose_count == mdl->frames.size();
  for (std::uint32_t pose = 0; pose < posed.pose_count; ++pose)
    frames.push_back({named ? mdl->frames[pose].name : posed.pose_names[pose], pose, 1, {}});
  return frames;
}

}  // namespace

Mesh make_posed_mesh(const PosedModel& model, std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.vertex_count = model.vertex_count;
  mesh.pose_count = model.pose_count;
  Bounds bounds;
  for (const vec3& p : model.positions) bounds.add(p);
  const vec3 steps(shared::kMostPoseX, shared::kMostPoseY, shared::kMostPoseZ);
  mesh.pose_origin = bounds.min;
  mesh.pose_scale = glm::max(bounds.max - bounds.min, vec3(kLeastExtent)) / steps;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    for (const auto& corners : model.surfaces[s].triangles) {
      // Files have them clockwise as seen from outside.
      const std::array<std::uint32_t, 3> v{corners[0], corners[2], corners[1]};
      if (ever_has_area(model, v)) mesh.triangles.push_back({v, s, {model.uv[v[0]], model.uv[v[1]], model.uv[v[2]]}});
    }
  }
  const PoseNormals pose_normals(model.positions, model.vertex_count, mesh.triangles);
  mesh.poses.reserve(model.positions.size());
  for (std::uint32_t pose = 0; pose < model.pose_count; ++pose) {
    const std::vector<vec3> normals = pose_normals.normals(pose);
    for (std::uint32_t v = 0; v < model.vertex_count; ++v) {
      const vec3& p = model.positions[std::size_t{pose} * model.vertex_count + v];
      const vec3 at = glm::clamp((p - mesh.pose_origin) / mesh.pose_scale + 0.5f, vec3(0.0f), steps);
      mesh.poses.push_back(make_pose_vertex(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y),
                                            static_cast<std::uint32_t>(at.z), normals[v]));
    }
  }
  finish_mesh(mesh);
  return mesh;
}

Result<PosedSkins> make_posed_skins(AssetBuilder& builder, const PosedModel& model, std::string_view owner) {
  std::vector<std::vector<Material>> skins;
  for (std::uint32_t skin = 0; skin < kMostSkins; ++skin) {
    const SkinText text(builder, owner, skin);
    std::vector<Material> materials;
    bool any = false;
    for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
      auto material = skin_material(builder, model.surfaces[s], text, owner, skin);
      any |= material.has_value();
      if (!material && skin == 0)
        return Error{fmt::format("{}: no image of its surface {} (\"{}\"): {}.png, .tga, .pcx or .lmp is wanted", owner,
                                 s, model.surfaces[s].shader, image_stems(model.surfaces[s], owner, 0, 0).front())};
      materials.push_back(material ? *std::move(material) : skins.front()[s]);
    }
    if (!any) break;
    skins.push_back(std::move(materials));
  }
  PosedSkins result;
  for (std::vector<Material>& materials : skins) {
    for (std::size_t s = 0; s < materials.size(); ++s) {
      const std::uint32_t index = builder.add_material(std::move(materials[s]));
      if (s == 0) result.first.push_back(index);
    }
  }
  return result;
}

Result<PosedModel> read_posed_model(const FileLoader& load, std::string_view path) {
  const std::string name(path);
  const std::optional<FileData> bytes = load ? load(name) : std::nullopt;
  if (!bytes) return Error{name + ": no such file"};
  if (bytes->text().starts_with("IDP3")) return formats::parse_md3(*bytes, name);
  const std::string anim_name = std::string(stem_of_file(path)) + ".md5anim";
  const std::optional<FileData> anim = load(anim_name);
  if (!anim) return formats::parse_md5({bytes->text(), name}, std::nullopt);
  return formats::parse_md5({bytes->text(), name}, formats::Md5Text{anim->text(), anim_name});
}

Result<Model> make_posed_model(AssetBuilder& builder, const PosedModel& posed, const std::string& path) {
  Model model;
  model.kind = ModelKind::kAlias;
  model.name = path;
  Mesh mesh = make_posed_mesh(posed, path);
  model.bounds = mesh.bounds;
  for (int axis = 0; axis < 3; ++axis)
    if (!(mesh.bounds.min[axis] > -formats::kMaxBspCoordinate && mesh.bounds.max[axis] < formats::kMaxBspCoordinate))
      return Error{fmt::format("{}: vertices are more than {} units away", path, formats::kMaxBspCoordinate)};
  auto skins = make_posed_skins(builder, posed, path);
  if (!skins) return skins.error();
  if (!mesh.triangles.empty()) model.mesh = builder.add_mesh(std::move(mesh));
  model.skin_materials = std::move(skins->first);
  model.surface_count = static_cast<std::uint32_t>(posed.surfaces.size());
  model.frames = frames_of(posed, nullptr);
  return model;
}

std::optional<Model> enhanced_model(AssetBuilder& builder, const FileLoader& load, const FileRank& rank,
                                    const formats::Mdl& mdl, const std::string& path) {
  for (const char* extension : {".md5mesh", ".md3"}) {
    const std::string name = std::string(stem_of_file(path)) + extension;
    if (!load(name) || (rank && rank(name) < rank(path))) continue;
    auto posed = read_posed_model(load, name);
    auto model = posed ? make_posed_model(builder, *posed, name) : Result<Model>(posed.error());
    if (!model) {
      log_warning("{}; {} is shown", model.error().message, path);
      continue;
    }
    model->name = path;
    model->flags = mdl.flags;
    model->random_start = mdl.sync_type == 1;
    model->frames = frames_of(*posed, &mdl);
    return *std::move(model);
  }
  return std::nullopt;
}

}  // namespace fb::scene
