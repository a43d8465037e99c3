// What importers put a scene together with: materials, images, triangles and lights in the file's own space, from which
// one transform leads to ours. All triangles become one mesh, of each visibility.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "formats/image.h"
#include "lab/gltf/gltf_numbers.h"
#include "lab/import/imported_scene.h"
#include "scene/assets.h"

namespace fb::lab {

constexpr float kUnitsPerMetre = 1.0f / kMetresPerUnit;

// Triangles of one material. Normals and texture coordinates are of the corners: empty, or as many as positions.
struct ImportedMesh {
  std::vector<vec3> positions, normals;
  std::vector<vec2> uvs;
  std::vector<std::uint32_t> indices;  // three a triangle
};

// A camera by its axes in the file's space, any length; `right` is where the picture's right is.
struct ImportedCamera {
  vec3 position{0.0f}, forward{0, 0, -1}, right{1, 0, 0}, up{0, 1, 0};
  float fov_x = 60.0f;  // degrees
};

class SceneMaker {
 public:
  // `to_world`: from the file's space (metres, say) to ours (units, z up); it may mirror.
  explicit SceneMaker(const mat4x3& to_world);

  std::uint32_t add_image(std::string name, formats::RgbaImage image, scene::ImageEncoding encoding);
  std::uint32_t add_gray_image(std::string name, int width, int height, std::vector<std::uint8_t> texels);
  std::uint32_t white_image();
  std::uint32_t add_material(scene::Material material);
  const scene::Material& material(std::uint32_t index) const { return assets_->materials[index]; }

  // Fails where an index leads nowhere, a number is not finite, or the scene becomes larger than kMostTriangles.
  Status add_mesh(const ImportedMesh& mesh, const mat4x3& transform, std::uint32_t material,
                  std::uint32_t visibility = scene::kSeenByAll);
  // A sphere of kPointRadius units that has the intensity of a point, in W / sr of the file's unit squared a unit of
  // radiance.
  void add_point_light(const vec3& position, const vec3& intensity);
  // `towards`: from the scene to the sun. Irradiance on what faces it.
  void add_sun(const vec3& towards, const vec3& irradiance, float angular_radius);
  void set_sky(const vec3& radiance);
  void set_camera(const ImportedCamera& camera) { camera_ = camera; }
  bool has_camera() const { return camera_.has_value(); }
  void leave_out(std::string sentence) { left_out_.insert(std::move(sentence)); }

  // `scale_to_fit`: the file's unit is not known.
  Result<ImportedScene> finish(const std::string& path, bool scale_to_fit);

 private:
  struct Part {
    scene::Mesh mesh;
    Bounds bounds;
  };

  mat4x3 to_world_;
  float scale_;  // units of ours in one of the file's
  std::shared_ptr<scene::Assets> assets_;
  std::map<std::uint32_t, scene::Mesh> parts_;  // by visibility
  struct Point {
    vec3 position, intensity;
  };
  std::vector<Point> points_;
  scene::Sky sky_;
  std::optional<ImportedCamera> camera_;
  std::optional<std::uint32_t> white_;
  std::set<std::string> left_out_;
  std::size_t triangles_ = 0;
};

// The transform of a node or of a point in space, one after the other.
mat4x3 after(const mat4x3& second, const mat4x3& first);
mat4x3 scaled(const vec3& factors);
// Quake's angles of a camera that looks along `forward`, its picture's right along `right`: the inverse of
// angle_vectors. Both unit and at right angles.
vec3 angles_of(const vec3& forward, const vec3& right);

}  // namespace fb::lab
