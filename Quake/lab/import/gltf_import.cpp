#include "lab/import/gltf_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lab/gltf/gltf_numbers.h"
#include "lab/import/gltf_file.h"
#include "lab/import/scene_maker.h"

namespace fb::lab {
namespace {

constexpr int kStrip = 5, kFan = 6;
constexpr int kDeepestNode = 256;  // of nodes in nodes
constexpr std::uint64_t kAbsent = ~std::uint64_t{0};
constexpr float kLampRadius = 0.25f;  // degrees, of a lamp that has none

// glTF's x, y (up), z in metres as Quake's x east, y north, z up: export_gltf's other way round.
mat4x3 to_world() {
  const float s = kUnitsPerMetre;
  return mat4x3(vec3(s, 0, 0), vec3(0, 0, s), vec3(0, -s, 0), vec3(0));
}

float coat_of(float index) {
  const float r = (index - 1.0f) / (index + 1.0f);
  return r * r;
}

float largest_part(const vec3& v) { return std::max({v.x, v.y, v.z}); }

vec3 share_of(const vec3& v) { return glm::clamp(v, vec3(0.0f), vec3(1.0f)); }

const Json* extension(const Json& object, const char* name) {
  const Json* all = object_member(object, "extensions");
  return all == nullptr ? nullptr : object_member(*all, name);
}

const Json* ours(const Json& object) {
  const Json* extras = object_member(object, "extras");
  return extras == nullptr ? nullptr : object_member(*extras, "fullbright");
}

bool flag(const Json& object, const char* key, bool otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_boolean() ? found->get<bool>() : otherwise;
}

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

class GltfImporter {
 public:
  explicit GltfImporter(const GltfFile& file) : file_(file), maker_(to_world()) {}

  Result<ImportedScene> run() {
    if (const Json* extras = ours(file_.root()); extras != nullptr && flag(*extras, "behind_everything", false))
      maker_.set_sky(vector_member(*extras, "sky", vec3(0)));
    const auto number = whole_member(file_.root(), "scene", 0);
    if (!number) return file_.error(number.error().message);
    const auto scene = file_.item("scenes", *number);
    if (!scene) return scene.error();
    if (auto status = nodes(**scene, "nodes", mat4x3(1.0f), 0); !status) return status.error();
    for (const char* list : {"animations", "skins"})
      if (const auto found = file_.root().find(list); found != file_.root().end() && !found->empty())
        maker_.leave_out(fmt::format("{} are left out: all stands as it was made", list));
    return maker_.finish(file_.path(), false);
  }

 private:
  Status nodes(const Json& parent, const char* key, const mat4x3& transform, int depth) {
    const auto list = parent.find(key);
    if (list == parent.end() || !list->is_array()) return ok_status();
    if (depth > kDeepestNode) return file_.error(fmt::format("its nodes are in each other {} deep", kDeepestNode));
    for (const Json& index : *list) {
      if (!index.is_number_unsigned()) return file_.error("a node's number is none");
      const auto node = file_.item("nodes", index.get<std::uint64_t>());
      if (!node) return node.error();
      if (++nodes_ > 1000000) return file_.error("it has more than a million nodes");
      if (auto status = this->node(**node, transform, depth); !status) return status;
    }
    return ok_status();
  }

  Status node(const Json& node, const mat4x3& parent, int depth) {
    const mat4x3 place = after(parent, own_transform(node));
    const auto camera = whole_member(node, "camera", kAbsent), mesh = whole_member(node, "mesh", kAbsent);
    if (!camera || !mesh) return file_.error("a node's " + (camera ? mesh : camera).error().message);
    if (*camera != kAbsent) {
      if (auto status = add_camera(*camera, place); !status) return status;
    }
    if (const Json* light = extension(node, "KHR_lights_punctual")) {
      if (auto status = add_light(*light, place); !status) return status;
    }
    if (*mesh != kAbsent) {
      std::uint32_t visibility = scene::kSeenByAll;
      if (const Json* extras = ours(node)) {
        if (!flag(*extras, "seen_by_camera", true)) visibility &= ~std::uint32_t{scene::kSeenByCamera};
        if (!flag(*extras, "seen_by_other_rays", true)) visibility &= ~std::uint32_t{scene::kSeenByIndirect};
      }
      if (auto status = add_mesh(*mesh, place, visibility); !status) return status;
    }
    return nodes(node, "children", place, depth + 1);
  }

  static mat4x3 own_transform(const Json& node) {
    if (const auto m = node.find("matrix"); m != node.end() && m->is_array() && m->size() == 16) {
      mat4x3 out;
      for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) {
          const Json& part = (*m)[static_cast<std::size_t>(column * 4 + row)];
          out[column][row] = part.is_number() ? part.get<float>() : 0.0f;
        }
      return out;
    }
    const vec3 scale = vector_member(node, "scale", vec3(1)), move = vector_member(node, "translation", vec3(0));
    vec3 axis(0);
    float w = 1.0f;
    if (const auto q = node.find("rotation");
        q != node.end() && q->is_array() && q->size() == 4 && (*q)[3].is_number()) {
      axis = vector_member(node, "rotation", vec3(0));
      w = (*q)[3].get<float>();
    }
    // Rodrigues' rotation by a unit quaternion.
    const auto turned = [&](const vec3& v) { return v + 2.0f * glm::cross(axis, glm::cross(axis, v) + w * v); };
    return mat4x3(turned({1, 0, 0}) * scale.x, turned({0, 1, 0}) * scale.y, turned({0, 0, 1}) * scale.z, move);
  }

  Status add_camera(std::uint64_t index, const mat4x3& place) {
    const auto camera = file_.item("cameras", index);
    if (!camera) return camera.error();
    if (maker_.has_camera()) {
      maker_.leave_out("of its cameras the first is taken (--camera sets another)");
      return ok_status();
    }
    const Json* perspective = object_member(**camera, "perspective");
    if (perspective == nullptr) {
      maker_.leave_out("a camera without perspective is left out");
      return ok_status();
    }
    const float fov_y = number_member(*perspective, "yfov", 0.9f);
    const float aspect = number_member(*perspective, "aspectRatio", 16.0f / 9.0f);
    if (!(fov_y > 0.0f && fov_y < kPi && aspect > 0.0f)) return file_.error("a camera sees nothing");
    ImportedCamera out;
    out.position = place[3];
    out.forward = -place[2];
    out.right = place[0];
    out.up = place[1];
    out.fov_x = degrees(2.0f * std::atan(std::tan(fov_y / 2.0f) * aspect));
    maker_.set_camera(out);
    return ok_status();
  }

  Status add_light(const Json& reference, const mat4x3& place) {
    const Json* all = extension(file_.root(), "KHR_lights_punctual");
    const auto lights = all == nullptr ? Json::const_iterator() : all->find("lights");
    const auto index = whole_member(reference, "light", kAbsent);
    if (!index || all == nullptr || lights == all->end() || !lights->is_array() || *index >= lights->size())
      return file_.error("a node has a light that is not there");
    const Json& light = (*lights)[*index];
    if (!light.is_object()) return file_.error("a light is no object");
    const vec3 strength =
        vector_member(light, "color", vec3(1)) * number_member(light, "intensity", 1.0f) / kLumenPerWatt;
    const std::string type = text_of(light, "type");
    if (type == "directional") {
      const Json* extras = ours(light);
      maker_.add_sun(place[2], strength,
                     extras == nullptr ? kLampRadius : number_member(*extras, "radius_degrees", kLampRadius));
      return ok_status();
    }
    if (type == "spot") maker_.leave_out("spots shine all around");
    maker_.leave_out("lights that are points are balls of 2 inches");
    maker_.add_point_light(place[3], strength);
    return ok_status();
  }

  Status add_mesh(std::uint64_t index, const mat4x3& place, std::uint32_t visibility) {
    const auto mesh = file_.item("meshes", index);
    if (!mesh) return mesh.error();
    const auto primitives = (*mesh)->find("primitives");
    if (primitives == (*mesh)->end() || !primitives->is_array()) return ok_status();
    for (const Json& primitive : *primitives) {
      if (!primitive.is_object()) return file_.error("a part of a mesh is no object");
      if (primitive.contains("targets")) maker_.leave_out("shapes that meshes change to are left out");
      auto read = triangles(primitive);
      if (!read) return read.error();
      const auto number = whole_member(primitive, "material", kAbsent);
      if (!number) return file_.error("a mesh's " + number.error().message);
      const auto material = this->material(*number);
      if (!material) return material.error();
      if (auto status = maker_.add_mesh(*read, place, *material, visibility); !status)
        return file_.error(fmt::format("mesh {}: {}", index, status.error().message));
    }
    return ok_status();
  }

  Result<ImportedMesh> triangles(const Json& primitive) {
    ImportedMesh mesh;
    const auto mode = whole_member(primitive, "mode", kTriangleList);
    if (!mode) return file_.error("a mesh's " + mode.error().message);
    if (*mode < kTriangleList || *mode > kFan) {
      maker_.leave_out("points and lines are left out");
      return mesh;
    }
    const Json* attributes = object_member(primitive, "attributes");
    if (attributes == nullptr) return file_.error("a part of a mesh has no attributes");
    if (attributes->contains("COLOR_0")) maker_.leave_out("colours of vertices are left out");
    const auto read = [&](const char* key, int components) -> Result<std::vector<float>> {
      const auto accessor = whole_member(*attributes, key, kAbsent);
      if (!accessor) return file_.error("an attribute's " + accessor.error().message);
      if (*accessor == kAbsent) return std::vector<float>();
      return file_.numbers(*accessor, components);
    };
    const auto positions = read("POSITION", 3), normals = read("NORMAL", 3), uvs = read("TEXCOORD_0", 2);
    for (const auto* part : {&positions, &normals, &uvs})
      if (!*part) return part->error();
    for (std::size_t i = 0; i + 2 < positions->size(); i += 3)
      mesh.positions.emplace_back((*positions)[i], (*positions)[i + 1], (*positions)[i + 2]);
    for (std::size_t i = 0; i + 2 < normals->size(); i += 3)
      mesh.normals.emplace_back((*normals)[i], (*normals)[i + 1], (*normals)[i + 2]);
    for (std::size_t i = 0; i + 1 < uvs->size(); i += 2) mesh.uvs.emplace_back((*uvs)[i], (*uvs)[i + 1]);

    const auto accessor = whole_member(primitive, "indices", kAbsent);
    if (!accessor) return file_.error("a mesh's " + accessor.error().message);
    std::vector<std::uint32_t> order;
    if (*accessor == kAbsent) {
      for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) order.push_back(i);
    } else {
      auto indices = file_.indices(*accessor);
      if (!indices) return indices.error();
      order = std::move(*indices);
    }
    if (*mode == kTriangleList) {
      mesh.indices = std::move(order);
    } else {
      for (std::size_t i = 2; i < order.size(); ++i) {
        const bool odd = *mode == kStrip && i % 2 == 1;
        const std::uint32_t first = *mode == kFan ? order[0] : order[i - 2];
        mesh.indices.insert(mesh.indices.end(), {odd ? order[i - 1] : first, odd ? first : order[i - 1], order[i]});
      }
    }
    return mesh;
  }

  Result<std::uint32_t> material(std::uint64_t index) {
    const auto [known, fresh] = materials_.try_emplace(index, 0u);
    if (!fresh) return known->second;
    scene::Material out;
    out.emission_kind = scene::EmissionKind::kNone;
    out.flags = scene::kMaterialNoFullbright;
    out.specular = coat_of(1.5f);
    if (index == kAbsent) {
      out.name = "no material";
    } else {
      const auto item = file_.item("materials", index);
      if (!item) return item.error();
      out.name = text_of(**item, "name");
      if (auto status = set_material(out, **item); !status) return status.error();
    }
    known->second = maker_.add_material(std::move(out));
    return known->second;
  }

  Status set_material(scene::Material& out, const Json& m) {
    const Json none = Json::object();
    const Json* found = object_member(m, "pbrMetallicRoughness");
    const Json& pbr = found == nullptr ? none : *found;
    const float index = extension(m, "KHR_materials_ior") == nullptr
                            ? 1.5f
                            : number_member(*extension(m, "KHR_materials_ior"), "ior", 1.5f);
    out.specular = coat_of(index);
    if (const Json* coat = extension(m, "KHR_materials_specular"))
      out.specular = std::min(out.specular * number_member(*coat, "specularFactor", 1.0f) *
                                  largest_part(vector_member(*coat, "specularColorFactor", vec3(1))),
                              1.0f);
    out.base_color = share_of(vector_member(pbr, "baseColorFactor", vec3(1)));
    out.metalness = std::clamp(number_member(pbr, "metallicFactor", 1.0f), 0.0f, 1.0f);
    out.roughness = std::clamp(number_member(pbr, "roughnessFactor", 1.0f), 0.0f, 1.0f);
    float alpha = 1.0f;
    if (const auto factor = pbr.find("baseColorFactor");
        factor != pbr.end() && factor->is_array() && factor->size() > 3 && (*factor)[3].is_number())
      alpha = std::clamp((*factor)[3].get<float>(), 0.0f, 1.0f);
    const std::string mode = text_of(m, "alphaMode");
    if (mode == "BLEND") out.alpha = alpha;
    if (mode == "MASK" && !pbr.contains("baseColorTexture") && alpha < number_member(m, "alphaCutoff", 0.5f))
      out.alpha = 0.0f;
    scene::TextureSet set;
    if (auto status = set_textures(out, set, m, pbr, mode == "MASK", alpha); !status) return status;
    set_emission(out, set, m);
    set_glass(out, m, index);
    for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy",
                             "KHR_materials_iridescence", "KHR_materials_unlit"})
      if (extension(m, name) != nullptr) maker_.leave_out(fmt::format("{} is left out", name));
    if (set.base != scene::kNone || set.luma != scene::kNone || set.normal != scene::kNone ||
        set.gloss != scene::kNone) {
      if (set.base == scene::kNone) set.base = maker_.white_image();
      out.frames = {set};
    }
    return ok_status();
  }

  Status set_textures(scene::Material& out, scene::TextureSet& set, const Json& m, const Json& pbr, bool holes,
                      float alpha) {
    const float cutoff = holes ? number_member(m, "alphaCutoff", 0.5f) : 0.0f;
    const auto base = texture(pbr, "baseColorTexture", out);
    if (!base) return base.error();
    if (*base) {
      formats::RgbaImage image = **base;
      for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        const bool hole = holes && static_cast<float>(image.rgba[i]) / 255.0f * alpha < cutoff;
        image.rgba[i] = hole ? 0 : 255;
      }
      if (holes) out.flags |= scene::kMaterialAlphaTest;
      set.base = maker_.add_image(out.name, std::move(image), scene::ImageEncoding::kSrgba);
    }
    const auto rough = texture(pbr, "metallicRoughnessTexture", out);
    if (!rough) return rough.error();
    if (*rough) {
      const formats::RgbaImage& image = **rough;
      std::vector<std::uint8_t> gloss;
      double metal = 0;
      for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
        gloss.push_back(
            static_cast<std::uint8_t>(std::lround(255.0f - out.roughness * static_cast<float>(image.rgba[i + 1]))));
        metal += image.rgba[i + 2];
      }
      metal /= 255.0 * std::max<double>(static_cast<double>(gloss.size()), 1.0);
      if (out.metalness > 0.0f && metal > 0.02 && metal < 0.98)
        maker_.leave_out("textures of metal have their mean alone");
      out.metalness *= static_cast<float>(metal);
      set.gloss = maker_.add_gray_image(out.name + " gloss", image.width, image.height, std::move(gloss));
    }
    const auto normal = texture(m, "normalTexture", out);
    if (!normal) return normal.error();
    if (*normal) set.normal = maker_.add_image(out.name + " normal", **normal, scene::ImageEncoding::kLinearRgba);
    const auto luma = texture(m, "emissiveTexture", out);
    if (!luma) return luma.error();
    if (*luma) set.luma = maker_.add_image(out.name + " glow", **luma, scene::ImageEncoding::kSrgba);
    return ok_status();
  }

  static void set_emission(scene::Material& out, const scene::TextureSet& set, const Json& m) {
    vec3 radiance = vector_member(m, "emissiveFactor", vec3(0));
    if (const Json* strength = extension(m, "KHR_materials_emissive_strength"))
      radiance *= number_member(*strength, "emissiveStrength", 1.0f);
    radiance = glm::max(radiance, vec3(0));
    if (radiance == vec3(0)) return;
    // A picture of what glows is of a kind that a cvar scales; it counts as the file has it with the usual value.
    const bool textured = set.luma != scene::kNone;
    out.emission_kind = textured ? scene::EmissionKind::kFullbright : scene::EmissionKind::kConstant;
    out.emission = textured ? radiance / scene::usual_emission(out.emission_kind) : radiance;
  }

  void set_glass(scene::Material& out, const Json& m, float index) {
    const Json* transmission = extension(m, "KHR_materials_transmission");
    const float share = transmission == nullptr ? 0.0f : number_member(*transmission, "transmissionFactor", 0.0f);
    if (!(share > 0.0f)) return;
    const Json* volume = extension(m, "KHR_materials_volume");
    if (volume == nullptr || !(number_member(*volume, "thicknessFactor", 0.0f) > 0.0f)) {
      maker_.leave_out("thin glass lets light through by chance, without a mirror image");
      out.alpha *= 1.0f - std::clamp(share, 0.0f, 1.0f);
      return;
    }
    if (share < 1.0f || out.roughness > 0.0f) maker_.leave_out("glass is smooth and lets all light in");
    out.flags |= scene::kMaterialDielectric;
    out.index = std::clamp(index, 1.0f, 4.0f);
    const float distance = number_member(*volume, "attenuationDistance", 0.0f);
    if (!(distance > 0.0f)) return;
    const vec3 color = glm::clamp(vector_member(*volume, "attenuationColor", vec3(1)), vec3(1e-6f), vec3(1.0f));
    out.absorption = -glm::log(color) / (distance * kUnitsPerMetre);
  }

  // The image of a texture that a material names; none where it names none.
  Result<const formats::RgbaImage*> texture(const Json& object, const char* key, scene::Material& material) {
    const Json* reference = object_member(object, key);
    if (reference == nullptr) return static_cast<const formats::RgbaImage*>(nullptr);
    if (const auto set = whole_member(*reference, "texCoord", 0); !set || *set != 0)
      maker_.leave_out("textures with coordinates of their own have the first ones");
    if (extension(*reference, "KHR_texture_transform") != nullptr)
      maker_.leave_out("KHR_texture_transform is left out: textures lie as without it");
    const auto number = whole_member(*reference, "index", kAbsent);
    if (!number) return file_.error("a texture's " + number.error().message);
    const auto texture = file_.item("textures", *number);
    if (!texture) return texture.error();
    if (const auto sampler = whole_member(**texture, "sampler", kAbsent); sampler && *sampler != kAbsent) {
      const auto item = file_.item("samplers", *sampler);
      if (!item) return item.error();
      const auto wrap = whole_member(**item, "wrapS", 0);
      if (wrap && *wrap == kClamp) material.flags |= scene::kMaterialClampTexture;
      if (wrap && *wrap == kMirroredRepeat) maker_.leave_out("textures that mirror are repeated");
    }
    const auto source = whole_member(**texture, "source", kAbsent);
    if (!source) return file_.error("a texture's " + source.error().message);
    const auto [known, fresh] = images_.try_emplace(*source, std::nullopt);
    if (fresh) {
      auto image = file_.image(*source);
      if (image)
        known->second = std::move(*image);
      else
        maker_.leave_out(image.error().message);
    }
    return known->second ? &*known->second : nullptr;
  }

  const GltfFile& file_;
  SceneMaker maker_;
  std::size_t nodes_ = 0;
  std::map<std::uint64_t, std::uint32_t> materials_;
  std::map<std::uint64_t, std::optional<formats::RgbaImage>> images_;
};

}  // namespace

Result<ImportedScene> import_gltf(const std::string& path) {
  const auto file = GltfFile::read(path);
  if (!file) return file.error();
  return GltfImporter(*file).run();
}

}  // namespace fb::lab
