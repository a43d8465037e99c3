#include "lab/import/pbrt_shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lab/import/ply_mesh.h"

namespace fb::lab {
namespace {

constexpr int kAround = 64, kUp = 32;  // parts of what is round
constexpr float kMostIndex = 4294967295.0f;

Result<std::vector<std::uint32_t>> indices_of(const PbrtDirective& shape) {
  std::vector<std::uint32_t> out;
  const PbrtParameter* p = shape.find("indices");
  if (p == nullptr) return out;
  out.reserve(p->numbers.size());
  for (const float value : p->numbers) {
    if (!(value >= 0 && value < kMostIndex)) return shape.error(fmt::format("index {} is no vertex", value));
    out.push_back(static_cast<std::uint32_t>(value));
  }
  return out;
}

// A grid of corners, `across` + 1 by `up` + 1, as triangles that face to the left of u against v.
void add_grid(ImportedMesh& mesh, int across, int up) {
  const auto at = [&](int u, int v) { return static_cast<std::uint32_t>(v * (across + 1) + u); };
  for (int v = 0; v < up; ++v)
    for (int u = 0; u < across; ++u) {
      mesh.indices.insert(mesh.indices.end(), {at(u, v), at(u + 1, v), at(u + 1, v + 1)});
      mesh.indices.insert(mesh.indices.end(), {at(u, v), at(u + 1, v + 1), at(u, v + 1)});
    }
}

struct Round {
  vec3 position, normal;
};

// What turns about z: a profile over v in [0, 1] at the angle phi.
template <typename Profile>
ImportedMesh turned(int up, const Profile& profile) {
  ImportedMesh mesh;
  for (int v = 0; v <= up; ++v)
    for (int u = 0; u <= kAround; ++u) {
      const float across = static_cast<float>(u) / kAround, height = static_cast<float>(v) / static_cast<float>(up);
      const float phi = u == kAround ? 0.0f : 2.0f * kPi * across;
      const Round at = profile(phi, height);
      mesh.positions.push_back(at.position);
      mesh.normals.push_back(at.normal);
      mesh.uvs.emplace_back(across, height);
    }
  add_grid(mesh, kAround, up);
  return mesh;
}

ImportedMesh sphere(float radius) {
  return turned(kUp, [&](float phi, float height) {
    const float theta = kPi * (1.0f - height);
    const vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    return Round{n * radius, n};
  });
}

ImportedMesh cylinder(float radius, float low, float high) {
  return turned(1, [&](float phi, float height) {
    const vec3 n(std::cos(phi), std::sin(phi), 0);
    return Round{n * radius + vec3(0, 0, low + (high - low) * height), n};
  });
}

ImportedMesh disk(float radius, float inner, float height) {
  return turned(1, [&](float phi, float share) {
    const float r = radius + (inner - radius) * share;
    return Round{{r * std::cos(phi), r * std::sin(phi), height}, {0, 0, 1}};
  });
}

Result<ImportedMesh> triangles(const PbrtDirective& shape, bool four_corners) {
  ImportedMesh mesh;
  mesh.positions = shape.vectors("P");
  mesh.normals = shape.vectors("N");
  mesh.uvs = shape.pairs(shape.find("uv") != nullptr ? "uv" : "st");
  auto read = indices_of(shape);
  if (!read) return read.error();
  std::vector<std::uint32_t> order = std::move(*read);
  if (mesh.positions.empty()) return shape.error("it has no positions P");
  const std::size_t corners = four_corners ? 4 : 3;
  if (order.empty() && mesh.positions.size() == corners)
    for (std::uint32_t i = 0; i < corners; ++i) order.push_back(i);
  if (order.empty() || order.size() % corners != 0)
    return shape.error(fmt::format("{} indices are no faces of {} corners", order.size(), corners));
  if (!four_corners) {
    mesh.indices = std::move(order);
  } else {
    for (std::size_t i = 0; i < order.size(); i += 4)
      mesh.indices.insert(mesh.indices.end(),
                          {order[i], order[i + 1], order[i + 3], order[i], order[i + 3], order[i + 2]});
  }
  return mesh;
}

}  // namespace

Result<std::optional<ImportedMesh>> pbrt_shape(const PbrtDirective& shape, const std::filesystem::path& folder,
                                               std::string& left_out) {
  const std::string& kind = shape.text(0);
  Result<ImportedMesh> mesh = ImportedMesh();
  if (kind == "trianglemesh" || kind == "bilinearmesh") {
    mesh = triangles(shape, kind == "bilinearmesh");
  } else if (kind == "plymesh") {
    const std::string name = shape.word("filename", "");
    if (name.empty()) return shape.error("its filename is missing");
    if (name.ends_with(".gz")) return shape.error(fmt::format("{} is compressed: unpack it with gunzip", name));
    mesh = read_ply((folder / name).string());
    if (!mesh) return shape.error(mesh.error().message);
    if (shape.find("displacement") != nullptr) left_out = "displacement is left out";
  } else if (kind == "sphere") {
    mesh = sphere(shape.number("radius", 1));
    if (shape.find("zmin") != nullptr || shape.find("zmax") != nullptr || shape.find("phimax") != nullptr)
      left_out = "parts of spheres are whole";
  } else if (kind == "cylinder") {
    mesh = cylinder(shape.number("radius", 1), shape.number("zmin", -1), shape.number("zmax", 1));
  } else if (kind == "disk") {
    mesh = disk(shape.number("radius", 1), shape.number("innerradius", 0), shape.number("height", 0));
  } else if (kind == "loopsubdiv") {
    mesh = triangles(shape, false);
    left_out = "subdivided surfaces are as coarse as their control mesh";
  } else {
    left_out = fmt::format("shapes of kind {} are left out", kind);
    return std::optional<ImportedMesh>();
  }
  if (!mesh) return mesh.error();
  for (vec2& uv : mesh->uvs) uv.y = 1.0f - uv.y;
  return std::optional(std::move(*mesh));
}

}  // namespace fb::lab
