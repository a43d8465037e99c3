#include "lab/import/scene_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::lab {
namespace {

constexpr std::size_t kMostTriangles = 4000000;  // of which the device's arrays hold 48 bytes each
constexpr float kPointRadius = 1.0f;             // units
// Sizes of a scene that the renderer's offsets suit, and what others are scaled to, in units.
constexpr float kSmallest = 64.0f, kLargest = 32768.0f, kFitted = 2048.0f;
constexpr float kFarthest = 1e6f;

bool finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

float determinant(const mat4x3& m) { return glm::dot(m[0], glm::cross(m[1], m[2])); }

// Six times the volume that a mesh's triangles enclose, from `first` on; negative where they face inward.
double volume(const scene::Mesh& mesh, std::size_t first) {
  double sum = 0;
  for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
    const auto& v = mesh.triangles[i].vertices;
    const vec3 a = mesh.positions[v[0]], b = mesh.positions[v[1]], c = mesh.positions[v[2]];
    sum += static_cast<double>(glm::dot(a, glm::cross(b, c)));
  }
  return sum;
}

void turn(scene::MeshTriangle& triangle) {
  std::swap(triangle.vertices[1], triangle.vertices[2]);
  std::swap(triangle.uv[1], triangle.uv[2]);
}

}  // namespace

mat4x3 after(const mat4x3& second, const mat4x3& first) {
  return mat4x3(transform_vector(second, first[0]), transform_vector(second, first[1]),
                transform_vector(second, first[2]), transform_point(second, first[3]));
}

mat4x3 scaled(const vec3& f) { return mat4x3(vec3(f.x, 0, 0), vec3(0, f.y, 0), vec3(0, 0, f.z), vec3(0)); }

vec3 angles_of(const vec3& forward, const vec3& right) {
  const float pitch = -degrees(std::asin(std::clamp(forward.z, -1.0f, 1.0f)));
  // Straight up or down any yaw will do: the roll is then the whole turn.
  const bool upright = std::hypot(forward.x, forward.y) > 1e-6f;
  const float yaw = upright ? degrees(std::atan2(forward.y, forward.x)) : 0.0f;
  const AxisVectors level = angle_vectors({pitch, yaw, 0});
  return {pitch, yaw, degrees(std::atan2(-glm::dot(right, level.up), glm::dot(right, level.right)))};
}

SceneMaker::SceneMaker(const mat4x3& to_world)
    : to_world_(to_world), scale_(std::cbrt(std::abs(determinant(to_world)))), assets_(scene::new_code_assets()) {}

std::uint32_t SceneMaker::add_image(std::string name, formats::RgbaImage image, scene::ImageEncoding encoding) {
  assets_->images.push_back({std::move(name), encoding, image.width, image.height, std::move(image.rgba)});
  return static_cast<std::uint32_t>(assets_->images.size() - 1);
}

std::uint32_t SceneMaker::add_gray_image(std::string name, int width, int height, std::vector<std::uint8_t> texels) {
  assets_->images.push_back({std::move(name), scene::ImageEncoding::kLinearGray, width, height, std::move(texels)});
  return static_cast<std::uint32_t>(assets_->images.size() - 1);
}

std::uint32_t SceneMaker::white_image() {
  if (!white_) white_ = add_image("white", {1, 1, {255, 255, 255, 255}}, scene::ImageEncoding::kSrgba);
  return *white_;
}

std::uint32_t SceneMaker::add_material(scene::Material material) {
  assets_->materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(assets_->materials.size() - 1);
}

Status SceneMaker::add_mesh(const ImportedMesh& mesh, const mat4x3& transform, std::uint32_t material,
                            std::uint32_t visibility) {
  const std::size_t count = mesh.positions.size();
  if (mesh.indices.size() % 3 != 0) return Error{fmt::format("{} indices are no triangles", mesh.indices.size())};
  if ((!mesh.normals.empty() && mesh.normals.size() != count) || (!mesh.uvs.empty() && mesh.uvs.size() != count))
    return Error{fmt::format("{} positions have {} normals and {} texture coordinates", count, mesh.normals.size(),
                             mesh.uvs.size())};
  triangles_ += mesh.indices.size() / 3;
  if (triangles_ > kMostTriangles) return Error{fmt::format("there are more than {} triangles", kMostTriangles)};

  const mat4x3 place = after(to_world_, transform);
  const bool mirrored = determinant(place) < 0;
  std::vector<vec3> positions;
  positions.reserve(count);
  for (const vec3& p : mesh.positions) {
    positions.push_back(transform_point(place, p));
    if (!finite(positions.back())) return Error{"a position is no number"};
  }
  // Normals go with the transposed inverse; what is flat has its triangle's.
  const mat4x3 inverse = inverse_affine(place);
  const auto turned = [&](const vec3& n) {
    return vec3(glm::dot(inverse[0], n), glm::dot(inverse[1], n), glm::dot(inverse[2], n));
  };
  scene::Mesh& part = parts_[visibility];
  const std::size_t first = part.triangles.size();
  for (std::size_t at = 0; at < mesh.indices.size(); at += 3) {
    const std::array corners{mesh.indices[at], mesh.indices[at + 1], mesh.indices[at + 2]};
    if (*std::ranges::max_element(corners) >= count)
      return Error{fmt::format("a triangle has corner {} of {}", *std::ranges::max_element(corners), count)};
    const vec3 across =
        glm::cross(positions[corners[1]] - positions[corners[0]], positions[corners[2]] - positions[corners[0]]);
    const float twice_area = glm::length(across);
    if (!(twice_area > 0.0f) || !std::isfinite(twice_area)) continue;  // no renderer sees it
    const vec3 flat = across / (mirrored ? -twice_area : twice_area);
    scene::MeshTriangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      vec3 normal = mesh.normals.empty() ? flat : turned(mesh.normals[corners[i]]);
      const float length = glm::length(normal);
      normal = length > 0.0f && std::isfinite(length) ? normal / length : flat;
      triangle.vertices[i] = static_cast<std::uint32_t>(part.positions.size());
      part.positions.push_back(positions[corners[i]]);
      part.normals.push_back(normal);
      if (!mesh.uvs.empty()) triangle.uv[i] = mesh.uvs[corners[i]];
    }
    triangle.material = material;
    triangle.face = scene::kNone;
    if (mirrored) turn(triangle);
    part.triangles.push_back(triangle);
  }
  // Glass is what its surface encloses.
  if ((assets_->materials[material].flags & scene::kMaterialDielectric) != 0 && volume(part, first) < 0)
    for (std::size_t i = first; i < part.triangles.size(); ++i) turn(part.triangles[i]);
  return ok_status();
}

void SceneMaker::add_point_light(const vec3& position, const vec3& intensity) {
  points_.push_back({transform_point(to_world_, position), intensity});
}

void SceneMaker::add_sun(const vec3& towards, const vec3& irradiance, float angular_radius) {
  sky_.suns.push_back({glm::normalize(transform_vector(to_world_, towards)), irradiance, angular_radius});
  sky_.beyond_everything = true;
}

void SceneMaker::set_sky(const vec3& radiance) {
  sky_.mode = scene::SkyMode::kConstant;
  sky_.color = radiance;
  sky_.beyond_everything = true;
}

Result<ImportedScene> SceneMaker::finish(const std::string& path, bool scale_to_fit) {
  Bounds bounds;
  for (const auto& [visibility, mesh] : parts_)
    for (const vec3& p : mesh.positions) bounds.add(p);
  if (bounds.empty()) return Error{path + ": there are no triangles in it"};
  const float size = glm::length(bounds.max - bounds.min);
  float fit = 1.0f;
  if (scale_to_fit && (size < kSmallest || size > kLargest)) {
    fit = kFitted / size;
    leave_out(fmt::format("the scene is {:.3g} units across and was scaled by {:.3g}", size, fit));
  }
  const vec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max)) * fit;
  if (!(std::max({reach.x, reach.y, reach.z}) < kFarthest))
    return Error{fmt::format("{}: its triangles reach further than {} units (of an inch)", path, kFarthest)};

  scene::Camera camera;
  if (camera_) {
    const vec3 forward = glm::normalize(transform_vector(to_world_, camera_->forward));
    const vec3 right = glm::normalize(transform_vector(to_world_, camera_->right));
    if (!finite(forward) || !finite(right)) return Error{path + ": its camera looks nowhere"};
    camera = scene::camera_at(transform_point(to_world_, camera_->position) * fit, angles_of(forward, right),
                              camera_->fov_x);
  } else {
    leave_out("it has no camera: this one sees all of it from the south (--camera sets another)");
    const vec3 centre = (bounds.min + bounds.max) * (0.5f * fit);
    camera = scene::camera_at(centre - vec3(0, size * fit, 0), {0, 90, 0}, 60.0f);
  }
  scene::FrameSnapshot snapshot = scene::still(assets_, camera);
  snapshot.sky = sky_;
  for (scene::Material& material : assets_->materials) material.absorption /= fit;
  for (auto& [visibility, mesh] : parts_) {
    if (mesh.triangles.empty()) continue;
    for (vec3& p : mesh.positions) p *= fit;
    const auto id = static_cast<std::uint32_t>(scene::kIdWorld + snapshot.instances.size());
    scene::Instance instance = scene::make_instance(id, scene::add_finished(*assets_, std::move(mesh), "scene"));
    instance.visibility = visibility;
    snapshot.instances.push_back(instance);
  }
  if (!points_.empty()) {
    const std::uint32_t sphere = scene::add_sphere_mesh(*assets_);
    const std::uint32_t lamp = scene::add_material(*assets_, "point light", vec3(0), vec3(1));
    const float radius = kPointRadius / (scale_ * fit);  // in the file's units
    std::uint32_t id = scene::kIdEntityLight;
    for (const Point& point : points_)
      snapshot.instances.push_back(scene::glowing(id++, sphere, lamp, point.position * fit, vec3(kPointRadius),
                                                  point.intensity / (kPi * radius * radius)));
  }
  return ImportedScene{std::move(snapshot), {left_out_.begin(), left_out_.end()}};
}

}  // namespace fb::lab
