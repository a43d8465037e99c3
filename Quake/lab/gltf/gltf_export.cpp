#include "lab/gltf/gltf_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "formats/image_write.h"
#include "lab/gltf/gltf_document.h"
#include "lab/gltf/gltf_numbers.h"
#include "render/picture/frame_constants.h"
#include "render/scene/gpu_scene_tables.h"
#include "scene/library/asset_builder.h"
#include "scene/shapes.h"
#include "shared/packing.h"

namespace fb::lab {
namespace {

constexpr float kUsualSpecular = 0.04f;  // glTF's own
constexpr std::uint8_t kTransparentIndex = 255, kFirstFullbright = 224;

Json list(const vec3& v) { return {v.x, v.y, v.z}; }
Json matrix(const vec3& x, const vec3& y, const vec3& z, const vec3& origin) {
  return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, origin.x, origin.y, origin.z, 1};
}

float largest(const vec3& v) { return std::max({v.x, v.y, v.z}); }

// What is wanted of an image's texels.
enum class Plane { kColor, kColorAndHoles, kGlow, kNormal, kRoughness };

class Exporter {
 public:
  Exporter(const scene::FrameSnapshot& snapshot, const render::RenderSettings& settings, const std::string& generator)
      : snapshot_(snapshot),
        assets_(*snapshot.assets),
        scales_(render::emission_scales(settings)),
        document_(generator) {
    document_.root()["extras"]["fullbright"] = {{"bounces", settings.bounces},
                                                {"behind_everything", snapshot.sky.beyond_everything},
                                                {"sky", list(mean_sky())}};
  }

  Result<GltfSummary> write(uvec2 size, const std::string& path) {
    Json children = Json::array();
    for (const scene::Instance& instance : snapshot_.instances) children.push_back(add_instance(instance));
    children.push_back(add_camera(size));
    for (const scene::Sun& sun : snapshot_.sky.suns) children.push_back(add_sun(sun));
    // Quake's x east, y north, z up in glTF's x, -z, y.
    const float s = kMetresPerUnit;
    const std::uint32_t root = document_.add("nodes", {{"name", "Quake's world"},
                                                       {"matrix", matrix({s, 0, 0}, {0, 0, -s}, {0, s, 0}, vec3(0))},
                                                       {"children", children}});
    document_.root()["scene"] = document_.add("scenes", {{"nodes", {root}}});
    if (failed_) return *failed_;
    if (snapshot_.medium.scatters()) missing_.insert("fog is left out");
    summary_.missing.assign(missing_.begin(), missing_.end());
    if (auto status = document_.write(path); !status) return status.error();
    return summary_;
  }

 private:
  struct MaterialKey {
    std::uint32_t material;
    bool alternate, own_color;
    double time;
    float alpha;
    std::array<float, 6> color;  // reflectance and radiance of an instance's own
    auto operator<=>(const MaterialKey&) const = default;
  };

  vec3 texel(const scene::Image& image, std::size_t at, bool& hole, bool& glows) const {
    const std::uint8_t* bytes = image.texels.data() + at * scene::texel_bytes(image.encoding);
    hole = glows = false;
    switch (image.encoding) {
      case scene::ImageEncoding::kPalette: {
        hole = *bytes == kTransparentIndex;
        glows = *bytes >= kFirstFullbright;
        const auto& rgb = assets_.palette.rgb[*bytes];
        return vec3(rgb[0], rgb[1], rgb[2]);
      }
      case scene::ImageEncoding::kLinearGray:
        return vec3(*bytes);
      default:
        hole = bytes[3] < 128;
        return vec3(bytes[0], bytes[1], bytes[2]);
    }
  }

  // Its sky over all directions and its layers' texels.
  vec3 mean_sky() const {
    const scene::Sky& sky = snapshot_.sky;
    const auto mean = [&](std::uint32_t index) {
      if (index >= assets_.images.size()) return vec4(0.0f);
      const scene::Image& image = assets_.images[index];
      const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
      vec4 sum(0.0f);
      for (std::size_t i = 0; i < count; ++i) {
        bool hole = false, glows = false;
        const vec3 byte = texel(image, i, hole, glows);
        if (!hole)
          sum += vec4(scene::linear_from_srgb(byte.x / 255.0f), scene::linear_from_srgb(byte.y / 255.0f),
                      scene::linear_from_srgb(byte.z / 255.0f), 1.0f);
      }
      return sum / std::max(static_cast<float>(count), 1.0f);
    };
    switch (sky.mode) {
      case scene::SkyMode::kConstant:
        return sky.color;
      case scene::SkyMode::kLayers: {
        const vec4 front = mean(sky.alpha);
        return (vec3(front) + vec3(mean(sky.solid)) * (1.0f - front.w)) * sky.color;
      }
      case scene::SkyMode::kBox: {
        vec3 sum(0.0f);
        for (const std::uint32_t side : sky.box) sum += vec3(mean(side)) / 6.0f;
        return sum * sky.color;
      }
      default:
        return vec3(0.0f);
    }
  }

  // A texture of one of an image's planes; `metalness` goes with roughness.
  std::uint32_t texture(std::uint32_t index, Plane plane, bool clamped, float metalness = 0.0f) {
    const auto [known, fresh] = textures_.try_emplace(std::tuple(index, plane, clamped, metalness), 0u);
    if (!fresh) return known->second;
    const scene::Image& image = assets_.images[index];
    const auto width = static_cast<std::uint32_t>(image.width), height = static_cast<std::uint32_t>(image.height);
    std::vector<std::uint32_t> pixels;
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
      bool hole = false, glows = false;
      vec3 color = texel(image, i, hole, glows);
      if (plane == Plane::kGlow && !glows) color = vec3(0.0f);
      if (plane == Plane::kRoughness) color = vec3(255.0f, 255.0f - color.x, 255.0f * metalness);
      std::uint32_t packed = plane == Plane::kColorAndHoles && hole ? 0u : 0xff000000u;
      for (int c = 0; c < 3; ++c) packed |= static_cast<std::uint32_t>(std::lround(color[c])) << (8 * c);
      pixels.push_back(packed);
    }
    const auto png = formats::encode_png(
        width, height, pixels, plane == Plane::kColorAndHoles ? formats::PngAlpha::kKept : formats::PngAlpha::kIgnored);
    if (!png) {
      failed_ = png.error();
      return 0;
    }
    const int wrap = clamped ? kClamp : kRepeat;
    const std::uint32_t sampler =
        document_.add("samplers", {{"magFilter", kNearest}, {"minFilter", kNearest}, {"wrapS", wrap}, {"wrapT", wrap}});
    ++summary_.images;
    known->second = document_.add("textures", {{"sampler", sampler}, {"source", document_.add_png(image.name, *png)}});
    return known->second;
  }

  // Programs that read the scene know materials by their names.
  std::string unused_name(const std::string& name) {
    const std::uint32_t number = ++names_[name];
    return number == 1 ? name : fmt::format("{} ({})", name, number);
  }

  void set_emission(Json& out, const vec3& radiance) {
    const float strength = largest(radiance);
    if (!(strength > 0.0f)) return;
    out["emissiveFactor"] = list(radiance / strength);
    document_.use_extension("KHR_materials_emissive_strength");
    out["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
  }

  // The material's own look; a material of plain colours has no textures.
  void set_textures(Json& out, Json& pbr, const scene::Material& m, const MaterialKey& key, const vec3& factor) {
    const scene::TextureSet& set = scene::texture_at(m, key.time, key.alternate);
    const bool constant = m.emission_kind == scene::EmissionKind::kConstant;
    if (set.base == scene::kNone || constant) set_emission(out, constant ? factor : vec3(0.0f));
    if (set.base == scene::kNone) return;
    const bool clamped = (m.flags & scene::kMaterialClampTexture) != 0;
    const bool holes = (m.flags & scene::kMaterialAlphaTest) != 0;
    const auto reference = [&](std::uint32_t image, Plane plane, float metalness = 0.0f) {
      return Json{{"index", texture(image, plane, clamped, metalness)}};
    };
    pbr["baseColorTexture"] = reference(set.base, holes ? Plane::kColorAndHoles : Plane::kColor);
    if (holes) out["alphaMode"] = "MASK";
    if ((m.flags & scene::kMaterialWarp) != 0) missing_.insert("warps of liquids' textures are left out");
    const bool fullbright = m.emission_kind == scene::EmissionKind::kFullbright;
    if (fullbright && set.luma != scene::kNone) {
      out["emissiveTexture"] = reference(set.luma, Plane::kColor);
    } else if (fullbright && (m.flags & scene::kMaterialNoFullbright) == 0 &&
               assets_.images[set.base].encoding == scene::ImageEncoding::kPalette) {
      out["emissiveTexture"] = reference(set.base, Plane::kGlow);
    } else if (shared::all_texels_glow(static_cast<std::uint32_t>(m.emission_kind))) {
      out["emissiveTexture"] = reference(set.base, Plane::kColor);
    }
    if (out.contains("emissiveTexture")) set_emission(out, factor);
    if (set.normal != scene::kNone) out["normalTexture"] = reference(set.normal, Plane::kNormal);
    if (set.gloss == scene::kNone) return;
    pbr["metallicRoughnessTexture"] = reference(set.gloss, Plane::kRoughness, m.metalness);
    pbr["roughnessFactor"] = pbr["metallicFactor"] = 1.0f;
  }

  std::uint32_t material(const MaterialKey& key) {
    const auto [known, fresh] = materials_.try_emplace(key, 0u);
    if (!fresh) return known->second;
    const scene::Material& m = assets_.materials[key.material];
    Json out{{"name", unused_name(m.name)}, {"doubleSided", true}};
    Json pbr{{"metallicFactor", m.metalness}, {"roughnessFactor", m.roughness}};
    vec3 base = m.base_color;
    const vec3 factor = m.emission * render::emission_scale(scales_, m.emission_kind);
    if (key.own_color) {
      const auto& c = key.color;
      base = vec3(c[0], c[1], c[2]);
      set_emission(out, vec3(c[3], c[4], c[5]) * render::emission_scale(scales_, m.emission_kind));
    } else if (m.emission_kind == scene::EmissionKind::kSky) {
      base = vec3(0.0f);
      set_emission(out, mean_sky() * factor);
      if (snapshot_.sky.mode > scene::SkyMode::kConstant) missing_.insert("skies have their mean colour alone");
      if (!snapshot_.sky.suns.empty())
        missing_.insert("suns shine through sky surfaces here: take these away for lamps");
    } else {
      set_textures(out, pbr, m, key, factor);
    }
    const float alpha = m.alpha * key.alpha;
    pbr["baseColorFactor"] = {base.x, base.y, base.z, alpha};
    if (alpha < 1.0f) out["alphaMode"] = "BLEND";
    if (scene::lets_light_in(m, snapshot_.liquid_opacity)) missing_.insert("liquids and glass do not refract");
    document_.use_extension("KHR_materials_specular");
    const float specular = m.specular / kUsualSpecular;
    Json& coat = out["extensions"]["KHR_materials_specular"];
    coat = {{"specularFactor", std::min(specular, 1.0f)}};
    if (specular > 1.0f) coat["specularColorFactor"] = {specular, specular, specular};
    out["pbrMetallicRoughness"] = std::move(pbr);
    ++summary_.materials;
    known->second = document_.add("materials", std::move(out));
    return known->second;
  }

  MaterialKey key_of(const scene::Instance& instance, std::uint32_t relative) const {
    const bool own_color = (instance.flags & scene::kInstanceColor) != 0;
    const bool own_clock = (instance.flags & scene::kInstanceShareTime) == 0;
    MaterialKey key{relative + instance.material_base,
                    (instance.flags & scene::kInstanceAlternate) != 0,
                    own_color,
                    snapshot_.time - (own_clock ? static_cast<double>(instance.time_offset) : 0.0),
                    instance.alpha,
                    {}};
    if (own_color)
      key.color = {instance.color.x,    instance.color.y,    instance.color.z,
                   instance.emission.x, instance.emission.y, instance.emission.z};
    return key;
  }

  vec3 position(const scene::Mesh& mesh, const scene::PoseBlend& pose, std::uint32_t vertex) const {
    if (!mesh.posed()) return scene::vertex_position(mesh, vertex);
    return glm::mix(scene::vertex_position(mesh, vertex, pose.a), scene::vertex_position(mesh, vertex, pose.b), pose.t);
  }
  vec3 normal(const scene::Mesh& mesh, const scene::PoseBlend& pose, std::uint32_t vertex) const {
    if (!mesh.posed()) return mesh.normals[vertex];
    const auto of = [&](std::uint32_t number) {
      const scene::PoseVertex& v = mesh.poses[std::size_t{number} * mesh.vertex_count + vertex];
      return shared::direction_from_octahedral(glm::max(vec2(v.normal_u, v.normal_v) / 32767.0f, vec2(-1.0f)));
    };
    return glm::normalize(glm::mix(of(pose.a), of(pose.b), pose.t));
  }

  // One primitive a material; corners are not shared, since each has its own place in the texture.
  std::uint32_t mesh(const scene::Instance& instance) {
    const scene::Mesh& mesh = assets_.meshes[instance.mesh];
    std::map<std::uint32_t, std::vector<const scene::MeshTriangle*>> by_material;
    for (const scene::MeshTriangle& t : mesh.triangles) by_material[t.material].push_back(&t);
    Json primitives = Json::array();
    const bool smooth = mesh.posed() || !mesh.normals.empty();
    for (const auto& [relative, triangles] : by_material) {
      std::vector<vec3> positions, normals;
      std::vector<vec2> uvs;
      for (const scene::MeshTriangle* t : triangles) {
        vec3 corners[3];
        for (int i = 0; i < 3; ++i)
          corners[i] = position(mesh, instance.pose, t->vertices[static_cast<std::size_t>(i)]);
        const vec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(glm::dot(across, across) > 0.0f)) continue;  // no renderer sees it
        for (std::size_t i = 0; i < 3; ++i) {
          positions.push_back(corners[i]);
          normals.push_back(smooth ? normal(mesh, instance.pose, t->vertices[i]) : glm::normalize(across));
          uvs.push_back(t->uv[i]);
        }
      }
      if (positions.empty()) continue;
      summary_.triangles += static_cast<std::uint32_t>(positions.size() / 3);
      primitives.push_back({{"attributes",
                             {{"POSITION", document_.add_vec3(positions)},
                              {"NORMAL", document_.add_vec3(normals)},
                              {"TEXCOORD_0", document_.add_vec2(uvs)}}},
                            {"material", material(key_of(instance, relative))},
                            {"mode", kTriangleList}});
    }
    if (primitives.empty()) return scene::kNone;
    return document_.add("meshes", {{"name", mesh.name}, {"primitives", std::move(primitives)}});
  }

  std::uint32_t add_instance(const scene::Instance& instance) {
    const scene::Mesh& source = assets_.meshes[instance.mesh];
    Json node{{"name", fmt::format("{} {}", source.name, instance.id)}};
    const mat4x3& m = instance.transform;
    node["matrix"] = matrix(m[0], m[1], m[2], m[3]);
    const std::uint32_t index = mesh(instance);
    if (index != scene::kNone) node["mesh"] = index;
    if ((instance.visibility & scene::kSeenByAll) != scene::kSeenByAll)
      node["extras"]["fullbright"] = {{"seen_by_camera", (instance.visibility & scene::kSeenByCamera) != 0},
                                      {"seen_by_other_rays", (instance.visibility & scene::kSeenByIndirect) != 0}};
    return document_.add("nodes", std::move(node));
  }

  std::uint32_t add_camera(uvec2 size) {
    const render::CameraFrame frame = render::camera_frame(snapshot_.camera, size.x, size.y);
    const float tan_x = glm::length(frame.right), tan_y = glm::length(frame.up);
    const std::uint32_t camera = document_.add(
        "cameras", {{"type", "perspective"},
                    {"perspective",
                     {{"yfov", 2.0f * std::atan(tan_y)}, {"aspectRatio", tan_x / tan_y}, {"znear", kMetresPerUnit}}},
                    {"extras", {{"fullbright", {{"width", size.x}, {"height", size.y}}}}}});
    return document_.add("nodes",
                         {{"name", "camera"},
                          {"camera", camera},
                          {"matrix", matrix(frame.right / tan_x, frame.up / tan_y, -frame.forward, frame.position)}});
  }

  // A directional lamp shines along its own -z.
  std::uint32_t add_sun(const scene::Sun& sun) {
    document_.use_extension("KHR_lights_punctual");
    const float strength = std::max(largest(sun.irradiance), 1e-20f);
    Json& lights = document_.root()["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back({{"type", "directional"},
                      {"color", list(sun.irradiance / strength)},
                      {"intensity", strength * kLumenPerWatt},
                      {"extras", {{"fullbright", {{"radius_degrees", sun.angular_radius}}}}}});
    const vec3 z = glm::normalize(sun.direction);
    const vec3 x = glm::normalize(glm::cross(std::abs(z.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0), z));
    return document_.add("nodes", {{"name", "sun"},
                                   {"matrix", matrix(x, glm::cross(z, x), z, vec3(0))},
                                   {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
  }

  const scene::FrameSnapshot& snapshot_;
  const scene::Assets& assets_;
  render::EmissionScales scales_;
  GltfDocument document_;
  GltfSummary summary_;
  std::set<std::string> missing_;
  std::map<std::tuple<std::uint32_t, Plane, bool, float>, std::uint32_t> textures_;
  std::map<MaterialKey, std::uint32_t> materials_;
  std::map<std::string, std::uint32_t> names_;
  std::optional<Error> failed_;
};

}  // namespace

Result<GltfSummary> export_gltf(const scene::FrameSnapshot& snapshot, const render::RenderSettings& settings,
                                uvec2 size, const std::string& path, const std::string& generator) {
  return Exporter(snapshot, settings, generator).write(size, path);
}

}  // namespace fb::lab
